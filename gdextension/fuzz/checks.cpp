#include "checks.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/pi.h"
#include "measured_files.h"

namespace lobelight::fuzz {

namespace {

constexpr double kHalfPi = 0.5 * kPi;

// Messages are shown in a line of the editor.
constexpr std::size_t kLongestMessage = 1000;

// Whether `text` is UTF-8 as RFC 3629 has it, without control characters.
bool is_one_clean_line(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t n) -> unsigned {
      return at + n < text.size() ? static_cast<unsigned char>(text[at + n]) : 0U;
    };
    const unsigned lead = byte(0);
    if (lead < 0x80) {
      if (lead < 0x20 || lead == 0x7f) return false;
      ++at;
      continue;
    }
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4) return false;
    for (std::size_t n = 1; n < length; ++n) {
      if ((byte(n) & 0xc0U) != 0x80U) return false;
    }
    // Overlong forms, surrogates, and what is beyond U+10FFFF.
    if (lead == 0xe0 && byte(1) < 0xa0) return false;
    if (lead == 0xed && byte(1) > 0x9f) return false;
    if (lead == 0xf0 && byte(1) < 0x90) return false;
    if (lead == 0xf4 && byte(1) > 0x8f) return false;
    at += length;
  }
  return true;
}

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
  const std::string start = file + ": ";
  require(message.rfind(start, 0) == 0 && message.size() > start.size(),
          "refuses a file without its name or a reason");
  require(message.size() <= kLongestMessage, "refuses a file with an endless message");
  require(is_one_clean_line(message), "refuses a file with a message that is not one line of text");
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
