#include <doctest/doctest.h>

#include <random>

#include "image/image_error.h"
#include "image/radiance_hdr.h"

namespace lobelight {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes header(const std::string& resolution, const std::string& format = "32-bit_rle_rgbe") {
  const std::string text = "#?RADIANCE\n# comment\nFORMAT=" + format + "\n\n" + resolution + "\n";
  return {text.begin(), text.end()};
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string message_of(const Bytes& bytes) {
  try {
    decode_radiance_hdr(bytes, "x.hdr");
  } catch (const ImageError& error) {
    return error.what();
  }
  return "";
}

// One row of `width` RGBE pixels in the new run-length coding: a run where `runs`, else literals.
Bytes component_row(int width, const Bytes& rgbe, bool runs) {
  Bytes bytes = {2, 2, static_cast<std::uint8_t>(width >> 8),
                 static_cast<std::uint8_t>(width & 255)};
  for (const std::uint8_t value : rgbe) {
    for (int left = width; left > 0;) {
      const int count = std::min(left, runs ? 127 : 128);
      bytes.push_back(static_cast<std::uint8_t>(runs ? 128 + count : count));
      bytes.insert(bytes.end(), runs ? 1 : static_cast<std::size_t>(count), value);
      left -= count;
    }
  }
  return bytes;
}

TEST_CASE("Radiance: flat pixels; value = mantissa · 2^(exponent − 136)") {
  const Panorama image = decode_radiance_hdr(
      header("-Y 2 +X 2") + Bytes{128, 64, 32, 129, 200, 100, 50, 136, 255, 1, 0, 120, 9, 9, 9, 0},
      "x.hdr");
  CHECK(image.width == 2);
  CHECK(image.height == 2);
  const float scale = 1.0f / 65536.0f;
  CHECK(image.rgb == std::vector<float>{1.0f, 0.5f, 0.25f, 200.0f, 100.0f, 50.0f, 255.0f * scale,
                                        scale, 0.0f, 0.0f, 0.0f, 0.0f});
}

TEST_CASE("Radiance: the new run-length coding, runs and literals") {
  const int width = 300;
  for (const bool runs : {true, false}) {
    const Panorama image =
        decode_radiance_hdr(header("-Y 2 +X 300") + component_row(width, {128, 64, 32, 129}, runs) +
                                component_row(width, {1, 2, 3, 136}, !runs),
                            "x.hdr");
    REQUIRE(image.rgb.size() == 2 * 300 * 3);
    CHECK(image.rgb[3 * 299] == 1.0f);
    CHECK(image.rgb[3 * 299 + 2] == 0.25f);
    CHECK(image.rgb[3 * 300] == 1.0f);
    CHECK(image.rgb[3 * 599 + 1] == 2.0f);
    CHECK(image.rgb[3 * 599 + 2] == 3.0f);
  }
}

TEST_CASE("Radiance: the old run-length coding, with runs of several bytes") {
  // One pixel, then 1·256⁰ + 1·256¹ = 257 repeats of it, then another pixel.
  const Panorama image = decode_radiance_hdr(
      header("-Y 1 +X 259") + Bytes{128, 64, 32, 129, 1, 1, 1, 1, 1, 1, 1, 1, 10, 20, 30, 136},
      "x.hdr");
  REQUIRE(image.rgb.size() == 259 * 3);
  CHECK(image.rgb[3 * 257] == 1.0f);
  CHECK(image.rgb[3 * 257 + 1] == 0.5f);
  CHECK(image.rgb[3 * 258] == 10.0f);
  CHECK(image.rgb[3 * 258 + 2] == 30.0f);
}

TEST_CASE("Radiance: a header with carriage returns, the magic #?RGBE and no FORMAT") {
  const std::string text = "#?RGBE\r\nEXPOSURE=2.0\r\n\r\n-Y 1 +X 1\r\n";
  const Panorama image =
      decode_radiance_hdr(Bytes(text.begin(), text.end()) + Bytes{128, 0, 0, 129}, "x.hdr");
  CHECK(image.rgb == std::vector<float>{1.0f, 0.0f, 0.0f});  // EXPOSURE is left aside
}

TEST_CASE("Radiance: what is not supported is named") {
  CHECK(message_of(header("-Y 1 +X 1", "32-bit_rle_xyze") + Bytes{1, 2, 3, 4}) ==
        "x.hdr: has the pixel format \"32-bit_rle_xyze\"; only 32-bit_rle_rgbe is supported");
  for (const std::string resolution :
       {"+Y 1 +X 1", "-Y 1 -X 1", "+X 1 -Y 1", "+X 1 +Y 1", "-Y 1", "", "-Y 1 +X 1 junk",
        "-Y 99999999999999 +X 1", "-Y one +X 1"}) {
    INFO(resolution);
    CHECK(message_of(header(resolution) + Bytes{1, 2, 3, 4}) ==
          "x.hdr: has the resolution line \"" + resolution +
              "\"; only \"-Y height +X width\" is supported");
  }
  CHECK(message_of(header("-Y 0 +X 1")) == "x.hdr: has no pixels (1 x 0)");
  CHECK(message_of(header("-Y 4 +X -1")) == "x.hdr: has no pixels (-1 x 4)");
  CHECK(message_of(header("-Y 40000 +X 40000")).find("claims 40000 x 40000 pixels") !=
        std::string::npos);
}

TEST_CASE("Radiance: a header that lies about an allowed size fails without its memory") {
  // Decoded, this would be 3 GiB.
  CHECK(message_of(header("-Y 16384 +X 16384") + Bytes{128, 64, 32, 129}) ==
        "x.hdr: ends in the middle of its pixels");
}

TEST_CASE("Radiance: damaged runs") {
  const Bytes start = header("-Y 1 +X 8");
  CHECK(message_of(start + Bytes{2, 2, 0, 8, 128 + 9, 7}) ==
        "x.hdr: is damaged: a run leaves its row");
  CHECK(message_of(start + Bytes{2, 2, 0, 8, 0, 7}) == "x.hdr: is damaged: a run leaves its row");
  CHECK(message_of(start + Bytes{1, 1, 1, 3}) ==
        "x.hdr: is damaged: a run without a pixel to repeat");
  CHECK(message_of(start + Bytes{5, 5, 5, 129, 1, 1, 1, 8}) ==
        "x.hdr: is damaged: a run leaves its row");
}

TEST_CASE("Radiance: every truncation and many bit flips end in an image or an ImageError") {
  const Bytes whole = header("-Y 3 +X 40") + component_row(40, {128, 64, 32, 129}, true) +
                      component_row(40, {1, 2, 3, 136}, false) +
                      component_row(40, {9, 8, 7, 130}, true);
  CHECK(decode_radiance_hdr(whole, "x.hdr").rgb.size() == 3 * 40 * 3);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    CHECK_THROWS_AS(decode_radiance_hdr(part, "x.hdr"), ImageError);
  }
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = whole;
    for (int flips = 0; flips < 3; ++flips) {
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1u << (random() % 8));
    }
    try {
      const Panorama image = decode_radiance_hdr(bytes, "x.hdr");
      CHECK(image.rgb.size() ==
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
    } catch (const ImageError&) {
    }
  }
}

}  // namespace
}  // namespace lobelight
