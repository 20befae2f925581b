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
#include <ImfRgbaYca.h>
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

#include "image/exr_layers.h"
#include "image/file_io.h"
#include "image/image_error.h"
#include "image/primaries.h"

namespace lobelight {
namespace {

// Rows decoded at a time: a multiple of every compression's block of rows (1, 16, 32 or 256).
constexpr int kBandRows = 256;

// OpenEXR holds a row of tiles, which may be twice as large as the picture within these limits.
constexpr std::int64_t kMaxTileTexels = std::int64_t{1} << 26;
constexpr std::int64_t kMaxTileTexelsOfSmallPicture = std::int64_t{1} << 22;

// A window of a few pixels in a huge picture is no panorama, and filling the rest costs memory.
constexpr std::int64_t kMaxTexelsPerFilledTexel = 64;

// Rounded chromaticities of Rec. 709, and those that ICC profiles of sRGB state for D50, give a
// conversion that differs from the identity by less than this.
constexpr double kSameColours = 0.005;

constexpr float kLargestHalf = 65504.0f;

// Columns and rows of the picture for one of chroma.
constexpr int kChromaSampling = 2;

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
#if __has_include(<ImfContextInit.h>)
  // OpenEXR 3.3 and later then refuses an attribute that claims to be larger than the file before
  // it allocates memory for it.
  std::int64_t size() override { return static_cast<std::int64_t>(bytes_.size()); }
#endif

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

// Refuses channels of another resolution than the picture's, apart from chroma.
void check_sampling(const Imf::ChannelList& channels, const ExrLayer& layer,
                    const std::string& name) {
  for (std::size_t c = 0; c < layer.channels.size(); ++c) {
    if (layer.channels[c].empty()) continue;
    const bool is_chroma = layer.kind == ExrLayer::Kind::luminance_chroma && c > 0;
    const int expected = is_chroma ? kChromaSampling : 1;
    const Imf::Channel& channel = *channels.findChannel(layer.channels[c]);
    if (channel.xSampling != expected || channel.ySampling != expected) {
      throw ImageError(name, "stores channel " + one_line(layer.channels[c]) +
                                 " at a resolution that is not supported");
    }
  }
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
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE) {
    throw ImageError(name, "is a cube map, not a latitude-longitude panorama");
  }
}

// After check_windows(): the sizes are moderate.
void check_tiles(const Imf::Header& header, const Window& data, const std::string& name) {
  if (!header.hasTileDescription()) return;
  const Imf::TileDescription& tiles = header.tileDescription();
  const std::int64_t width = tiles.xSize, height = tiles.ySize;
  if (width < 1 || height < 1) throw ImageError(name, "has tiles without pixels");
  bool is_too_large = width * height > kMaxTileTexels;
  if (!is_too_large) {
    const std::int64_t in_a_row = (data.width() + width - 1) / width;
    const std::int64_t allowed =
        std::clamp(2 * data.width() * data.height(), kMaxTileTexelsOfSmallPicture, kMaxTileTexels);
    is_too_large = in_a_row * width * height > allowed;
  }
  if (is_too_large) {
    throw ImageError(name, "has tiles of " + std::to_string(width) + " x " +
                               std::to_string(height) + " pixels, which is too large");
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
      if (channels[c].empty()) continue;
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

// The planes of a picture in luminance and chroma, of the data window.
struct Planes {
  std::vector<float> luminance;  // width · height
  std::vector<float> red, blue;  // (R − Y) / Y and (B − Y) / Y of every other column and row
};

// Row by row as well.
Planes read_planes(Imf::InputPart& part, const Window& data,
                   const std::vector<std::string>& channels) {
  Planes planes;
  std::vector<float>* const targets[] = {&planes.luminance, &planes.red, &planes.blue};
  for (std::int64_t top = data.top; top <= data.bottom; top += kBandRows) {
    const std::int64_t bottom = std::min(top + kBandRows - 1, data.bottom);
    Imf::FrameBuffer target;
    const Imath::V2i origin(static_cast<int>(data.left), static_cast<int>(top));
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const std::int64_t step = c == 0 ? 1 : kChromaSampling;
      const std::int64_t columns = (data.width() + step - 1) / step;
      const std::int64_t rows = (bottom - top + step) / step;
      const std::size_t first = targets[c]->size();
      targets[c]->resize(first + static_cast<std::size_t>(columns * rows));
      target.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, targets[c]->data() + first, origin,
                                                  data.width(), bottom - top + 1, sizeof(float),
                                                  static_cast<std::size_t>(columns) * sizeof(float),
                                                  static_cast<int>(step), static_cast<int>(step)));
    }
    part.setFrameBuffer(target);
    part.readPixels(static_cast<int>(top), static_cast<int>(bottom));
  }
  return planes;
}

// Chroma at a pixel of the data window: linear between the stored ones, the last ones beyond.
double chroma_at(const std::vector<float>& plane, const Window& data, std::int64_t x,
                 std::int64_t y) {
  const std::int64_t columns = (data.width() + 1) / kChromaSampling;
  const std::int64_t rows = (data.height() + 1) / kChromaSampling;
  const std::int64_t left = x / kChromaSampling, top = y / kChromaSampling;
  const std::int64_t right = std::min(left + x % kChromaSampling, columns - 1);
  const std::int64_t bottom = std::min(top + y % kChromaSampling, rows - 1);
  const auto at = [&](std::int64_t column, std::int64_t row) {
    return static_cast<double>(plane[static_cast<std::size_t>(row * columns + column)]);
  };
  return 0.25 * (at(left, top) + at(right, top) + at(left, bottom) + at(right, bottom));
}

// R = (RY + 1) Y, B = (BY + 1) Y, and G so that the luminance is Y (ImfRgbaYca.h).
Panorama read_luminance_chroma(Imf::InputPart& part, const Window& display, const Window& data,
                               const std::vector<std::string>& channels) {
  const Planes planes = read_planes(part, data, channels);
  const Imf::Header& header = part.header();
  const Imath::V3f weights = Imf::RgbaYca::computeYw(
      Imf::hasChromaticities(header) ? Imf::chromaticities(header) : Imf::Chromaticities());
  Panorama image;
  image.width = static_cast<int>(display.width());
  image.height = static_cast<int>(display.height());
  image.rgb.resize(3 * static_cast<std::size_t>(display.width() * display.height()));
  for (std::int64_t y = std::max(display.top, data.top); y <= std::min(display.bottom, data.bottom);
       ++y) {
    for (std::int64_t x = std::max(display.left, data.left);
         x <= std::min(display.right, data.right); ++x) {
      const std::int64_t column = x - data.left, row = y - data.top;
      const double luminance =
          planes.luminance[static_cast<std::size_t>(row * data.width() + column)];
      const double red = (chroma_at(planes.red, data, column, row) + 1.0) * luminance;
      const double blue = (chroma_at(planes.blue, data, column, row) + 1.0) * luminance;
      const double green = (luminance - red * static_cast<double>(weights.x) -
                            blue * static_cast<double>(weights.z)) /
                           static_cast<double>(weights.y);
      float* rgb = &image.rgb[3 * static_cast<std::size_t>((y - display.top) * display.width() + x -
                                                           display.left)];
      rgb[0] = static_cast<float>(red);
      // Rounding and interpolation leave something where there is none.
      rgb[1] = static_cast<float>(green < 0.0 ? 0.0 : green);
      rgb[2] = static_cast<float>(blue);
    }
  }
  return image;
}

std::vector<Imf::Header> headers_of(const Imf::MultiPartInputFile& file) {
  std::vector<Imf::Header> headers;
  for (int part = 0; part < file.parts(); ++part) headers.push_back(file.header(part));
  return headers;
}

// Calls `read` with the open file; what OpenEXR throws becomes an ImageError.
template <class Read>
auto with_file(const std::vector<std::uint8_t>& bytes, const std::string& name, const Read& read) {
  if (!looks_like_exr(bytes)) throw ImageError(name, "is not an OpenEXR file");
  try {
    MemoryReader stream(bytes, name);
    Imf::MultiPartInputFile file = open_exr(stream);
    return read(stream, file);
  } catch (const ImageError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw ImageError(name, "needs more memory than there is");
  } catch (const std::exception& error) {
    throw ImageError(name, "is damaged or not supported (" + one_line(reason_of(error)) + ")");
  }
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

std::vector<std::string> exr_layers(const std::vector<std::uint8_t>& bytes,
                                    const std::string& name) {
  return with_file(bytes, name, [](MemoryReader&, const Imf::MultiPartInputFile& file) {
    std::vector<std::string> labels;
    for (const ExrLayer& layer : find_layers(headers_of(file))) labels.push_back(layer.label);
    return labels;
  });
}

Panorama decode_exr(const std::vector<std::uint8_t>& bytes, const std::string& name,
                    const std::string& label) {
  return with_file(bytes, name, [&](MemoryReader& stream, Imf::MultiPartInputFile& file) {
    const ExrLayer layer = choose_layer(headers_of(file), label, name);
    const Imf::Header& header = file.header(layer.part);
    check_header(header, name);
    check_sampling(header.channels(), layer, name);
    const Window display(header.displayWindow());
    const Window data(header.dataWindow());
    check_windows(display, data, name);
    check_tiles(header, data, name);
    Imf::InputPart part(file, layer.part);
    stream.take_ran_short();  // reading ahead in the header is no fault
    Panorama image = layer.kind == ExrLayer::Kind::luminance_chroma
                         ? read_luminance_chroma(part, display, data, layer.channels)
                         : read_pixels(part, display, data, layer.channels);
    // OpenEXR 3.4 takes uncompressed rows that end early and fills them up.
    if (stream.take_ran_short()) throw ImageError(name, "ends in the middle of its pixels");
    if (layer.kind != ExrLayer::Kind::grey) {
      if (const auto conversion = colour_conversion(header, name)) convert(image, *conversion);
    }
    return image;
  });
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
