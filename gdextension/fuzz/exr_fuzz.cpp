// OpenEXR pictures, and the list of their layers.

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
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

#include "checks.h"
#include "image/exr.h"
#include "image/image_error.h"

namespace lobelight::fuzz {

const char* const kReader = "exr";

namespace {

// Neither fills a tile; both are even, as chroma needs it.
constexpr int kWidth = 18;
constexpr int kHeight = 10;

Imf::Header header_with(const std::vector<std::string>& channels, Imf::PixelType type,
                        Imf::Compression compression) {
  Imf::Header header(kWidth, kHeight);
  header.compression() = compression;
  for (const std::string& name : channels) header.channels().insert(name, Imf::Channel(type));
  return header;
}

// A ramp as every channel of the header: as floats, or as halves from 1 to 2.
class Ramp {
 public:
  Ramp(const Imf::Header& header, Imf::PixelType type)
      : floats_(kWidth * kHeight), halves_(kWidth * kHeight) {
    for (std::size_t n = 0; n < floats_.size(); ++n) {
      floats_[n] = 0.01F * static_cast<float>(n * n % 97);
      halves_[n] = static_cast<std::uint16_t>(0x3c00U + 6U * n);
    }
    char* const pixels = type == Imf::HALF ? reinterpret_cast<char*>(halves_.data())
                                           : reinterpret_cast<char*>(floats_.data());
    const std::size_t step = type == Imf::HALF ? 2 : 4;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
      buffer_.insert(channel.name(), Imf::Slice(type, pixels, step, step * kWidth));
    }
  }
  const Imf::FrameBuffer& buffer() const { return buffer_; }

 private:
  std::vector<float> floats_;
  std::vector<std::uint16_t> halves_;
  Imf::FrameBuffer buffer_;
};

Bytes bytes_of(const Imf::StdOSStream& stream) {
  const std::string text = stream.str();
  return {text.begin(), text.end()};
}

Bytes scan_lines(const Imf::Header& header, Imf::PixelType type) {
  Imf::StdOSStream stream;
  {
    const Ramp ramp(header, type);
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(ramp.buffer());
    file.writePixels(kHeight);
  }
  return bytes_of(stream);
}

Bytes tiles(Imf::Header header, Imf::PixelType type) {
  header.setTileDescription(Imf::TileDescription(8, 4, Imf::ONE_LEVEL));
  Imf::StdOSStream stream;
  {
    const Ramp ramp(header, type);
    Imf::TiledOutputFile file(stream, header, 0);
    file.setFrameBuffer(ramp.buffer());
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  return bytes_of(stream);
}

Bytes parts(Imf::PixelType type) {
  std::vector<Imf::Header> headers;
  for (const char* const name : {"left", "right"}) {
    headers.push_back(header_with({"R", "G", "B", "light.R"}, type, Imf::ZIPS_COMPRESSION));
    headers.back().setName(name);
    headers.back().setType(Imf::SCANLINEIMAGE);
  }
  Imf::StdOSStream stream;
  {
    const Ramp ramp(headers[0], type);
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()), false,
                                  0);
    for (int n = 0; n < file.parts(); ++n) {
      Imf::OutputPart part(file, n);
      part.setFrameBuffer(ramp.buffer());
      part.writePixels(kHeight);
    }
  }
  return bytes_of(stream);
}

Bytes luminance_and_chroma() {
  Imf::StdOSStream stream;
  {
    std::vector<Imf::Rgba> pixels;
    for (int n = 0; n < kWidth * kHeight; ++n) {
      const float value = 0.05F * static_cast<float>(n % 31);
      pixels.emplace_back(value, 1.0F, 2.0F * value);
    }
    Imf::RgbaOutputFile file(stream, Imf::Header(kWidth, kHeight), Imf::WRITE_YC, 0);
    file.setFrameBuffer(pixels.data(), 1, kWidth);
    file.writePixels(kHeight);
  }
  return bytes_of(stream);
}

}  // namespace

std::vector<Bytes> seeds() {
  std::vector<Bytes> files;
  const std::vector<std::string> rgb = {"R", "G", "B"};
  for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
    const auto compression = static_cast<Imf::Compression>(c);
    if (!Imf::isValidCompression(c)) continue;
    files.push_back(scan_lines(header_with(rgb, Imf::HALF, compression), Imf::HALF));
  }
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    files.push_back(tiles(header_with(rgb, Imf::FLOAT, compression), Imf::FLOAT));
  }
  Imf::Header other = header_with({"Y", "Z", "a.R", "b.c.G"}, Imf::FLOAT, Imf::RLE_COMPRESSION);
  other.displayWindow() = Imath::Box2i({-3, 2}, {kWidth + 1, kHeight - 2});
  files.push_back(scan_lines(other, Imf::FLOAT));
  Imf::Header wide = header_with(rgb, Imf::FLOAT, Imf::NO_COMPRESSION);
  Imf::addChromaticities(
      wide, Imf::Chromaticities({0.7F, 0.29F}, {0.17F, 0.8F}, {0.13F, 0.05F}, {0.32F, 0.34F}));
  files.push_back(scan_lines(wide, Imf::FLOAT));
  files.push_back(parts(Imf::HALF));
  files.push_back(luminance_and_chroma());
  return files;
}

}  // namespace lobelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lobelight;
  const fuzz::Bytes bytes(data, data + size);
  const std::string name = "input.exr";
  try {
    fuzz::accept(decode_exr(bytes, name));
  } catch (const ImageError& error) {
    fuzz::refuse(error.what(), name);
    return 0;
  }
  // Any other layer, as whoever picked it from the list would ask for it.
  try {
    for (const std::string& layer : exr_layers(bytes, name)) decode_exr(bytes, name, layer);
  } catch (const ImageError& error) {
    fuzz::require(std::string(error.what()).rfind(name + ": ", 0) == 0,
                  "refuses a layer without the file's name");
  }
  return 0;
}
