#include "image/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescription.h>
#include <half.h>
#if __has_include(<ImfContextInit.h>)
#include <ImfContextInit.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "image/file_io.h"
#include "image/image_error.h"
#include "image/primaries.h"

namespace lobelight {
namespace {

// Rows decoded at a time: a multiple of every compression's block of rows (1, 16, 32 or 256).
constexpr int kBandRows = 256;

// A tile is decoded as a whole.
constexpr std::int64_t kMaxTileTexels = std::int64_t{1} << 26;

// A window of a few pixels in a huge picture is no panorama, and filling the rest costs memory.
constexpr std::int64_t kMaxTexelsPerFilledTexel = 64;

// Rounded chromaticities of Rec. 709, and those that ICC profiles of sRGB state for D50, give a
// conversion that differs from the identity by less than this.
constexpr double kSameColours = 0.005;

constexpr float kLargestHalf = 65504.0f;

class MemoryReader : public Imf::IStream {
 public:
  MemoryReader(const std::vector<std::uint8_t>& bytes, const std::string& name)
      : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char* target, int count) override {
    const std::uint64_t wanted = static_cast<std::uint64_t>(std::max(count, 0));
    const std::uint64_t left = position_ < bytes_.size() ? bytes_.size() - position_ : 0;
    const std::uint64_t given = std::min(wanted, left);
    if (given > 0) {
      std::memcpy(target, bytes_.data() + position_, static_cast<std::size_t>(given));
    }
    // OpenEXR 3.3 and later reads ahead in the header and takes what it got before the exception.
    position_ += given;
    if (given < wanted) {
      ran_short_ = true;
      throw std::runtime_error("unexpected end of file");
    }
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

  // Whether more was asked for than there is since the last call.
  bool take_ran_short() { return std::exchange(ran_short_, false); }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::uint64_t position_ = 0;
  bool ran_short_ = false;
};

#if __has_include(<ImfContextInit.h>)
// From OpenEXR 3.3 on, reading goes through the core library, which prints what it finds wrong to
// stderr unless it is told where to put it. Its first complaint says more than the exception.
thread_local std::string first_complaint;

void keep_complaint(exr_const_context_t, exr_result_t, const char* message) {
  if (first_complaint.empty() && message) first_complaint = message;
}

Imf::MultiPartInputFile open_exr(MemoryReader& stream) {
  first_complaint.clear();
  Imf::ContextInitializer context;
  context.silentHeaderParse(true).strictHeaderValidation(false).setInputStream(&stream);
  context.setErrorHandler(keep_complaint);
  // No threads of OpenEXR's own: the caller may be one of many.
  return Imf::MultiPartInputFile(stream.fileName(), context, 0);
}

std::string reason_of(const std::exception& error) {
  return first_complaint.empty() ? error.what() : first_complaint;
}
#else
Imf::MultiPartInputFile open_exr(MemoryReader& stream) {
  return Imf::MultiPartInputFile(stream, 0);
}

std::string reason_of(const std::exception& error) { return error.what(); }
#endif

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

// Pixel bounds, both ends included, wide enough for every difference of two ints.
struct Window {
  std::int64_t left, top, right, bottom;

  explicit Window(const Imath::Box2i& box)
      : left(box.min.x), top(box.min.y), right(box.max.x), bottom(box.max.y) {}

  std::int64_t width() const { return right - left + 1; }
  std::int64_t height() const { return bottom - top + 1; }
};

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.substr(0, 300);
}

std::string channel_names(const Imf::ChannelList& channels) {
  constexpr int kShown = 6;
  std::string names;
  int count = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel, ++count) {
    if (count < kShown) names += (count == 0 ? "" : ", ") + one_line(channel.name());
  }
  if (count > kShown) names += " and " + std::to_string(count - kShown) + " more";
  return count == 0 ? "none at all" : names;
}

// The channels that make up a colour: R, G and B, or Y alone.
std::vector<std::string> choose_channels(const Imf::ChannelList& channels,
                                         const std::string& name) {
  const bool colour =
      channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
  const bool grey = channels.findChannel("Y") != nullptr;
  if (!colour && grey && (channels.findChannel("RY") || channels.findChannel("BY"))) {
    throw ImageError(name, "stores luminance and chroma (Y, RY, BY), which is not supported");
  }
  if (!colour && !grey) {
    throw ImageError(
        name, "has neither channels R, G and B nor a channel Y, but " + channel_names(channels));
  }
  const auto chosen =
      colour ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
  for (const std::string& channel : chosen) {
    const Imf::Channel* description = channels.findChannel(channel);
    if (description->type != Imf::HALF && description->type != Imf::FLOAT) {
      throw ImageError(name, "stores integers in channel " + channel + ", which is not supported");
    }
    if (description->xSampling != 1 || description->ySampling != 1) {
      throw ImageError(
          name, "stores channel " + channel + " at a lower resolution, which is not supported");
    }
  }
  return chosen;
}

// What takes the file's colours to Rec. 709; empty where they are that already.
std::optional<glm::dmat3> colour_conversion(const Imf::Header& header, const std::string& name) {
  if (!Imf::hasChromaticities(header)) return std::nullopt;
  const Imf::Chromaticities& given = Imf::chromaticities(header);
  const auto xy = [](const Imath::V2f& c) { return glm::dvec2(c.x, c.y); };
  const auto conversion =
      conversion_to_rec709({xy(given.red), xy(given.green), xy(given.blue), xy(given.white)});
  if (!conversion) throw ImageError(name, "has primaries that span no colours");
  double difference = 0.0;
  for (int column = 0; column < 3; ++column) {
    const glm::dvec3 deviation = glm::abs((*conversion)[column] - glm::dmat3(1.0)[column]);
    difference = std::max({difference, deviation.x, deviation.y, deviation.z});
  }
  return difference < kSameColours ? std::nullopt : conversion;
}

void convert(Panorama& image, const glm::dmat3& conversion) {
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    float* rgb = &image.rgb[i];
    const glm::vec3 converted(conversion * glm::dvec3(rgb[0], rgb[1], rgb[2]));
    for (int c = 0; c < 3; ++c) rgb[c] = converted[c];
  }
}

void check_header(const Imf::Header& header, const std::string& name) {
  if (header.hasType() && !Imf::isImage(header.type())) {
    throw ImageError(name, "holds deep data, which is not supported");
  }
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE) {
    throw ImageError(name, "is a cube map, not a latitude-longitude panorama");
  }
  if (header.hasTileDescription()) {
    const Imf::TileDescription& tiles = header.tileDescription();
    if (std::int64_t{tiles.xSize} * std::int64_t{tiles.ySize} > kMaxTileTexels) {
      throw ImageError(name, "has tiles of " + std::to_string(tiles.xSize) + " x " +
                                 std::to_string(tiles.ySize) + " pixels, which is too large");
    }
  }
}

void check_windows(const Window& display, const Window& data, const std::string& name) {
  check_panorama_size(display.width(), display.height(), name);
  check_panorama_size(data.width(), data.height(), name);
  const std::int64_t width =
      std::min(display.right, data.right) - std::max(display.left, data.left) + 1;
  const std::int64_t height =
      std::min(display.bottom, data.bottom) - std::max(display.top, data.top) + 1;
  if (width < 1 || height < 1) throw ImageError(name, "has no pixels in its display window");
  if (display.width() * display.height() > kMaxTexelsPerFilledTexel * width * height) {
    throw ImageError(name, "fills less than 1/64 of its display window");
  }
}

// Appends row by row, so that a header that lies costs no memory.
Panorama read_pixels(Imf::InputPart& part, const Window& display, const Window& data,
                     const std::vector<std::string>& channels) {
  Panorama image;
  image.width = static_cast<int>(display.width());
  image.height = static_cast<int>(display.height());
  const std::size_t row_size = 3 * static_cast<std::size_t>(display.width());

  const std::size_t band_row_size = 3 * static_cast<std::size_t>(data.width());
  const std::int64_t band_rows = std::min<std::int64_t>(kBandRows, data.height());
  std::vector<float> band(band_row_size * static_cast<std::size_t>(band_rows));
  const std::int64_t left = std::max(display.left, data.left);
  const std::int64_t right = std::min(display.right, data.right);

  std::int64_t y = display.top;
  const auto pad_to = [&](std::int64_t end) {
    if (end <= y) return;
    image.rgb.resize(image.rgb.size() + row_size * static_cast<std::size_t>(end - y));
    y = end;
  };
  for (std::int64_t top = data.top; top <= data.bottom; top += band_rows) {
    const std::int64_t bottom = std::min(top + band_rows - 1, data.bottom);
    if (bottom < display.top || top > display.bottom) continue;
    Imf::FrameBuffer target;
    const Imath::V2i origin(static_cast<int>(data.left), static_cast<int>(top));
    for (std::size_t c = 0; c < channels.size(); ++c) {
      target.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, band.data() + c, origin, data.width(),
                                                  bottom - top + 1, 3 * sizeof(float),
                                                  band_row_size * sizeof(float)));
    }
    part.setFrameBuffer(target);
    part.readPixels(static_cast<int>(top), static_cast<int>(bottom));

    pad_to(std::max(top, display.top));
    for (; y <= std::min(bottom, display.bottom); ++y) {
      const float* source = &band[band_row_size * static_cast<std::size_t>(y - top) +
                                  3 * static_cast<std::size_t>(left - data.left)];
      image.rgb.resize(image.rgb.size() + row_size);
      float* row = &image.rgb[image.rgb.size() - row_size +
                              3 * static_cast<std::size_t>(left - display.left)];
      for (std::int64_t x = left; x <= right; ++x, source += 3, row += 3) {
        for (std::size_t c = 0; c < 3; ++c) row[c] = source[channels.size() == 1 ? 0 : c];
      }
    }
  }
  pad_to(display.bottom + 1);
  return image;
}

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

bool looks_like_exr(const std::vector<std::uint8_t>& bytes) {
  constexpr std::array<std::uint8_t, 4> kMagic = {0x76, 0x2f, 0x31, 0x01};
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

Panorama decode_exr(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (!looks_like_exr(bytes)) throw ImageError(name, "is not an OpenEXR file");
  try {
    MemoryReader stream(bytes, name);
    Imf::MultiPartInputFile file = open_exr(stream);
    if (file.parts() != 1) {
      throw ImageError(name, "has " + std::to_string(file.parts()) +
                                 " parts; only files with one part are supported");
    }
    const Imf::Header& header = file.header(0);
    check_header(header, name);
    const Window display(header.displayWindow());
    const Window data(header.dataWindow());
    check_windows(display, data, name);
    const std::vector<std::string> channels = choose_channels(header.channels(), name);
    Imf::InputPart part(file, 0);
    stream.take_ran_short();  // reading ahead in the header is no fault
    Panorama image = read_pixels(part, display, data, channels);
    // OpenEXR 3.4 takes uncompressed rows that end early and fills them up.
    if (stream.take_ran_short()) throw ImageError(name, "ends in the middle of its pixels");
    if (channels.size() == 3) {
      if (const auto conversion = colour_conversion(header, name)) convert(image, *conversion);
    }
    return image;
  } catch (const ImageError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw ImageError(name, "needs more memory than there is");
  } catch (const std::exception& error) {
    throw ImageError(name, "is damaged or not supported (" + one_line(reason_of(error)) + ")");
  }
}

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
