#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescription.h>
#if __has_include(<ImfContextInit.h>)
#include <ImfContextInit.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <utility>

#include "base/one_line.h"
#include "image/exr_chroma.h"
#include "image/exr_layers.h"
#include "image/exr_window.h"
#include "image/image_error.h"
#include "image/primaries.h"

namespace lobelight {
namespace {

// OpenEXR holds a row of tiles, which may be twice as large as the picture within these limits.
constexpr std::int64_t kMaxTileTexels = std::int64_t{1} << 26;
constexpr std::int64_t kMaxTileTexelsOfSmallPicture = std::int64_t{1} << 22;

// A window of a few pixels in a huge picture is no panorama, and filling the rest costs memory.
constexpr std::int64_t kMaxTexelsPerFilledTexel = 64;

class MemoryReader : public Imf::IStream {
 public:
  // OpenEXR's messages name the file in the middle; ours do it at their beginning.
  explicit MemoryReader(const std::vector<std::uint8_t>& bytes)
      : IStream("this file"), bytes_(bytes) {}

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
  // Silence would be no reason at all.
  context.silentHeaderParse(false).strictHeaderValidation(false).setInputStream(&stream);
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

// Refuses colours of another resolution than the picture's; chroma may have one.
void check_sampling(const Imf::ChannelList& channels, const ExrLayer& layer,
                    const std::string& name) {
  for (std::size_t c = 0; c < layer.channels.size(); ++c) {
    if (layer.channels[c].empty()) continue;
    if (layer.kind == ExrLayer::Kind::luminance_chroma && c > 0) continue;
    const Imf::Channel& channel = *channels.findChannel(layer.channels[c]);
    if (channel.xSampling != 1 || channel.ySampling != 1) {
      throw ImageError(name, "stores channel " + one_line(layer.channels[c]) +
                                 " at a lower resolution, which is not supported");
    }
  }
}

void check_header(const Imf::Header& header, const std::string& name) {
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE) {
    throw ImageError(name,
                     "is a cube map, not a latitude-longitude panorama; OpenEXR's exrenvmap makes "
                     "one of it");
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

void check_windows(const Window& display, const Window& data, const std::string& name,
                   std::int64_t max_side) {
  check_panorama_size(display.width(), display.height(), name, max_side);
  check_panorama_size(data.width(), data.height(), name);
  const Window common = display.intersection(data);
  if (common.width() < 1 || common.height() < 1) {
    throw ImageError(name, "has no pixels in its display window");
  }
  if (display.texels() > kMaxTexelsPerFilledTexel * common.texels()) {
    throw ImageError(name, "fills less than 1/64 of its display window");
  }
}

// Appends row by row, so that a header that lies costs no memory.
Panorama read_pixels(Imf::InputPart& part, const Window& display, const Window& data,
                     const std::vector<std::string>& channels, const Progress* progress) {
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
    throw_if_cancelled(progress);
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

// What the header says that changes what one sees, and what became of it.
void tell_of_header(const Imf::Header& header, const ExrLayer& layer, const Window& display,
                    const Window& data, Panorama& image) {
  if (layer.kind == ExrLayer::Kind::colour) {
    const char* const names[] = {"red", "green", "blue"};
    for (std::size_t c = 0; c < 3; ++c) {
      if (layer.channels[c].empty()) {
        image.warnings.push_back(std::string("has no ") + names[c] + " channel, which is 0");
      }
    }
  }
  const double covered = static_cast<double>(display.intersection(data).texels()) /
                         static_cast<double>(display.texels());
  if (covered < 1.0) {
    char text[80];
    std::snprintf(text, sizeof text, "fills %.3g %% of its display window; the rest is black",
                  100.0 * covered);
    image.warnings.push_back(text);
  }
  if (display.intersection(data).texels() < data.texels()) {
    image.notes.push_back("has pixels beyond its display window, which are cut");
  }
  if (header.pixelAspectRatio() != 1.0f) {
    image.notes.push_back("has a pixelAspectRatio, which is left aside");
  }
  if (Imf::hasWhiteLuminance(header)) {
    image.notes.push_back("has a whiteLuminance, which is left aside");
  }
  if (Imf::hasAdoptedNeutral(header)) {
    image.notes.push_back("has an adoptedNeutral, which is left aside");
  }
  if (Imf::hasEnvmap(header) && Imf::hasWorldToCamera(header)) {
    image.notes.push_back("has a worldToCamera, which is left aside");
  }
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
    MemoryReader stream(bytes);
    Imf::MultiPartInputFile file = open_exr(stream);
    return read(stream, file);
  } catch (const ImageError&) {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw ImageError(name, "needs more memory than there is");
  } catch (const std::exception& error) {
    throw ImageError(name, "is damaged or not supported (" + one_line(reason_of(error)) + ")");
  }
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
                    const std::string& label, std::int64_t max_side, const Progress* progress) {
  return with_file(bytes, name, [&](MemoryReader& stream, Imf::MultiPartInputFile& file) {
    const ExrLayer layer = choose_layer(headers_of(file), label, name);
    const Imf::Header& header = file.header(layer.part);
    check_header(header, name);
    check_sampling(header.channels(), layer, name);
    const Window data(header.dataWindow());
    // Of an environment map it is the data window that goes around (ImfEnvmap.h).
    const Window display = Imf::hasEnvmap(header) ? data : Window(header.displayWindow());
    check_windows(display, data, name, max_side);
    check_tiles(header, data, name);
    Imf::InputPart part(file, layer.part);
    stream.take_ran_short();  // reading ahead in the header is no fault
    Panorama image = layer.kind == ExrLayer::Kind::luminance_chroma
                         ? read_luminance_chroma(part, display, data, layer.channels, progress)
                         : read_pixels(part, display, data, layer.channels, progress);
    // OpenEXR 3.4 takes uncompressed rows that end early and fills them up.
    if (stream.take_ran_short()) throw ImageError(name, "ends in the middle of its pixels");
    tell_of_header(header, layer, display, data, image);
    if (layer.kind != ExrLayer::Kind::grey && Imf::hasChromaticities(header)) {
      const Imf::Chromaticities& given = Imf::chromaticities(header);
      const auto xy = [](const Imath::V2f& c) { return glm::dvec2(c.x, c.y); };
      convert_to_rec709(image, {xy(given.red), xy(given.green), xy(given.blue), xy(given.white)},
                        "chromaticities", name);
    }
    return image;
  });
}

}  // namespace lobelight
