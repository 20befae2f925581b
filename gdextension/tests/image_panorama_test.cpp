#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "image/image_error.h"
#include "image/panorama.h"

namespace lobelight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Texel (column, row) holds (column, row, 1).
Panorama ramp(int width, int height) {
  Panorama panorama{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      panorama.rgb.insert(panorama.rgb.end(),
                          {static_cast<float>(column), static_cast<float>(row), 1.0f});
    }
  }
  return panorama;
}

void check_close(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  INFO("(", a.x, ", ", a.y, ", ", a.z, ") and (", b.x, ", ", b.y, ", ", b.z, ")");
  CHECK(glm::length(a - b) <= tolerance);
}

TEST_CASE("panorama_position: directions worked out by hand") {
  struct Case {
    glm::dvec3 direction;
    glm::dvec2 position;
  };
  const double d = std::sqrt(0.5);
  const Case cases[] = {
      {{0, 0, -1}, {0.0, 0.5}},       {{1, 0, 0}, {0.25, 0.5}},   {{0, 0, 1}, {0.5, 0.5}},
      {{-1, 0, 0}, {0.75, 0.5}},      {{d, 0, -d}, {0.125, 0.5}}, {{-d, 0, -d}, {0.875, 0.5}},
      {{0, d, -d}, {0.0, 0.25}},      {{0, -d, -d}, {0.0, 0.75}}, {{d, 0, d}, {0.375, 0.5}},
      {{0.5, d, 0.5}, {0.375, 0.25}},
  };
  for (const Case& c : cases) {
    const glm::dvec2 position = panorama_position(c.direction);
    CHECK(position.x == doctest::Approx(c.position.x).epsilon(1e-14));
    CHECK(position.y == doctest::Approx(c.position.y).epsilon(1e-14));
  }
  CHECK(panorama_position({0, 1, 0}).y == 0.0);
  CHECK(panorama_position({0, -1, 0}).y == 1.0);
}

TEST_CASE("panorama_position: u stays below 1 and rounding cannot leave the poles") {
  CHECK(panorama_position({-1e-300, 0, -1}).x < 1.0);
  CHECK(panorama_position({-1e-17, 0, -1}).x < 1.0);
  CHECK(panorama_position({0, 1.0 + 1e-15, 0}).y == 0.0);
  CHECK(panorama_position({0, -1.0 - 1e-15, 0}).y == 1.0);
}

TEST_CASE("panorama_direction undoes panorama_position") {
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const glm::dvec2 position((i + 0.3) / 20, (j + 0.7) / 20);
      const glm::dvec3 direction = panorama_direction(position);
      CHECK(glm::length(direction) == doctest::Approx(1.0).epsilon(1e-14));
      const glm::dvec2 back = panorama_position(direction);
      CHECK(back.x == doctest::Approx(position.x).epsilon(1e-12));
      CHECK(back.y == doctest::Approx(position.y).epsilon(1e-12));
    }
  }
}

TEST_CASE("Panorama::sample: texel centres and the middle between them") {
  const Panorama panorama = ramp(8, 4);
  const auto at = [&](double x, double y) {
    return panorama.sample(panorama_direction({x / 8, y / 4}));
  };
  check_close(at(2.5, 1.5), {2, 1, 1}, 1e-12);
  check_close(at(3.0, 2.0), {2.5, 1.5, 1}, 1e-12);
  check_close(at(5.75, 2.25), {5.25, 1.75, 1}, 1e-12);
}

TEST_CASE("Panorama::sample wraps around and clamps at the poles") {
  const Panorama panorama = ramp(8, 4);
  const auto at = [&](double x, double y) {
    return panorama.sample(panorama_direction({x / 8, y / 4}));
  };
  // Between the last column (7) and the first (0): 3/4 and 1/4 of the way.
  check_close(at(7.75, 1.5), {7 * 0.75, 1, 1}, 1e-12);
  check_close(at(0.25, 1.5), {7 * 0.25, 1, 1}, 1e-12);
  // Beyond the first and last row's centres.
  check_close(at(2.5, 0.2), {2, 0, 1}, 1e-12);
  check_close(at(2.5, 3.9), {2, 3, 1}, 1e-12);
}

TEST_CASE("Panorama::sample of one texel is that texel") {
  const Panorama panorama{1, 1, {2.0f, 3.0f, 4.0f}};
  check_close(panorama.sample(glm::normalize(glm::dvec3(0.3, -0.8, 0.1))), {2, 3, 4}, 1e-12);
}

TEST_CASE("Panorama: negative values and NaN count as 0, an infinite one is the brightest") {
  Panorama panorama = ramp(8, 4);
  float* texel = &panorama.rgb[3 * (1 * 8 + 2)];
  texel[0] = kNan;
  texel[1] = -5.0f;
  texel[2] = kInfinity;
  panorama.rgb[3 * (3 * 8 + 7) + 1] = -kInfinity;
  const auto between = [&] { return panorama.sample(panorama_direction({3.0 / 8, 1.5 / 4})); };
  const glm::dvec3 expected(1.5, 0.5, 0.5 * 65504.0 + 0.5);  // between texels (2, 1) and (3, 1)
  check_close(between(), expected, 1e-9);
  CHECK(panorama.sanitise() == 2);
  check_close(between(), expected, 1e-9);
  CHECK(panorama.rgb[3 * (3 * 8 + 7) + 1] == 0.0f);
  CHECK(panorama.notes ==
        std::vector<std::string>{"has 2 texels with negative channels, which are 0 now",
                                 "has 1 texel with a channel that is no number and is 0 now"});
  REQUIRE(panorama.warnings.size() == 1);
  CHECK(panorama.warnings[0].find("has 1 texel that is infinite and has 65504 now") == 0);
  CHECK(panorama.sanitise() == 0);
  CHECK(panorama.notes.size() == 2);
}

TEST_CASE("Panorama: an infinite value is not darker than a finite one") {
  Panorama panorama{2, 1, {kInfinity, 1.0f, 2e6f, kInfinity, 0.0f, 0.0f}};
  CHECK(panorama.sanitise() == 2);
  CHECK(panorama.rgb == std::vector<float>{2e6f, 1.0f, 2e6f, 2e6f, 0.0f, 0.0f});
  REQUIRE(panorama.warnings.size() == 1);
  CHECK(panorama.warnings[0].find("has 2 texels that are infinite and have 2e+06 now") == 0);
}

TEST_CASE("Panorama::expose caps, and says how much of the light goes") {
  // Rows of 4: a lit quarter of the sphere, as the sines of their middles weigh: s, c, c, s.
  Panorama panorama{2, 4, std::vector<float>(24, 0.0f)};
  for (int channel = 0; channel < 3; ++channel) {
    panorama.rgb[static_cast<std::size_t>(channel)] = 4.0f * kLargestHalf;
    panorama.rgb[static_cast<std::size_t>(6 + channel)] = kLargestHalf;
  }
  const double s = std::sin(3.14159265358979 / 8.0), c = std::cos(3.14159265358979 / 8.0);
  Panorama kept = panorama;
  CHECK(kept.expose(-2.0) == 0);
  CHECK(kept.rgb[0] == kLargestHalf);
  CHECK(kept.rgb[6] == kLargestHalf / 4.0f);
  CHECK(kept.warnings.empty());
  CHECK(panorama.expose(0.0) == 1);
  CHECK(panorama.rgb[0] == kLargestHalf);
  char share[16];
  std::snprintf(share, sizeof share, "%.1f", 100.0 * 3.0 * s / (4.0 * s + c));
  CHECK(panorama.warnings ==
        std::vector<std::string>{
            "has 1 texel that is brighter than 65504 and has that now: " + std::string(share) +
            " % of the light is lost; an Exposure of -2.0 EV keeps it"});
  // What the sentence proposes holds for every exposure that it comes from.
  for (const double exposure : {-3.0, 0.0, 0.33, 5.0}) {
    Panorama lamp{1, 1, {1e6f, 1e6f, 1e6f}};
    CHECK(lamp.expose(exposure) == 1);
    const std::string text = lamp.warnings.at(0);
    Panorama again{1, 1, {1e6f, 1e6f, 1e6f}};
    CHECK(again.expose(std::stod(text.substr(text.find("Exposure of ") + 12))) == 0);
  }
  Panorama absurd{1, 1, {1e30f, 1e30f, 1e30f}};
  CHECK(absurd.expose(0.0) == 1);
  CHECK(absurd.warnings.at(0).find(
            "more than 99.9 % of the light is lost; no Exposure keeps all") != std::string::npos);
  // Beyond what single precision holds, too.
  Panorama beyond{1, 1, {1e30f, 1e30f, 1e30f}};
  CHECK(beyond.expose(60.0) == 1);
  CHECK(beyond.rgb[0] == kLargestHalf);
}

TEST_CASE("check_proportions warns of what is hardly a panorama") {
  const auto warning = [](int width, int height) {
    Panorama panorama{width, height, {}};
    check_proportions(panorama);
    return panorama.warnings.empty() ? std::string() : panorama.warnings.front();
  };
  for (const auto& [width, height] : {std::pair{64, 32}, {4096, 2048}, {1025, 512}, {1, 1}}) {
    CHECK(warning(width, height).empty());
  }
  CHECK(warning(300, 200) ==
        "is 300 x 200 texels, but a panorama (latitude-longitude, 360 x 180 degrees) is twice as "
        "wide as high");
  CHECK(warning(48, 64).find("; this may be a cross of a cube") != std::string::npos);
  CHECK(warning(64, 48).find("; this may be a cross of a cube") != std::string::npos);
  CHECK(warning(64, 64).find("; a square is a light probe or one face") != std::string::npos);
  CHECK(warning(64, 384).find("; this may be the faces of a cube") != std::string::npos);
}

std::string message_of(const std::vector<std::uint8_t>& bytes) {
  try {
    decode_panorama(bytes, "map.exr");
  } catch (const ImageError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

TEST_CASE("decode_panorama goes by content and refuses anything else in one line") {
  CHECK(message_of({}) == "map.exr: is empty");
  CHECK(message_of(bytes_of("Just some text\n")) ==
        "map.exr: is neither an OpenEXR nor a Radiance (.hdr) picture");
  CHECK(message_of(bytes_of("\x89PNG\r\n\x1a\n")) ==
        "map.exr: is neither an OpenEXR nor a Radiance (.hdr) picture");
  // A Radiance picture under an EXR's name.
  std::vector<std::uint8_t> hdr = bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n");
  hdr.insert(hdr.end(), {128, 64, 32, 129});
  CHECK(decode_panorama(hdr, "map.exr").rgb == std::vector<float>{1.0f, 0.5f, 0.25f});
}

TEST_CASE("load_panorama names what is wrong with the path") {
  CHECK_THROWS_WITH_AS(load_panorama("/no/such/map.exr"), "/no/such/map.exr: no such file",
                       ImageError);
  CHECK_THROWS_WITH_AS(load_panorama("/"), "/: is a folder, not a file", ImageError);
}

TEST_CASE("check_panorama_size") {
  CHECK_NOTHROW(check_panorama_size(1, 1, "m"));
  CHECK_NOTHROW(check_panorama_size(16384, 16384, "m"));
  CHECK_NOTHROW(check_panorama_size(65536, 4096, "m"));
  CHECK_THROWS_AS(check_panorama_size(0, 5, "m"), ImageError);
  CHECK_THROWS_AS(check_panorama_size(5, -1, "m"), ImageError);
  CHECK_THROWS_AS(check_panorama_size(65537, 1, "m"), ImageError);
  CHECK_THROWS_AS(check_panorama_size(40000, 40000, "m"), ImageError);
  CHECK_THROWS_AS(check_panorama_size(std::int64_t{1} << 32, std::int64_t{1} << 32, "m"),
                  ImageError);
}

}  // namespace
}  // namespace lobelight
