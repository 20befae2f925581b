#include "image/exr_chroma.h"

#include <ImathVec.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfRgbaYca.h>
#include <ImfStandardAttributes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace lobelight {
namespace {

// One channel of the data window, with every n-th column and row.
class Plane {
 public:
  Plane(const Imf::Channel& channel, const Window& data)
      : step_x_(channel.xSampling),
        step_y_(channel.ySampling),
        columns_((data.width() + step_x_ - 1) / step_x_) {}

  // Room for the rows from `top` to `bottom`, which follow those that there are.
  Imf::Slice append(const Window& data, std::int64_t top, std::int64_t bottom) {
    const std::int64_t rows = (bottom - top + step_y_) / step_y_;
    const std::size_t first = values_.size();
    values_.resize(first + static_cast<std::size_t>(columns_ * rows));
    return Imf::Slice::Make(Imf::FLOAT, values_.data() + first,
                            Imath::V2i(static_cast<int>(data.left), static_cast<int>(top)),
                            data.width(), bottom - top + 1, sizeof(float),
                            static_cast<std::size_t>(columns_) * sizeof(float),
                            static_cast<int>(step_x_), static_cast<int>(step_y_));
  }

  // At a pixel of the data window: linear between the stored values, the last ones beyond.
  double at(std::int64_t x, std::int64_t y) const {
    const std::int64_t rows = static_cast<std::int64_t>(values_.size()) / columns_;
    const std::int64_t left = x / step_x_, top = y / step_y_;
    const std::int64_t right = std::min(left + 1, columns_ - 1);
    const std::int64_t bottom = std::min(top + 1, rows - 1);
    const double s = static_cast<double>(x % step_x_) / static_cast<double>(step_x_);
    const double t = static_cast<double>(y % step_y_) / static_cast<double>(step_y_);
    const double upper =
        s == 0.0 ? stored(left, top) : mix(stored(left, top), stored(right, top), s);
    if (t == 0.0) return upper;
    return mix(upper, mix(stored(left, bottom), stored(right, bottom), s), t);
  }

 private:
  static double mix(double a, double b, double t) { return (1.0 - t) * a + t * b; }

  double stored(std::int64_t column, std::int64_t row) const {
    return static_cast<double>(values_[static_cast<std::size_t>(row * columns_ + column)]);
  }

  std::int64_t step_x_, step_y_, columns_;
  std::vector<float> values_;
};

// Y, (R − Y) / Y and (B − Y) / Y of the data window. Row by row as well.
std::vector<Plane> read_planes(Imf::InputPart& part, const Window& data,
                               const std::vector<std::string>& channels, const Progress* progress) {
  std::vector<Plane> planes;
  for (const std::string& channel : channels) {
    planes.emplace_back(*part.header().channels().findChannel(channel), data);
  }
  for (std::int64_t top = data.top; top <= data.bottom; top += kBandRows) {
    throw_if_cancelled(progress);
    const std::int64_t bottom = std::min(top + kBandRows - 1, data.bottom);
    Imf::FrameBuffer target;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      target.insert(channels[c], planes[c].append(data, top, bottom));
    }
    part.setFrameBuffer(target);
    part.readPixels(static_cast<int>(top), static_cast<int>(bottom));
  }
  return planes;
}

// R = (RY + 1) Y, B = (BY + 1) Y, and G so that the luminance is Y (ImfRgbaYca.h).
glm::vec3 colour_of(double luminance, double red_chroma, double blue_chroma,
                    const glm::dvec3& weights) {
  // An overflow has no colour.
  if (std::isinf(luminance)) return glm::vec3(static_cast<float>(luminance));
  const double red = (red_chroma + 1.0) * luminance;
  const double blue = (blue_chroma + 1.0) * luminance;
  const double green = (luminance - red * weights.x - blue * weights.z) / weights.y;
  // Rounding and interpolation leave something where there is none.
  return glm::vec3(glm::dvec3(red, green < 0.0 ? 0.0 : green, blue));
}

}  // namespace

Panorama read_luminance_chroma(Imf::InputPart& part, const Window& display, const Window& data,
                               const std::vector<std::string>& channels, const Progress* progress) {
  const std::vector<Plane> planes = read_planes(part, data, channels, progress);
  const Imf::Header& header = part.header();
  const Imath::V3f given = Imf::RgbaYca::computeYw(
      Imf::hasChromaticities(header) ? Imf::chromaticities(header) : Imf::Chromaticities());
  const glm::dvec3 weights(given.x, given.y, given.z);
  Panorama image;
  image.width = static_cast<int>(display.width());
  image.height = static_cast<int>(display.height());
  image.rgb.resize(3 * static_cast<std::size_t>(display.width() * display.height()));
  for (std::int64_t y = std::max(display.top, data.top); y <= std::min(display.bottom, data.bottom);
       ++y) {
    throw_if_cancelled(progress);
    for (std::int64_t x = std::max(display.left, data.left);
         x <= std::min(display.right, data.right); ++x) {
      const std::int64_t column = x - data.left, row = y - data.top;
      const glm::vec3 colour = colour_of(planes[0].at(column, row), planes[1].at(column, row),
                                         planes[2].at(column, row), weights);
      float* rgb = &image.rgb[3 * static_cast<std::size_t>((y - display.top) * display.width() + x -
                                                           display.left)];
      for (int c = 0; c < 3; ++c) rgb[c] = colour[c];
    }
  }
  return image;
}

}  // namespace lobelight
