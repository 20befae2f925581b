// RGL's .bsdf tensor files.

#include "base/pi.h"
#include "brdf/binary_file.h"
#include "brdf/rgl.h"
#include "checks.h"
#include "measured_files.h"

namespace lobelight::fuzz {

const char* const kReader = "rgl";

std::vector<Bytes> seeds() {
  std::vector<Bytes> files;
  for (const std::vector<char>& file : testing::small_rgl_files()) {
    files.emplace_back(file.begin(), file.end());
  }
  return files;
}

}  // namespace lobelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lobelight;
  static const std::string path = fuzz::scratch_path();
  fuzz::write_scratch(path, data, size);
  try {
    fuzz::accept(*read_rgl(path));
  } catch (const MeasuredFileError& error) {
    fuzz::refuse(error.what(), path);
  }
  return 0;
}
