#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "base/one_line.h"
#include "image/exr.h"
#include "image/file_io.h"
#include "image/image_error.h"

namespace lobelight {
namespace {

class MemoryWriter : public Imf::OStream {
 public:
  explicit MemoryWriter(const std::string& name) : OStream(name.c_str()) {}

  void write(const char* source, int count) override {
    const std::size_t end = position_ + static_cast<std::size_t>(count);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + position_, source, static_cast<std::size_t>(count));
    position_ = end;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = static_cast<std::size_t>(position); }

  const std::vector<char>& bytes() const { return bytes_; }

 private:
  std::vector<char> bytes_;
  std::size_t position_ = 0;
};

std::vector<half> to_half(const std::vector<float>& values) {
  std::vector<half> halves(values.size());
  std::transform(values.begin(), values.end(), halves.begin(), [](float value) {
    // Infinities and NaN stay what they are.
    return half(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value);
  });
  return halves;
}

// Interleaved values of one type as the slices of a frame buffer.
template <typename T>
Imf::FrameBuffer interleaved(Imf::PixelType type, std::vector<T>& values, int width, int height,
                             const std::vector<std::string>& channels) {
  Imf::FrameBuffer buffer;
  const std::size_t stride = channels.size() * sizeof(T);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    buffer.insert(channels[c],
                  Imf::Slice::Make(type, values.data() + c, Imath::V2i(0, 0), width, height, stride,
                                   stride * static_cast<std::size_t>(width)));
  }
  return buffer;
}

}  // namespace

void write_exr(const std::string& path, int width, int height,
               const std::vector<std::string>& channels, const std::vector<float>& pixels,
               ExrPixelType type) {
  if (width < 1 || height < 1 || channels.empty() ||
      pixels.size() !=
          static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels.size()) {
    throw std::invalid_argument("An EXR needs width x height x channels values and at least one.");
  }
  MemoryWriter stream(path);
  try {
    const Imf::PixelType stored = type == ExrPixelType::kHalf ? Imf::HALF : Imf::FLOAT;
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& channel : channels) header.channels().insert(channel, {stored});
    std::vector<half> halves;
    std::vector<float> floats;
    Imf::OutputFile file(stream, header, 0);
    if (type == ExrPixelType::kHalf) {
      halves = to_half(pixels);
      file.setFrameBuffer(interleaved(stored, halves, width, height, channels));
    } else {
      floats = pixels;
      file.setFrameBuffer(interleaved(stored, floats, width, height, channels));
    }
    file.writePixels(height);
  } catch (const std::exception& error) {
    throw ImageError(path, "cannot be encoded (" + one_line(error.what()) + ")");
  }
  write_file_atomically(path, stream.bytes());
}

}  // namespace lobelight
