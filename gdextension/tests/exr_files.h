#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <doctest/doctest.h>
#include <half.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "image/exr.h"
#include "image/image_error.h"

// OpenEXR files in memory.

namespace lobelight::testing {

using Bytes = std::vector<std::uint8_t>;

inline constexpr int kWidth = 37;  // Neither size fills a block or a tile.
inline constexpr int kHeight = 41;

inline Bytes bytes_of(const Imf::StdOSStream& stream) {
  const std::string text = stream.str();
  return {text.begin(), text.end()};
}

// A smooth picture over four orders of magnitude, exact as half floats.
inline float value_at(int x, int y, std::size_t channel) {
  const double phase = 0.11 * x + 0.07 * y * static_cast<double>(channel + 1);
  return half(static_cast<float>(0.01 + 100.0 * std::pow(0.5 + 0.5 * std::sin(phase), 6.0)));
}

struct Channel {
  std::string name;
  Imf::PixelType type = Imf::HALF;
};

// The pixels of some channels within a window, in the forms that OpenEXR wants.
class Pixels {
 public:
  Pixels(const std::vector<Channel>& channels, const Imath::Box2i& window) {
    const int width = window.max.x - window.min.x + 1;
    const int height = window.max.y - window.min.y + 1;
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const std::size_t size = channels[c].type == Imf::HALF ? sizeof(half) : sizeof(float);
      std::vector<char>& store = storage_[channels[c].name];
      store.resize(count * size);
      for (std::size_t i = 0; i < count; ++i) {
        const float value = value_at(window.min.x + static_cast<int>(i) % width,
                                     window.min.y + static_cast<int>(i) / width, c);
        const half small = value;
        const std::uint32_t whole = static_cast<std::uint32_t>(value);
        const void* source = channels[c].type == Imf::HALF    ? static_cast<const void*>(&small)
                             : channels[c].type == Imf::FLOAT ? static_cast<const void*>(&value)
                                                              : &whole;
        std::memcpy(&store[i * size], source, size);
      }
      buffer_.insert(channels[c].name,
                     Imf::Slice::Make(channels[c].type, store.data(), window.min, width, height));
    }
  }
  const Imf::FrameBuffer& buffer() const { return buffer_; }

 private:
  std::map<std::string, std::vector<char>> storage_;
  Imf::FrameBuffer buffer_;
};

inline const std::vector<Channel> kRgb = {{"R"}, {"G"}, {"B"}};
inline const std::vector<Channel> kFloatRgb = {
    {"R", Imf::FLOAT}, {"G", Imf::FLOAT}, {"B", Imf::FLOAT}};

inline Imf::Header header_for(const std::vector<Channel>& channels,
                              Imf::Compression compression = Imf::ZIP_COMPRESSION) {
  Imf::Header header(kWidth, kHeight);
  header.compression() = compression;
  for (const Channel& c : channels) header.channels().insert(c.name, Imf::Channel(c.type));
  return header;
}

inline Bytes scan_line_file(const std::vector<Channel>& channels, const Imf::Header& header) {
  Imf::StdOSStream stream;
  {
    const Pixels pixels(channels, header.dataWindow());
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(pixels.buffer());
    const int rows = header.dataWindow().max.y - header.dataWindow().min.y + 1;
    file.writePixels(rows);
  }
  return bytes_of(stream);
}

inline Bytes tiled_file(const std::vector<Channel>& channels, Imf::Header header,
                        Imf::LevelMode mode) {
  header.setTileDescription(Imf::TileDescription(16, 8, mode));
  Imf::StdOSStream stream;
  {
    const Pixels pixels(channels, header.dataWindow());
    Imf::TiledOutputFile file(stream, header, 0);
    // Level 0 holds the picture; the others only have to be there.
    for (int ly = 0; ly < file.numYLevels(); ++ly) {
      for (int lx = 0; lx < file.numXLevels(); ++lx) {
        if (!file.isValidLevel(lx, ly)) continue;
        file.setFrameBuffer(pixels.buffer());
        file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
      }
    }
  }
  return bytes_of(stream);
}

inline void check_refused(const Bytes& bytes, const std::string& reason) {
  std::string message;
  try {
    decode_exr(bytes, "map.exr");
  } catch (const ImageError& error) {
    message = error.what();
  }
  INFO("message: ", message);
  CHECK(message.rfind("map.exr: ", 0) == 0);
  CHECK(message.find(reason) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

}  // namespace lobelight::testing
