#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <doctest/doctest.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>

#include "exr_files.h"
#include "image/exr.h"
#include "image/file_io.h"
#include "image/image_error.h"

namespace lobelight {
namespace {

using namespace testing;

struct Tolerance {
  double relative;
  double absolute;
};

// What each compression may change of such a picture (OpenEXR's technical introduction).
Tolerance tolerance_of(Imf::Compression compression, Imf::PixelType type) {
  switch (compression) {
    case Imf::PXR24_COMPRESSION:
      return type == Imf::HALF ? Tolerance{0, 0} : Tolerance{1e-4, 0};
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
      return type == Imf::HALF ? Tolerance{0.1, 0.1} : Tolerance{0, 0};
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION:
      return {0.1, 0.1};
    default:
      return {0, 0};
  }
}

void check_picture(const Panorama& image, const Tolerance& tolerance) {
  REQUIRE(image.width == kWidth);
  REQUIRE(image.height == kHeight);
  REQUIRE(image.rgb.size() == kWidth * kHeight * 3);
  double worst = 0.0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = image.rgb[static_cast<std::size_t>(3 * (y * kWidth + x)) + c];
        const float expected = value_at(x, y, c);
        const double allowed = tolerance.relative * expected + tolerance.absolute;
        worst = std::max(worst, std::abs(static_cast<double>(value - expected)) - allowed);
      }
    }
  }
  CHECK(worst <= 0.0);
}

TEST_CASE("decode_exr reads every compression, scan lines and tiles, half and float") {
  for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
    const Imf::Compression compression = static_cast<Imf::Compression>(c);
    for (const auto& channels : {kRgb, kFloatRgb}) {
      const Imf::PixelType type = channels.front().type;
      const Imf::Header header = header_for(channels, compression);
      const Tolerance tolerance = tolerance_of(compression, type);
      INFO("compression ", c, type == Imf::HALF ? ", half" : ", float");
      check_picture(decode_exr(scan_line_file(channels, header), "map.exr"), tolerance);
      for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        INFO("level mode ", static_cast<int>(mode));
        check_picture(decode_exr(tiled_file(channels, header, mode), "map.exr"), tolerance);
      }
    }
  }
}

TEST_CASE("decode_exr: rows stored from the bottom up") {
  Imf::Header header = header_for(kRgb);
  header.lineOrder() = Imf::DECREASING_Y;
  check_picture(decode_exr(scan_line_file(kRgb, header), "map.exr"), {0, 0});
}

TEST_CASE("decode_exr leaves alpha and further channels aside") {
  const std::vector<Channel> channels = {
      {"R"}, {"G"}, {"B"}, {"A"}, {"Z", Imf::FLOAT}, {"id", Imf::UINT}, {"diffuse.R"}};
  check_picture(decode_exr(scan_line_file(channels, header_for(channels)), "map.exr"), {0, 0});
}

TEST_CASE("decode_exr: luminance becomes grey") {
  const std::vector<Channel> channels = {{"Y", Imf::FLOAT}};
  const Panorama image = decode_exr(scan_line_file(channels, header_for(channels)), "map.exr");
  const std::size_t texel = 3 * (17 * kWidth + 5);
  for (std::size_t c = 0; c < 3; ++c) CHECK(image.rgb[texel + c] == value_at(5, 17, 0));
}

TEST_CASE("decode_exr gives the display window: padded with 0, cut where the data goes beyond") {
  struct Case {
    Imath::Box2i display;
    Imath::Box2i data;
  };
  const auto box = [](int left, int top, int right, int bottom) {
    return Imath::Box2i(Imath::V2i(left, top), Imath::V2i(right, bottom));
  };
  const Case cases[] = {
      {box(0, 0, 29, 19), box(5, 4, 20, 15)},           // smaller
      {box(0, 0, 29, 19), box(-7, -9, 40, 300)},        // larger, over more than one band of rows
      {box(0, 0, 29, 299), box(10, -20, 60, 270)},      // shifted
      {box(-100, 50, -71, 69), box(-90, 40, -60, 60)},  // with its origin elsewhere
  };
  for (const Case& c : cases) {
    for (const bool tiled : {false, true}) {
      Imf::Header header = header_for(kRgb);
      header.displayWindow() = c.display;
      header.dataWindow() = c.data;
      const Panorama image = decode_exr(
          tiled ? tiled_file(kRgb, header, Imf::ONE_LEVEL) : scan_line_file(kRgb, header),
          "map.exr");
      REQUIRE(image.width == c.display.max.x - c.display.min.x + 1);
      REQUIRE(image.height == c.display.max.y - c.display.min.y + 1);
      int wrong = 0;
      for (int y = c.display.min.y; y <= c.display.max.y; ++y) {
        for (int x = c.display.min.x; x <= c.display.max.x; ++x) {
          const bool inside = c.data.intersects(Imath::V2i(x, y));
          for (std::size_t channel = 0; channel < 3; ++channel) {
            const std::size_t texel = static_cast<std::size_t>((y - c.display.min.y) * image.width +
                                                               (x - c.display.min.x));
            const float expected = inside ? value_at(x, y, channel) : 0.0f;
            wrong += image.rgb[3 * texel + channel] == expected ? 0 : 1;
          }
        }
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("decode_exr refuses windows that do not go together and absurd sizes") {
  Imf::Header apart = header_for(kRgb);
  apart.displayWindow() = Imath::Box2i(Imath::V2i(100, 100), Imath::V2i(200, 200));
  check_refused(scan_line_file(kRgb, apart), "no pixels in its display window");
  Imf::Header lost = header_for(kRgb);
  lost.displayWindow() = Imath::Box2i(Imath::V2i(0, 0), Imath::V2i(9999, 9999));
  check_refused(scan_line_file(kRgb, lost), "less than 1/64 of its display window");
  for (const Imath::V2i& corner : {Imath::V2i(40000, 40000), Imath::V2i(1 << 20, 3)}) {
    // Without pixels: the header alone must do.
    Imf::Header huge = header_for(kRgb);
    huge.displayWindow() = huge.dataWindow() = Imath::Box2i(Imath::V2i(0, 0), corner);
    Imf::StdOSStream stream;
    { Imf::OutputFile file(stream, huge, 0); }
    check_refused(bytes_of(stream), "pixels; the limits are");
  }
}

TEST_CASE("decode_exr: a header that lies about an allowed size fails without its memory") {
  // Decoded, this would be 3 GiB; the file holds no pixels at all.
  Imf::Header huge = header_for(kRgb);
  huge.displayWindow() = huge.dataWindow() =
      Imath::Box2i(Imath::V2i(0, 0), Imath::V2i(16383, 16383));
  Imf::StdOSStream stream;
  { Imf::OutputFile file(stream, huge, 0); }
  check_refused(bytes_of(stream), "is damaged or not supported");
}

TEST_CASE("decode_exr names the channels that it cannot use") {
  const auto refuse = [](const std::vector<Channel>& channels, const std::string& reason) {
    check_refused(scan_line_file(channels, header_for(channels)), reason);
  };
  refuse({{"A"}}, "has none of the channels R, G, B and Y, but A");
  refuse({{"Z", Imf::FLOAT}}, "R, G, B and Y, but Z");
  refuse({{" "}}, "R, G, B and Y, but ''");
  refuse({{"a"}, {"b"}, {"c"}, {"d"}, {"e"}, {"f"}, {"g"}, {"h"}}, "a, b, c, d, e, f and 2 more");
}

TEST_CASE("decode_exr: missing channels are dark") {
  const std::vector<Channel> channels = {{"R"}, {"G"}};
  const Panorama image = decode_exr(scan_line_file(channels, header_for(channels)), "map.exr");
  const Panorama red = decode_exr(scan_line_file({{"R"}}, header_for({{"R"}})), "map.exr");
  const std::size_t texel = 3 * (17 * kWidth + 5);
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(image.rgb[texel + c] == (c < 2 ? value_at(5, 17, c) : 0.0f));
    CHECK(red.rgb[texel + c] == (c < 1 ? value_at(5, 17, c) : 0.0f));
  }
}

TEST_CASE("decode_exr: whole numbers, also beside halves, are numbers") {
  const std::vector<Channel> channels = {{"R", Imf::UINT}, {"G"}, {"B", Imf::UINT}};
  const Panorama image = decode_exr(scan_line_file(channels, header_for(channels)), "map.exr");
  for (const std::size_t texel : {0u, 517u, 1300u}) {
    const int x = static_cast<int>(texel) % kWidth, y = static_cast<int>(texel) / kWidth;
    CHECK(image.rgb[3 * texel] == std::floor(value_at(x, y, 0)));
    CHECK(image.rgb[3 * texel + 1] == value_at(x, y, 1));
    CHECK(image.rgb[3 * texel + 2] == std::floor(value_at(x, y, 2)));
  }
}

TEST_CASE("decode_exr: layers, and the first of them where there are no plain channels") {
  const std::vector<Channel> channels = {{"A"},           {"key.R"},   {"key.G"},      {"key.B"},
                                         {"sun.light.Y"}, {"depth.Z"}, {"depth.other"}};
  const Bytes bytes = scan_line_file(channels, header_for(channels));
  CHECK(exr_layers(bytes, "map.exr") == std::vector<std::string>{"key", "sun.light"});
  const std::size_t texel = 17 * kWidth + 5;
  for (const char* layer : {"", "key"}) {
    const Panorama image = decode_exr(bytes, "map.exr", layer);
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(image.rgb[3 * texel + c] == value_at(5, 17, c + 1));
    }
  }
  CHECK(decode_exr(bytes, "map.exr", "sun.light").rgb[3 * texel + 2] == value_at(5, 17, 4));
  CHECK_THROWS_WITH(decode_exr(bytes, "map.exr", "depth"),
                    "map.exr: has no layer 'depth'; its layers are key, sun.light");

  const std::vector<Channel> both = {{"R"}, {"G"}, {"B"}, {"key.R"}};
  const Bytes plain = scan_line_file(both, header_for(both));
  CHECK(exr_layers(plain, "map.exr") == std::vector<std::string>{"", "key"});
  CHECK(decode_exr(plain, "map.exr").rgb[3 * texel + 2] == value_at(5, 17, 2));
}

// Of the colours that ImfRgbaFile reads back; its own filter over chroma differs a little from
// ours.
TEST_CASE("decode_exr reads luminance and chroma") {
  Imf::Header header(Imath::Box2i({0, 0}, {79, 40}), Imath::Box2i({4, 2}, {79, 39}));
  std::vector<Imf::Rgba> written;
  for (int y = 2; y <= 39; ++y) {
    for (int x = 4; x <= 79; ++x) {
      const float phase = 0.05f * static_cast<float>(x) + 0.03f * static_cast<float>(y);
      written.emplace_back(2.0f + std::sin(phase), 1.5f + 0.5f * std::cos(phase), 1.0f);
    }
  }
  Imf::StdOSStream stream;
  {
    Imf::RgbaOutputFile file(stream, header, Imf::WRITE_YC, 0);
    file.setFrameBuffer(written.data() - (2 * 76 + 4), 1, 76);
    file.writePixels(38);
  }
  const Panorama image = decode_exr(bytes_of(stream), "map.exr");
  REQUIRE(image.width == 80);
  REQUIRE(image.height == 41);
  double worst = 0.0;
  for (int y = 6; y < 36; ++y) {
    for (int x = 8; x < 76; ++x) {
      const Imf::Rgba& rgba = written[static_cast<std::size_t>((y - 2) * 76 + x - 4)];
      const float* texel = &image.rgb[static_cast<std::size_t>(3 * (y * 80 + x))];
      worst = std::max({worst, std::abs(static_cast<double>(texel[0] / rgba.r) - 1.0),
                        std::abs(static_cast<double>(texel[1] / rgba.g) - 1.0),
                        std::abs(static_cast<double>(texel[2] / rgba.b) - 1.0)});
    }
  }
  CHECK(worst < 0.01);
  CHECK(image.rgb[3 * 3] == 0.0f);  // left of the data window
}

TEST_CASE("decode_exr refuses subsampled colours") {
  Imf::Header header(40, 40);
  std::vector<half> values(40 * 40, half(1.0f));
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"}) {
    const int sampling = *name == 'G' ? 1 : 2;
    header.channels().insert(name, Imf::Channel(Imf::HALF, sampling, sampling));
    buffer.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), sizeof(half),
                                   40 * sizeof(half), sampling, sampling));
  }
  Imf::StdOSStream subsampled;
  {
    Imf::OutputFile file(subsampled, header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(40);
  }
  check_refused(bytes_of(subsampled),
                "stores channel R at a lower resolution, which is not supported");
}

TEST_CASE("decode_exr converts other primaries") {
  Imf::Header header = header_for(kRgb);
  Imf::addChromaticities(header, Imf::Chromaticities({0.708f, 0.292f}, {0.170f, 0.797f},
                                                     {0.131f, 0.046f}, {0.3127f, 0.3290f}));
  const Panorama image = decode_exr(scan_line_file(kRgb, header), "map.exr");
  const std::size_t texel = 3 * (17 * kWidth + 5);
  // First row of ITU-R BT.2087-0's matrix.
  const double red =
      1.6605 * value_at(5, 17, 0) - 0.5876 * value_at(5, 17, 1) - 0.0728 * value_at(5, 17, 2);
  CHECK(image.rgb[texel] == doctest::Approx(red).epsilon(2e-3));

  Imf::Header same = header_for(kRgb);
  Imf::addChromaticities(same, Imf::Chromaticities());
  check_picture(decode_exr(scan_line_file(kRgb, same), "map.exr"), {0, 0});

  Imf::Header none = header_for(kRgb);
  Imf::addChromaticities(none, Imf::Chromaticities({0, 0}, {0, 0}, {0, 0}, {0, 0}));
  check_refused(scan_line_file(kRgb, none), "chromaticities that span no colours");
}

TEST_CASE("decode_exr refuses cube maps and reads panoramas marked as such") {
  Imf::Header cube = header_for(kRgb);
  Imf::addEnvmap(cube, Imf::ENVMAP_CUBE);
  check_refused(scan_line_file(kRgb, cube), "is a cube map");
  Imf::Header panorama = header_for(kRgb);
  Imf::addEnvmap(panorama, Imf::ENVMAP_LATLONG);
  check_picture(decode_exr(scan_line_file(kRgb, panorama), "map.exr"), {0, 0});
}

TEST_CASE("decode_exr refuses deep data") {
  Imf::Header header = header_for(kRgb, Imf::ZIPS_COMPRESSION);
  header.setType(Imf::DEEPSCANLINE);
  Imf::StdOSStream stream;
  {
    Imf::DeepScanLineOutputFile file(stream, header, 0);
    std::vector<unsigned> counts(kWidth * kHeight, 0u);
    std::vector<char*> pointers(kWidth * kHeight, nullptr);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()),
                                             sizeof(unsigned), kWidth * sizeof(unsigned)));
    for (const Channel& c : kRgb) {
      buffer.insert(c.name, Imf::DeepSlice(Imf::HALF, reinterpret_cast<char*>(pointers.data()),
                                           sizeof(char*), kWidth * sizeof(char*), sizeof(half)));
    }
    file.setFrameBuffer(buffer);
    file.writePixels(kHeight);
  }
  check_refused(bytes_of(stream), "holds deep data");
}

TEST_CASE("decode_exr: parts are layers; a file without any is refused") {
  std::vector<Imf::Header> headers(2, header_for(kRgb));
  headers[0].setName("left");
  headers[1] = header_for({{"R"}, {"sun.R"}});
  headers[1].setName("right");
  for (Imf::Header& header : headers) header.setType(Imf::SCANLINEIMAGE);
  Imf::StdOSStream stream;
  {
    const Pixels left(kRgb, headers[0].dataWindow());
    const Pixels right({{"R"}, {"sun.R"}}, headers[1].dataWindow());
    Imf::MultiPartOutputFile file(stream, headers.data(), 2, false, 0);
    for (int i = 0; i < 2; ++i) {
      Imf::OutputPart part(file, i);
      part.setFrameBuffer((i == 0 ? left : right).buffer());
      part.writePixels(kHeight);
    }
  }
  const Bytes bytes = bytes_of(stream);
  CHECK(exr_layers(bytes, "map.exr") == std::vector<std::string>{"left", "right", "right:sun"});
  check_picture(decode_exr(bytes, "map.exr"), {0, 0});
  const Panorama sun = decode_exr(bytes, "map.exr", "right:sun");
  CHECK(sun.rgb[3 * (17 * kWidth + 5)] == value_at(5, 17, 1));
  CHECK(sun.rgb[3 * (17 * kWidth + 5) + 1] == 0.0f);
  // Magic number, version 2 with the multi-part bit, and the end of the list of headers.
  check_refused({0x76, 0x2f, 0x31, 0x01, 2, 0x10, 0, 0, 0}, "");
}

TEST_CASE("decode_exr refuses giant tiles") {
  Imf::Header header = header_for(kRgb);
  header.setTileDescription(Imf::TileDescription(10000, 10000));
  Imf::StdOSStream stream;
  { Imf::TiledOutputFile file(stream, header, 0); }
  check_refused(bytes_of(stream), "has tiles of 10000 x 10000 pixels");
}

TEST_CASE("decode_exr refuses tiles that are far larger than the picture") {
  // Found by ./dev fuzz: OpenEXR holds a row of tiles, here 960 MB as floats.
  Imf::Header header = header_for(kRgb);
  header.setTileDescription(Imf::TileDescription(8, 1 << 21));
  Imf::StdOSStream stream;
  { Imf::TiledOutputFile file(stream, header, 0); }
  check_refused(bytes_of(stream), "has tiles of 8 x 2097152 pixels");
}

TEST_CASE("decode_exr reads a small picture in one larger tile") {
  Imf::Header header = header_for(kRgb);
  header.setTileDescription(Imf::TileDescription(512, 512));
  Imf::StdOSStream stream;
  {
    const Pixels pixels(kRgb, header.dataWindow());
    Imf::TiledOutputFile file(stream, header, 0);
    file.setFrameBuffer(pixels.buffer());
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  check_picture(decode_exr(bytes_of(stream), "map.exr"), {0, 0});
}

// The most address space that this process has had, touched or not; 0 where Linux does not tell.
std::int64_t peak_address_space() {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.rfind("VmPeak:", 0) == 0) return 1024 * std::stoll(line.substr(7));
  }
  return 0;
}

TEST_CASE(
    "decode_exr: an attribute that claims to be larger than the file fails without its memory") {
  // Found by ./dev fuzz: 1.8 GB for a file of 400 bytes.
  Bytes bytes = scan_line_file(kRgb, header_for(kRgb));
  const std::string name = std::string("screenWindowWidth") + '\0';
  const auto found = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
  REQUIRE(found != bytes.end());
  // A name and a type that OpenEXR does not know, then the length.
  *found = 't';
  const auto type = found + static_cast<std::ptrdiff_t>(name.size());
  *type = 'g';
  const std::array<std::uint8_t, 4> length = {0, 0, 0, 0x70};
  std::copy(length.begin(), length.end(), type + 6);
  const std::int64_t before = peak_address_space();
  check_refused(bytes, "is damaged or not supported");
  CHECK(peak_address_space() - before < std::int64_t{1} << 29);
}

TEST_CASE("decode_exr: messages are text whatever the channels are called") {
  // Found by ./dev fuzz. Latin-1, an overlong form, a surrogate, and characters of 2, 3 and 4
  // bytes.
  const std::string name = "\xd9 \xc0\xaf \xed\xa0\x80 \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80\x7f";
  const std::vector<Channel> channels = {{name}};
  check_refused(scan_line_file(channels, header_for(channels)),
                "but ? ?? ??? \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80");
}

TEST_CASE("decode_exr: what is no EXR") {
  check_refused({}, "is not an OpenEXR file");
  const std::string text = "not a picture";
  check_refused(Bytes(text.begin(), text.end()), "is not an OpenEXR file");
  check_refused({0x76, 0x2f, 0x31, 0x01}, "is damaged or not supported");
}

// The files of the two tests below: every compression, scan lines and tiles.
std::vector<Bytes> sample_files() {
  std::vector<Bytes> files;
  for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
    const Imf::Header header = header_for(kRgb, static_cast<Imf::Compression>(c));
    files.push_back(scan_line_file(kRgb, header));
    files.push_back(tiled_file(kRgb, header, Imf::ONE_LEVEL));
  }
  return files;
}

TEST_CASE("decode_exr: truncated files throw") {
  for (const Bytes& whole : sample_files()) {
    // Every length in the header, then every 97th, then the last bytes.
    for (std::size_t length = 0; length < whole.size();
         length += length < 400 || length + 20 > whole.size() ? 1 : 97) {
      const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
      INFO(length, " of ", whole.size(), " bytes");
      CHECK_THROWS_AS(decode_exr(part, "map.exr"), ImageError);
    }
  }
}

TEST_CASE("decode_exr: flipped bits end in an image or an ImageError") {
  std::mt19937 random(7);
  for (const Bytes& whole : sample_files()) {
    for (int i = 0; i < 150; ++i) {
      Bytes bytes = whole;
      // The header, where most fields are, as often as the rest.
      const std::size_t range =
          i % 2 == 0 ? std::min<std::size_t>(400, bytes.size()) : bytes.size();
      for (int flips = 0; flips < 2; ++flips) {
        bytes[random() % range] ^= static_cast<std::uint8_t>(1u << (random() % 8));
      }
      try {
        const Panorama image = decode_exr(bytes, "map.exr");
        CHECK(image.rgb.size() ==
              static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
      } catch (const ImageError&) {
      }
    }
  }
}

struct TemporaryFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("lobelight-test-" + std::to_string(std::random_device{}()) + ".exr");
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

TEST_CASE("write_exr: what is written is read back") {
  const TemporaryFile file;
  const std::string path = file.path.u8string();
  const std::vector<float> pixels = {1.0f, 0.5f, 0.25f, 1e-3f, 70000.0f, -1.0f};
  write_exr(path, 2, 1, {"R", "G", "B"}, pixels);
  CHECK(load_panorama(path).rgb == pixels);
  // Over the first; as half 70000 is the largest half, and the rest is rounded.
  write_exr(path, 2, 1, {"R", "G", "B"}, pixels, ExrPixelType::kHalf);
  const Panorama halves = load_panorama(path);
  CHECK(halves.rgb[4] == 65504.0f);
  CHECK(halves.rgb[3] == static_cast<float>(half(1e-3f)));
  CHECK(halves.rgb[5] == -1.0f);
  // Channels come in the order given, and further ones may follow.
  write_exr(path, 1, 1, {"G", "extra", "R", "B"}, {2.0f, 9.0f, 1.0f, 3.0f});
  CHECK(load_panorama(path).rgb == std::vector<float>{1.0f, 2.0f, 3.0f});
}

TEST_CASE("write_exr: the same picture gives the same bytes") {
  const TemporaryFile a;
  const TemporaryFile b;
  for (const TemporaryFile* file : {&a, &b}) {
    write_exr(file->path.u8string(), 2, 1, {"Y"}, {1.0f, 2.0f});
  }
  CHECK(read_file(a.path.u8string()) == read_file(b.path.u8string()));
}

TEST_CASE("write_exr refuses sizes that do not fit and places that do not exist") {
  CHECK_THROWS_AS(write_exr("x.exr", 0, 1, {"Y"}, {}), std::invalid_argument);
  CHECK_THROWS_AS(write_exr("x.exr", 1, 1, {}, {}), std::invalid_argument);
  CHECK_THROWS_AS(write_exr("x.exr", 2, 1, {"Y"}, {1.0f}), std::invalid_argument);
  CHECK_THROWS_AS(write_exr("/no/such/folder/x.exr", 1, 1, {"Y"}, {1.0f}), ImageError);
}

}  // namespace
}  // namespace lobelight
