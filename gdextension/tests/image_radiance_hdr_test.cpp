#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

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

Bytes with_header(const std::string& text, const Bytes& pixels) {
  return Bytes(text.begin(), text.end()) + pixels;
}

Panorama decoded(const Bytes& bytes) { return decode_radiance_hdr(bytes, "x.hdr"); }

TEST_CASE("Radiance: headers as people write them") {
  const Bytes red = {128, 0, 0, 129};
  const std::vector<float> one_red = {1.0f, 0.0f, 0.0f};
  for (const std::string text : {
           "#?RGBE\r\n\r\n-Y 1 +X 1\r\n",                          // carriage returns, no FORMAT
           "#?RADIANCE\nFORMAT= 32-bit_rle_rgbe \n\n-Y 1 +X 1\n",  // spaces around the value
           "#?RADIANCE\nFORMAT = 32-bit_rle_rgbe\n\n-Y 1 +X 1\n",  // and around the sign
           "#?RADIANCE\n\tFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n",  // of a source alone
           "#?RADIANCE\n \n  -Y  1 \t+X 1  \n",                    // spaces around the sizes
           "#?RADIANCE\n# FORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n",  // a comment
           "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\tEXPOSURE=2\n\tFORMAT=32-bit_rle_xyze\n\n"
           "-Y 1 +X 1\n",  // lines of a source
           "#?RADIANCE\npcomb -e ro=ri(1)*EXPOSURE=2 a.hdr\nEXPOSURE=1.0\n\n-Y 1 +X 1\n",
       }) {
    INFO(text);
    const Panorama image = decoded(with_header(text, red));
    CHECK(image.rgb == one_red);
    CHECK(image.notes.empty());
    CHECK(image.warnings.empty());
  }
}

std::string remarks_of(const std::string& variables) {
  const Panorama image =
      decoded(with_header("#?RADIANCE\n" + variables + "\n\n-Y 1 +X 1\n", {128, 0, 0, 129}));
  std::string text;
  for (const auto& remarks : {image.notes, image.warnings}) {
    for (const std::string& remark : remarks) text += (text.empty() ? "" : "; ") + remark;
  }
  return text;
}

TEST_CASE("Radiance: what the header says of the pixels is named, and the pixels stay") {
  // EXPOSUREs are multiplied; the radiance is the pixel by the exposure: 2^2 too little here.
  CHECK(remarks_of("EXPOSURE=0.5\nEXPOSURE= 5.0e-1 ") ==
        "has an EXPOSURE of 0.25, which is left aside; an Exposure of +2.00 EV takes it back");
  CHECK(remarks_of("COLORCORR= 1 0.5 2\nCOLORCORR=1 1 2") ==
        "has a COLORCORR of 1, 0.5, 4, which is left aside");
  CHECK(remarks_of("PIXASPECT=0.5") == "has a PIXASPECT of 0.5, which is left aside");
  CHECK(remarks_of("GAMMA=2.2").find("has a GAMMA of 2.2, which is left aside") == 0);
  CHECK(remarks_of("GAMMA=1").empty());
  CHECK(remarks_of("VIEW= -vta -vp 0 0 0 -vh 360 -vv 360") ==
        "has a VIEW that is an angular fisheye, but is read as a latitude-longitude panorama");
  CHECK(remarks_of("VIEW=-vh 45").find("has a VIEW that is a perspective") == 0);
  for (const std::string damaged : {"EXPOSURE=", "EXPOSURE=a", "EXPOSURE=1e999", "COLORCORR=2",
                                    "PRIMARIES=1 2 3", "=", "VIEW"}) {
    INFO(damaged);
    CHECK(remarks_of(damaged).empty());
  }
  CHECK(remarks_of("EXPOSURE=0") == "has an EXPOSURE of 0, which is left aside");
}

TEST_CASE("Radiance: PRIMARIES are converted, XYZE as the tristimulus values that it holds") {
  const std::string start = "#?RADIANCE\nPRIMARIES=";
  const auto with_primaries = [&](const std::string& primaries, const Bytes& pixel) {
    return decoded(with_header(start + primaries + "\n\n-Y 1 +X 1\n", pixel));
  };
  // Rec. 2020's red in Rec. 709 is the first column of ITU-R BT.2087-0's matrix.
  const Panorama wide =
      with_primaries(".708 .292 .170 .797 .131 .046 .3127 .3290", {128, 0, 0, 129});
  CHECK(wide.rgb[0] == doctest::Approx(1.6605).epsilon(2e-3));
  CHECK(wide.rgb[1] == doctest::Approx(-0.1246).epsilon(2e-3));
  CHECK(wide.notes == std::vector<std::string>{"was converted from its PRIMARIES to Rec. 709"});
  const Panorama same = with_primaries(".64 .33 .30 .60 .15 .06 .3127 .3290", {128, 0, 0, 129});
  CHECK(same.rgb == std::vector<float>{1.0f, 0.0f, 0.0f});
  CHECK(same.notes.empty());
  CHECK(message_of(with_header(start + "0 0 0 0 0 0 0 0\n\n-Y 1 +X 1\n", {1, 2, 3, 4})) ==
        "x.hdr: has PRIMARIES that span no colours");

  // XYZ (1, 1, 1): the sums of the rows of IEC 61966-2-1's matrix from XYZ to linear sRGB.
  const Panorama xyze = decoded(header("-Y 1 +X 1", "32-bit_rle_xyze") + Bytes{128, 128, 128, 129});
  const float equal_energy[] = {3.2406f - 1.5372f - 0.4986f, -0.9689f + 1.8758f + 0.0415f,
                                0.0557f - 0.2040f + 1.0570f};
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(xyze.rgb[c] == doctest::Approx(equal_energy[c]).epsilon(1e-3));
  }
  CHECK(xyze.notes == std::vector<std::string>{"was converted from CIE XYZ to Rec. 709"});
}

TEST_CASE("Radiance: all eight orientations show the same picture") {
  constexpr int kColumns = 9, kRows = 5;  // wide enough for the new run-length coding
  const auto red_at = [](int x, int y) { return static_cast<std::uint8_t>(1 + x + kColumns * y); };
  for (const std::string outer : {"-Y", "+Y", "-X", "+X"}) {
    for (const std::string sign : {"-", "+"}) {
      const bool by_columns = outer[1] == 'X';
      const std::string inner = sign + (by_columns ? "Y" : "X");
      const int lines = by_columns ? kColumns : kRows, length = by_columns ? kRows : kColumns;
      Bytes bytes =
          header(outer + " " + std::to_string(lines) + " " + inner + " " + std::to_string(length));
      for (int n = 0; n < lines; ++n) {
        Bytes reds;
        for (int i = 0; i < length; ++i) {
          // A coordinate grows with the count where its sign is +; y counts from the bottom.
          int x = by_columns ? n : i, y = by_columns ? i : n;
          if ((by_columns ? outer : inner)[0] == '-') x = kColumns - 1 - x;
          if ((by_columns ? inner : outer)[0] == '+') y = kRows - 1 - y;
          reds.push_back(red_at(x, y));
        }
        if (length >= 8) {
          bytes = bytes + Bytes{2, 2, 0, static_cast<std::uint8_t>(length),
                                static_cast<std::uint8_t>(length)};
          bytes = bytes + reds;
          for (const int value : {2, 3, 136}) {
            bytes = bytes + Bytes{static_cast<std::uint8_t>(128 + length),
                                  static_cast<std::uint8_t>(value)};
          }
        } else {
          for (const std::uint8_t red : reds) bytes = bytes + Bytes{red, 2, 3, 136};
        }
      }
      INFO(outer, inner);
      const Panorama image = decoded(bytes);
      REQUIRE(image.width == kColumns);
      REQUIRE(image.height == kRows);
      int wrong = 0;
      for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x) {
          const std::size_t texel = 3 * static_cast<std::size_t>(y * kColumns + x);
          wrong += image.rgb[texel] == static_cast<float>(red_at(x, y)) ? 0 : 1;
          wrong += image.rgb[texel + 2] == 3.0f ? 0 : 1;
        }
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("Radiance: flat pixels that look like runs") {
  constexpr int kColumns = 16;
  Bytes flat;
  for (int i = 0; i < 2 * kColumns; ++i) {
    flat = flat + Bytes{200, 100, static_cast<std::uint8_t>(i), 136};
  }
  const auto decode_with = [&](std::size_t at, const Bytes& pixel) {
    Bytes pixels = flat;
    std::copy(pixel.begin(), pixel.end(), pixels.begin() + static_cast<std::ptrdiff_t>(4 * at));
    const Panorama image = decoded(header("-Y 2 +X 16") + pixels);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(image.rgb[3 * at + i] == std::ldexp(static_cast<float>(pixel[i]), pixel[3] - 136));
    }
    CHECK(image.rgb[3 * 31 + 2] == 31.0f);
  };
  decode_with(0, {2, 2, 0, 16});   // the marker of the new coding
  decode_with(16, {2, 2, 0, 16});  // in the second row
  // What else looks like a run has no size that gives it away, but for the whole file's.
  Bytes marked = flat;
  marked[0] = 2, marked[1] = 2, marked[2] = 0, marked[3] = 16;
  marked.push_back('\n');
  CHECK(message_of(header("-Y 2 +X 16") + marked).find("is damaged: a run goes beyond") !=
        std::string::npos);
}

TEST_CASE("Radiance: what is not supported is named") {
  CHECK(message_of(header("-Y 1 +X 1", "32-bit_rle_luv") + Bytes{1, 2, 3, 4}) ==
        "x.hdr: has the pixel format \"32-bit_rle_luv\"; only 32-bit_rle_rgbe and 32-bit_rle_xyze "
        "are supported");
  for (const std::string resolution :
       {"+Y 1 +Y 1", "-Y 1 -Z 1", "Y 1 X 1", "-Y 1", "", "-Y 1 +X 1 junk", "-Y 99999999999999 +X 1",
        "-Y one +X 1", "-Y 1 +X 1x"}) {
    INFO(resolution);
    CHECK(message_of(header(resolution) + Bytes{1, 2, 3, 4}) ==
          "x.hdr: has the resolution line \"" + resolution +
              "\" instead of one such as \"-Y 512 +X 1024\"");
  }
  CHECK(message_of(header("-Y 0 +X 1")) == "x.hdr: has no pixels (1 x 0)");
  CHECK(message_of(header("-Y 4 +X -1")) == "x.hdr: has no pixels (-1 x 4)");
  CHECK(message_of(header("-Y 40000 +X 40000")).find("claims 40000 x 40000 pixels") !=
        std::string::npos);
  CHECK(message_of(Bytes{'#', '?', 'R'}) == "x.hdr: is damaged: its header does not end");
  const std::string endless(1 << 17, '=');
  CHECK(message_of(with_header("#?RADIANCE\n" + endless + "\n\n-Y 1 +X 1\n", {1, 2, 3, 4})) ==
        "x.hdr: has a header of more than 64 KiB");
}

TEST_CASE("Radiance: a header that lies about an allowed size fails without its memory") {
  // Decoded, this would be 3 GiB.
  CHECK(message_of(header("-Y 16384 +X 16384") + Bytes{128, 64, 32, 129}) ==
        "x.hdr: is damaged: it ends within scan line 1 of 16384");
}

TEST_CASE("Radiance: damaged runs, and the line that they are in") {
  const Bytes start = header("-Y 1 +X 8");
  CHECK(message_of(start + Bytes{2, 2, 0, 8, 128 + 9, 7}) ==
        "x.hdr: is damaged: a run goes beyond the end of scan line 1 of 1");
  CHECK(message_of(start + Bytes{2, 2, 0, 8, 0, 7}) ==
        "x.hdr: is damaged: there is a run of no pixels in scan line 1 of 1");
  CHECK(message_of(start + Bytes{1, 1, 1, 3}) ==
        "x.hdr: is damaged: a run has no pixel to repeat in scan line 1 of 1");
  CHECK(message_of(start + Bytes{5, 5, 5, 129, 1, 1, 1, 8}) ==
        "x.hdr: is damaged: a run goes beyond the end of scan line 1 of 1");
  CHECK(message_of(header("-Y 3 +X 8") + component_row(8, {1, 2, 3, 136}, true) +
                   Bytes{2, 2, 0, 8, 130}) == "x.hdr: is damaged: it ends within scan line 2 of 3");
}

// Whether a file is read in full or refused in a line of text with its name.
bool is_handled(const Bytes& bytes) {
  try {
    const Panorama image = decode_radiance_hdr(bytes, "x.hdr");
    return image.rgb.size() ==
           static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
  } catch (const ImageError& error) {
    const std::string message = error.what();
    return message.rfind("x.hdr: ", 0) == 0 &&
           std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; });
  }
}

TEST_CASE("Radiance: every truncation and every changed byte end in an image or a sentence") {
  const Bytes whole = with_header(
                          "#?RADIANCE\nEXPOSURE=2\nPRIMARIES=.7 .3 .2 .7 .1 .1 .3 .3\nVIEW=-vta\n"
                          "FORMAT=32-bit_rle_rgbe\n\n+X 3 -Y 40\n",
                          {}) +
                      component_row(40, {128, 64, 32, 129}, true) +
                      component_row(40, {1, 2, 3, 136}, false) + Bytes{9, 8, 7, 130, 1, 1, 1, 39};
  REQUIRE(decoded(whole).rgb.size() == 3 * 40 * 3);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    INFO(length);
    CHECK(is_handled(part));
    CHECK_THROWS_AS(decoded(part), ImageError);
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    int unhandled = 0;
    for (int value = 0; value < 256; ++value) {
      Bytes bytes = whole;
      bytes[at] = static_cast<std::uint8_t>(value);
      unhandled += is_handled(bytes) ? 0 : 1;
    }
    INFO(at);
    CHECK(unhandled == 0);
  }
}

}  // namespace
}  // namespace lobelight
