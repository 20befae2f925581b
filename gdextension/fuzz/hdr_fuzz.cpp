// Radiance pictures.

#include "checks.h"
#include "image/image_error.h"
#include "image/radiance_hdr.h"

namespace lobelight::fuzz {

const char* const kReader = "hdr";

namespace {

Bytes picture(const std::string& resolution, const Bytes& pixels,
              const std::string& variables = "EXPOSURE=1.5\nFORMAT=32-bit_rle_rgbe\n") {
  const std::string text = "#?RADIANCE\n" + variables + "\n" + resolution + "\n";
  Bytes bytes(text.begin(), text.end());
  bytes.insert(bytes.end(), pixels.begin(), pixels.end());
  return bytes;
}

}  // namespace

// Each coding once: flat pixels, old runs, and the new ones with runs and literals.
std::vector<Bytes> seeds() {
  Bytes flat;
  for (int i = 0; i < 4 * 6 * 3; ++i) flat.push_back(static_cast<std::uint8_t>(40 + 3 * i));
  const Bytes old_runs = {90, 80, 70, 130, 1, 1, 1, 44, 1, 1, 1, 1, 10, 20, 30, 126, 1, 1, 1, 17};
  Bytes new_runs;
  for (int row = 0; row < 3; ++row) {
    new_runs.insert(new_runs.end(), {2, 2, 0, 20});
    for (std::uint8_t component = 0; component < 4; ++component) {
      new_runs.insert(new_runs.end(), {128 + 15, static_cast<std::uint8_t>(60 * component), 5});
      for (std::uint8_t n = 0; n < 5; ++n) new_runs.push_back(static_cast<std::uint8_t>(120 + n));
    }
  }
  return {picture("-Y 3 +X 6", flat), picture("-Y 1 +X 319", old_runs),
          picture("-Y 3 +X 20", new_runs),
          picture("+X 3 -Y 20", new_runs, "VIEW= -vta\nFORMAT= 32-bit_rle_xyze \n"),
          picture("+Y 3 -X 6", flat,
                  "COLORCORR=1 2 1\nPRIMARIES=.7 .3 .2 .7 .1 .1 .3 .3\nGAMMA=2.2\nPIXASPECT=2\n")};
}

}  // namespace lobelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lobelight;
  try {
    fuzz::accept(decode_radiance_hdr(fuzz::Bytes(data, data + size), "input.hdr"));
  } catch (const ImageError& error) {
    fuzz::refuse(error.what(), "input.hdr");
  }
  return 0;
}
