#include <ImfChromaticities.h>
#include <ImfEnvmap.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "exr_files.h"
#include "image/exr.h"
#include "image/image_error.h"

// Which channels are colours, and what they are converted to.

namespace lobelight {
namespace {

using namespace testing;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using Value = std::function<float(int x, int y)>;

// A scan-line file of floats, in the header's data window and with the sampling of its channels.
Bytes file_of(Imf::Header header, const std::map<std::string, Value>& channels) {
  const Imath::Box2i window = header.dataWindow();
  std::map<std::string, std::vector<float>> store;
  Imf::FrameBuffer buffer;
  for (const auto& [name, value] : channels) {
    if (!header.channels().findChannel(name)) {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    }
    const Imf::Channel& channel = *header.channels().findChannel(name);
    std::vector<float>& values = store[name];
    int columns = 0;
    for (int y = window.min.y; y <= window.max.y; y += channel.ySampling) {
      columns = 0;
      for (int x = window.min.x; x <= window.max.x; x += channel.xSampling, ++columns) {
        values.push_back(value(x, y));
      }
    }
    buffer.insert(name,
                  Imf::Slice::Make(Imf::FLOAT, values.data(), window.min,
                                   window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
                                   sizeof(float), static_cast<std::size_t>(columns) * sizeof(float),
                                   channel.xSampling, channel.ySampling));
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(window.max.y - window.min.y + 1);
  }
  return bytes_of(stream);
}

Value constant(float value) {
  return [value](int, int) { return value; };
}

TEST_CASE("decode_exr: r, g, b and red, green, blue are colours too") {
  const std::array<std::array<const char*, 3>, 6> spellings = {
      {{"r", "g", "b"},
       {"red", "green", "blue"},
       {"Red", "Green", "Blue"},
       {"RED", "GREEN", "BLUE"},
       {"beauty.red", "beauty.green", "beauty.blue"},
       {"a.b.r", "a.b.G", "a.b.Blue"}}};
  for (const auto& names : spellings) {
    INFO(names[0]);
    const Bytes bytes = file_of(Imf::Header(8, 4), {{names[0], constant(1.0f)},
                                                    {names[1], constant(2.0f)},
                                                    {names[2], constant(3.0f)},
                                                    {"Z", constant(9.0f)}});
    const Panorama image = decode_exr(bytes, "map.exr");
    CHECK(image.rgb[0] == 1.0f);
    CHECK(image.rgb[1] == 2.0f);
    CHECK(image.rgb[2] == 3.0f);
    CHECK(image.warnings.empty());
  }
  // The plain capitals are what is meant where there are several.
  const Bytes both = file_of(Imf::Header(8, 4), {{"R", constant(1.0f)},
                                                 {"G", constant(2.0f)},
                                                 {"B", constant(3.0f)},
                                                 {"r", constant(7.0f)},
                                                 {"red", constant(8.0f)}});
  CHECK(decode_exr(both, "map.exr").rgb[0] == 1.0f);
  // A letter alone is no colour.
  check_refused(file_of(Imf::Header(8, 4), {{"r", constant(1.0f)}, {"g", constant(1.0f)}}),
                "has none of the channels R, G, B and Y, but g, r");
}

TEST_CASE("decode_exr: coordinates are not taken for luminance") {
  const Value value = constant(1.0f);
  check_refused(file_of(Imf::Header(8, 4), {{"X", value}, {"Y", value}, {"Z", value}}),
                "has no colours but coordinates, such as positions or normals (X, Y, Z); save CIE "
                "XYZ as R, G and B");
  check_refused(file_of(Imf::Header(8, 4), {{"N.x", value}, {"N.y", value}, {"N.z", value}}),
                "has no colours but coordinates");
  check_refused(file_of(Imf::Header(8, 4), {{"motion.X", value}, {"motion.Y", value}}),
                "has no colours but coordinates");
  const Bytes passes = file_of(
      Imf::Header(8, 4), {{"N.X", value}, {"N.Y", value}, {"N.Z", value}, {"light.Y", value}});
  CHECK(exr_layers(passes, "map.exr") == std::vector<std::string>{"light"});
  // Depth beside luminance is no coordinate.
  const Bytes depth = file_of(Imf::Header(8, 4), {{"Y", constant(2.0f)}, {"Z", constant(5.0f)}});
  CHECK(decode_exr(depth, "map.exr").rgb[0] == 2.0f);
}

TEST_CASE("decode_exr: missing channels are named") {
  const Panorama image = decode_exr(
      file_of(Imf::Header(8, 4), {{"R", constant(1.0f)}, {"B", constant(1.0f)}}), "map.exr");
  CHECK(image.warnings == std::vector<std::string>{"has no green channel, which is 0"});
}

// Some radiance over three orders of magnitude, in Rec. 709.
Imath::V3f colour_at(int x, int y) {
  const float phase = 0.4f * static_cast<float>(x) + 0.9f * static_cast<float>(y);
  const float scale = std::exp2(static_cast<float>(x - 8) / 2.0f);
  return Imath::V3f(1.5f + std::sin(phase), 1.2f + std::cos(phase), 0.8f) * scale;
}

Imf::Chromaticities cie_xyz() { return {{1, 0}, {0, 1}, {0, 0}, {1.0f / 3, 1.0f / 3}}; }

void check_colours(const Panorama& image, double tolerance) {
  REQUIRE(image.width == 16);
  REQUIRE(image.height == 8);
  double worst = 0.0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const Imath::V3f expected = colour_at(x, y);
      const float* rgb = &image.rgb[static_cast<std::size_t>(3 * (16 * y + x))];
      for (int c = 0; c < 3; ++c) {
        const double error = static_cast<double>(rgb[c] - expected[c]);
        worst = std::max(worst, std::abs(error) / static_cast<double>(expected.length()));
      }
    }
  }
  CHECK(worst < tolerance);
}

// One picture in both spaces, by OpenEXR's own matrix.
TEST_CASE("decode_exr: a picture in CIE XYZ is the one in Rec. 709") {
  const Imath::M44f to_xyz = Imf::RGBtoXYZ(Imf::Chromaticities(), 1.0f);
  const auto component = [&](int c, bool in_xyz) {
    return [=](int x, int y) { return (in_xyz ? colour_at(x, y) * to_xyz : colour_at(x, y))[c]; };
  };
  for (const bool in_xyz : {false, true}) {
    Imf::Header header(16, 8);
    if (in_xyz) Imf::addChromaticities(header, cie_xyz());
    const Panorama image = decode_exr(file_of(header, {{"R", component(0, in_xyz)},
                                                       {"G", component(1, in_xyz)},
                                                       {"B", component(2, in_xyz)}}),
                                      "map.exr");
    check_colours(image, 1e-5);
    CHECK(image.notes.size() == (in_xyz ? 1 : 0));
    if (in_xyz) CHECK(image.notes[0] == "was converted from CIE XYZ to Rec. 709");
  }
  // In luminance and chroma Y is Y.
  Imf::Header header(16, 8);
  Imf::addChromaticities(header, cie_xyz());
  const auto chroma = [&](int c) {
    return [=](int x, int y) {
      const Imath::V3f xyz = colour_at(x, y) * to_xyz;
      return (xyz[c] - xyz.y) / xyz.y;
    };
  };
  check_colours(
      decode_exr(file_of(header, {{"Y", component(1, true)}, {"RY", chroma(0)}, {"BY", chroma(2)}}),
                 "map.exr"),
      1e-5);
}

TEST_CASE("decode_exr reads chroma at full resolution, and at any other") {
  const Imath::V3f weights(0.2126f, 0.7152f, 0.0722f);
  const auto luminance = [&](int x, int y) { return colour_at(x, y).dot(weights); };
  // The weights of the chromaticities that files without any have are Rec. 709's, rounded here.
  const auto chroma = [&](int c) {
    return [=](int x, int y) { return colour_at(x, y)[c] / luminance(x, y) - 1.0f; };
  };
  check_colours(decode_exr(file_of(Imf::Header(16, 8),
                                   {{"Y", luminance}, {"RY", chroma(0)}, {"BY", chroma(2)}}),
                           "map.exr"),
                1e-3);
  // Chroma that changes linearly is what it was, up to the last stored value.
  for (const Imath::V2i& step : {Imath::V2i(2, 2), Imath::V2i(4, 1), Imath::V2i(1, 2)}) {
    INFO(step.x, " x ", step.y);
    Imf::Header header(17, 9);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.channels().insert("RY", Imf::Channel(Imf::FLOAT, step.x, step.y));
    header.channels().insert("BY", Imf::Channel(Imf::FLOAT, step.x, step.y));
    // OpenEXR wants the sizes of the window to be multiples of the steps.
    header.dataWindow() = header.displayWindow() = Imath::Box2i({0, 0}, {15, 7});
    const auto linear = [](int x, int y) {
      return 0.02f * static_cast<float>(x) + 0.03f * static_cast<float>(y);
    };
    const Panorama image = decode_exr(
        file_of(header, {{"Y", constant(2.0f)}, {"RY", linear}, {"BY", linear}}), "map.exr");
    for (int y = 0; y <= 8 - step.y; ++y) {
      for (int x = 0; x <= 16 - step.x; ++x) {
        const float* rgb = &image.rgb[static_cast<std::size_t>(3 * (16 * y + x))];
        CHECK(rgb[0] == doctest::Approx(2.0f * (1.0f + linear(x, y))).epsilon(1e-5));
        CHECK(rgb[2] == doctest::Approx(2.0f * (1.0f + linear(x, y))).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("decode_exr: an overflow stays infinite whatever the colours are converted from") {
  const auto sun = [](float beside) {
    return [beside](int x, int) { return x == 3 ? kInfinity : beside; };
  };
  for (const bool in_xyz : {false, true}) {
    Imf::Header header(8, 4);
    if (in_xyz) Imf::addChromaticities(header, cie_xyz());
    Panorama image = decode_exr(
        file_of(header, {{"R", sun(0.9505f)}, {"G", sun(1.0f)}, {"B", sun(1.089f)}}), "map.exr");
    CHECK(image.rgb[9] == kInfinity);
    CHECK(image.sanitise() == 4);
    for (std::size_t c = 9; c < 12; ++c) CHECK(image.rgb[c] == 65504.0f);
    // One channel alone overflowed.
    image = decode_exr(
        file_of(header, {{"R", constant(1.0f)}, {"G", sun(1.0f)}, {"B", constant(1.0f)}}),
        "map.exr");
    CHECK(image.rgb[10] == kInfinity);
    CHECK(std::isfinite(image.rgb[9]));
  }
  Panorama image =
      decode_exr(file_of(Imf::Header(8, 4),
                         {{"Y", sun(1.0f)}, {"RY", constant(0.1f)}, {"BY", constant(-0.1f)}}),
                 "map.exr");
  for (std::size_t c = 9; c < 12; ++c) CHECK(image.rgb[c] == kInfinity);
  // Chroma that is no number: the texel counts as such.
  image =
      decode_exr(file_of(Imf::Header(8, 4),
                         {{"Y", constant(1.0f)}, {"RY", constant(kNan)}, {"BY", constant(0.0f)}}),
                 "map.exr");
  CHECK(image.sanitise() == 32);
}

TEST_CASE("decode_exr: of an environment map the data window goes around") {
  Imf::Header header(8, 4);
  header.dataWindow() = Imath::Box2i({2, 1}, {13, 6});
  const auto column = [](int x, int) { return static_cast<float>(x); };
  Panorama image =
      decode_exr(file_of(header, {{"R", column}, {"G", column}, {"B", column}}), "map.exr");
  CHECK(image.width == 8);
  CHECK(image.warnings ==
        std::vector<std::string>{"fills 56.2 % of its display window; the rest is black"});
  CHECK(image.notes ==
        std::vector<std::string>{"has pixels beyond its display window, which are cut"});
  Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  image = decode_exr(file_of(header, {{"R", column}, {"G", column}, {"B", column}}), "map.exr");
  CHECK(image.width == 12);
  CHECK(image.height == 6);
  CHECK(image.rgb[0] == 2.0f);
  CHECK(image.rgb.back() == 13.0f);
  CHECK(image.warnings.empty());
  CHECK(image.notes.empty());
}

TEST_CASE("decode_exr names attributes that it leaves aside") {
  Imf::Header header(8, 4);
  header.pixelAspectRatio() = 2.0f;
  Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  Imf::addWhiteLuminance(header, 100.0f);
  Imf::addAdoptedNeutral(header, {0.3f, 0.3f});
  Imf::addWorldToCamera(header, Imath::M44f());
  const Panorama image = decode_exr(file_of(header, {{"Y", constant(1.0f)}}), "map.exr");
  CHECK(image.notes == std::vector<std::string>{"has a pixelAspectRatio, which is left aside",
                                                "has a whiteLuminance, which is left aside",
                                                "has an adoptedNeutral, which is left aside",
                                                "has a worldToCamera, which is left aside"});
}

// The smallest files of each kind: scan lines with and without compression, tiles, chroma, parts.
std::vector<Bytes> small_files() {
  std::vector<Bytes> files;
  const auto ramp = [](int x, int y) { return static_cast<float>(x + 4 * y); };
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::DWAA_COMPRESSION}) {
    Imf::Header header(4, 2);
    header.compression() = compression;
    Imf::addChromaticities(header, cie_xyz());
    files.push_back(file_of(header, {{"R", ramp}, {"G", ramp}, {"B", ramp}}));
  }
  Imf::Header chroma(4, 2);
  chroma.channels().insert("Y", Imf::Channel(Imf::HALF));
  chroma.channels().insert("RY", Imf::Channel(Imf::FLOAT, 2, 2));
  chroma.channels().insert("BY", Imf::Channel(Imf::FLOAT, 2, 2));
  chroma.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  files.push_back(file_of(chroma, {{"Y", ramp}, {"RY", ramp}, {"BY", ramp}}));
  Imf::Header tiles = header_for({{"Y"}});
  tiles.dataWindow() = tiles.displayWindow() = Imath::Box2i({0, 0}, {3, 1});
  files.push_back(tiled_file({{"Y"}}, tiles, Imf::MIPMAP_LEVELS));
  std::vector<Imf::Header> parts(2, Imf::Header(4, 2));
  for (Imf::Header& part : parts) {
    part.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    part.setType(Imf::SCANLINEIMAGE);
  }
  parts[0].setName("left");
  parts[1].setName("right");
  Imf::StdOSStream stream;
  {
    std::vector<float> values(8, 1.0f);
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), Imath::V2i(0, 0), 4, 2));
    Imf::MultiPartOutputFile file(stream, parts.data(), 2, false, 0);
    for (int i = 0; i < 2; ++i) {
      Imf::OutputPart part(file, i);
      part.setFrameBuffer(buffer);
      part.writePixels(2);
    }
  }
  files.push_back(bytes_of(stream));
  return files;
}

// Whether a file is read in full, or refused in one sentence with its name that ends with no full
// stop and does not speak of opening a file that is open.
bool is_handled(const Bytes& bytes, std::string& message) {
  message.clear();
  try {
    const Panorama image = decode_exr(bytes, "map.exr");
    return image.rgb.size() ==
           static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
  } catch (const ImageError& error) {
    message = error.what();
  }
  return message.rfind("map.exr: ", 0) == 0 && message.find("map.exr", 1) == std::string::npos &&
         message.find("Unable to open") == std::string::npos &&
         std::none_of(message.begin(), message.end(),
                      [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; });
}

TEST_CASE("decode_exr: every truncation and every changed byte end in an image or a sentence") {
  std::string message;
  for (const Bytes& whole : small_files()) {
    REQUIRE(is_handled(whole, message));
    REQUIRE(message.empty());
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
      const bool is_good = is_handled(part, message);
      INFO(length, " of ", whole.size(), " bytes: ", message);
      CHECK(is_good);
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const int change : {0x01, 0x80, 0xff}) {
        Bytes bytes = whole;
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ change);
        const bool is_good = is_handled(bytes, message);
        INFO("byte ", at, " of ", whole.size(), " ^ ", change, ": ", message);
        CHECK(is_good);
      }
    }
  }
}

}  // namespace
}  // namespace lobelight
