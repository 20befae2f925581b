#include "checks.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/pi.h"
#include "measured_files.h"
#include "refusal.h"

namespace lobelight::fuzz {

namespace {

constexpr double kHalfPi = 0.5 * kPi;

}  // namespace

Counts counts;
void (*on_violation)(const std::string& clause) = nullptr;

void require(bool holds, const std::string& clause) {
  if (holds) return;
  if (on_violation) on_violation(clause);
  std::fprintf(stderr, "%s: %s\n", kReader, clause.c_str());
  std::abort();
}

void accept(Panorama picture) {
  ++counts.accepted;
  const auto width = static_cast<std::int64_t>(picture.width);
  const auto height = static_cast<std::int64_t>(picture.height);
  require(width >= 1 && height >= 1 && width <= kMaxPanoramaSide && height <= kMaxPanoramaSide &&
              width * height <= kMaxPanoramaTexels,
          "accepts a picture beyond the limits");
  require(picture.rgb.size() == 3 * static_cast<std::size_t>(width * height),
          "accepts a picture that has not its stated size");
  picture.sanitise();
  for (const float value : picture.rgb) {
    require(std::isfinite(value) && value >= 0.0F, "accepts a texel that is no light");
  }
}

void accept(const MeasuredData& data) {
  ++counts.accepted;
  constexpr std::array<double, 5> kElevations{0.0, 0.3, 0.9, 1.4, kHalfPi - 1e-6};
  for (const double theta_i : kElevations) {
    for (const double theta_o : kElevations) {
      for (const double azimuth : {0.0, 0.7, kPi, -2.0}) {
        const glm::dvec3 value = data.reflected(testing::from_angles(theta_i, azimuth),
                                                testing::from_angles(theta_o, 0.4));
        for (int channel = 0; channel < 3; ++channel) {
          require(std::isfinite(value[channel]) && value[channel] >= 0.0,
                  "accepts measurements that reflect no light");
        }
      }
    }
  }
}

void refuse(const std::string& message, const std::string& file) {
  ++counts.refused;
  const std::string wrong = testing::wrong_in_refusal(message, file);
  require(wrong.empty(), "is refused with a message that " + wrong);
}

std::string scratch_path() {
  const char* const given = std::getenv("LOBELIGHT_FUZZ_SCRATCH");
  if (given) return given;
  return (std::filesystem::temp_directory_path() / (std::string("lobelight-fuzz-") + kReader))
      .u8string();
}

void write_scratch(const std::string& path, const std::uint8_t* bytes, std::size_t count) {
  std::ofstream stream(std::filesystem::u8path(path), std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  stream.close();
  if (!stream) {
    std::fprintf(stderr, "%s cannot be written\n", path.c_str());
    std::exit(2);
  }
}

}  // namespace lobelight::fuzz
