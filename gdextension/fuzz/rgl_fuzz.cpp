// RGL's .bsdf tensor files.

#include "base/pi.h"
#include "brdf/binary_file.h"
#include "brdf/rgl.h"
#include "checks.h"
#include "measured_files.h"

namespace lobelight::fuzz {

const char* const kReader = "rgl";

namespace {

std::vector<float> numbers(std::size_t count) {
  std::vector<float> values;
  for (std::size_t n = 0; n < count; ++n) {
    values.push_back(0.125F * static_cast<float>((n * 7 + 3) % 16));
  }
  return values;
}

// Squares of 3 × 4 values and less: mutations meet the structure as often as the numbers.
Bytes file_with(std::vector<float> azimuths) {
  const std::uint64_t p = azimuths.size();
  testing::TensorWriter writer;
  writer.add_bytes("description", "fuzz");
  writer.add("theta_i", {2}, {0.0F, 1.5F});
  writer.add("phi_i", {p}, std::move(azimuths));
  writer.add("sigma", {3, 4}, numbers(12));
  writer.add("ndf", {4, 3}, numbers(12));
  writer.add("vndf", {p, 2, 3, 3}, numbers(p * 18));
  writer.add("rgb", {p, 2, 3, 2, 2}, numbers(p * 24));
  writer.add_bytes("jacobian", std::string(1, '\1'));
  const std::vector<char> bytes = writer.file();
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<Bytes> seeds() {
  constexpr float kHalfTurn = static_cast<float>(kPi);
  return {file_with({0.0F}),
          file_with({-kHalfTurn, -0.5F * kHalfTurn, 0.0F, 0.5F * kHalfTurn, kHalfTurn}),
          file_with({-kHalfTurn, -0.75F * kHalfTurn, -0.5F * kHalfTurn})};
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
