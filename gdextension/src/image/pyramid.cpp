#include "image/pyramid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "base/pi.h"
#include "image/panorama_faces.h"
#include "image/round_kernel.h"
#include "table/half_float.h"

namespace lobelight {

namespace {

// One level of all six faces.
struct Level {
  int size = 0;
  std::vector<float> rgb;

  std::size_t at(int face, int column, int row) const {
    const auto side = static_cast<std::size_t>(size);
    return 3 * ((static_cast<std::size_t>(face) * side + static_cast<std::size_t>(row)) * side +
                static_cast<std::size_t>(column));
  }
};

// The numbers of the first and the last texel of a range; none if the first is larger.
struct Texels {
  int first;
  int last;
};

Texels texels_between(double first, double last, int finer_size) {
  const auto number = [&](double position) {
    const double texel = std::floor((position * 0.5 + 0.5) * finer_size);
    return static_cast<int>(std::clamp(texel, 0.0, finer_size - 1.0));
  };
  return {number(first), number(last)};
}

// The texels along one axis of a face in which directions at most `reach` away from d lie, as
// shaders/pyramid_round.gdshader says.
Texels texels_within(double along, double forward, double reach, int finer_size) {
  if (reach >= kMostReach) return {0, finer_size - 1};
  constexpr double kEdge = 0.25 * kPi;
  const double sine = std::sin(reach) / std::max(std::hypot(along, forward), 1e-6);
  const double middle = sine < 1.0 ? std::atan2(along, forward) : 0.0;
  const double spread = sine < 1.0 ? std::asin(sine) : kPi;
  if (middle - spread >= kEdge || middle + spread <= -kEdge) return {0, -1};
  return texels_between(std::tan(std::clamp(middle - spread, -kEdge, kEdge)),
                        std::tan(std::clamp(middle + spread, -kEdge, kEdge)), finer_size);
}

// Where on its face a texel's light is taken from: the outermost ones are taken a quarter of a
// texel nearer to the middle of the edge, by which the sampler's mixing across it is halved.
glm::dvec2 texel_position(int column, int row, int size) {
  glm::dvec2 p = texel_middle(column, row, size);
  const double shortened = 1.0 - 0.25 / size;
  if (column == 0 || column == size - 1) p.y *= shortened;
  if (row == 0 || row == size - 1) p.x *= shortened;
  return p;
}

// A texel of the level below `finer`, before it is rounded: shaders/pyramid_round.gdshader, where
// the formulas are explained.
glm::dvec3 blurred_texel(const Level& finer, const LevelKernel& kernel, int face, int column,
                         int row) {
  const int finer_size = finer.size;
  const double step = 2.0 / finer_size;
  const glm::dvec2 place = texel_position(column, row, finer_size / 2);
  const glm::dvec3 d = glm::normalize(face_direction(face, place));
  const double squared_place = glm::dot(place, place);
  const double texels =
      kernel.variance + kernel.shrinking * (1.0 - std::pow(1.0 + squared_place, -1.5));
  const double variance = texels / kReachedShare * step * step;  // of the whole Gaussian
  const double radius = step * 2.0 * std::sqrt(texels - kRimVariance);
  const double reach = kernel.is_gaussian
                           ? kKernelReach * std::sqrt(variance)
                           : 2.0 * std::asin(std::min(0.5 * radius + 0.25 * step, 1.0));

  const double slope = std::tan(reach);
  const double shift =
      (1.0 + squared_place) * slope / std::max(1.0 - glm::length(place) * slope, 1e-6);
  const bool is_inside =
      reach < 0.5 && std::max(std::abs(place.x), std::abs(place.y)) + shift < 1.0;
  const double least_cosine = std::cos(reach);

  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int n = 0; n < (is_inside ? 1 : kCubeFaces); ++n) {
    const int other = (face + n) % kCubeFaces;
    const glm::dvec3 forward = face_direction(other, {0.0, 0.0});
    const glm::dvec3 right = face_direction(other, {1.0, 0.0}) - forward;
    const glm::dvec3 down = face_direction(other, {0.0, 1.0}) - forward;
    const glm::dvec3 axes(glm::dot(d, right), glm::dot(d, down), glm::dot(d, forward));
    const Texels columns = is_inside ? texels_between(place.x - shift, place.x + shift, finer_size)
                                     : texels_within(axes.x, axes.z, reach, finer_size);
    const Texels rows = is_inside ? texels_between(place.y - shift, place.y + shift, finer_size)
                                  : texels_within(axes.y, axes.z, reach, finer_size);
    for (int y = rows.first; y <= rows.last; ++y) {
      const double down_part = (y + 0.5) * step - 1.0;
      const double along = axes.y * down_part + axes.z;
      const double squared_length = 1.0 + down_part * down_part;
      Texels chord = columns;
      if (is_inside) {
        const double across = least_cosine * least_cosine - axes.x * axes.x;
        const double root =
            least_cosine * std::sqrt(std::max(along * along - squared_length * across, 0.0));
        chord = texels_between((axes.x * along - root) / across, (axes.x * along + root) / across,
                               finer_size);
      }
      const float* texel = &finer.rgb[finer.at(other, chord.first, y)];
      for (int x = chord.first; x <= chord.last; ++x, texel += 3) {
        const double right_part = (x + 0.5) * step - 1.0;
        const double inverse_length = 1.0 / std::sqrt(squared_length + right_part * right_part);
        const double cosine = (axes.x * right_part + along) * inverse_length;
        const double squared = std::max(2.0 - 2.0 * cosine, 0.0);
        double weight = kernel.is_gaussian
                            ? std::exp(-0.5 * squared / variance)
                            : disc_weight(radius, std::sqrt(squared), step, kernel.slope);
        // Times the texel's solid angle.
        weight *= inverse_length * inverse_length * inverse_length;
        sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
        weights += weight;
      }
    }
  }
  return sum / weights;
}

// Fills a level, and its part of the faces, with what `texel` gives for face, column and row.
template <class Texel>
Level fill_level(LightPyramid& pyramid, int size, int level, const PyramidOptions& options,
                 Progress& progress, const Texel& texel) {
  Level filled{size,
               std::vector<float>(3 * static_cast<std::size_t>(kCubeFaces) *
                                  static_cast<std::size_t>(size) * static_cast<std::size_t>(size))};
  const std::size_t begin = level_begin(pyramid.size, level);
  const std::size_t rows = static_cast<std::size_t>(kCubeFaces) * static_cast<std::size_t>(size);
  const std::uint16_t one = half_from_double(1.0);
  std::atomic<std::size_t> done{0};
  parallel_for(rows, options.threads, progress, [&](std::size_t index) {
    const int face = static_cast<int>(index) / size;
    const int row = static_cast<int>(index) % size;
    std::uint16_t* half =
        &pyramid.faces[static_cast<std::size_t>(face)]
                      [begin + 4 * static_cast<std::size_t>(row) * static_cast<std::size_t>(size)];
    float* value = &filled.rgb[filled.at(face, 0, row)];
    for (int column = 0; column < size; ++column) {
      const glm::dvec3 mean = texel(face, column, row);
      for (int channel = 0; channel < 3; ++channel) {
        *half = half_from_double(mean[channel]);
        *value++ = static_cast<float>(double_from_half(*half++));
      }
      *half++ = one;
    }
    progress.set(static_cast<double>(++done) / static_cast<double>(rows));
  });
  return filled;
}

// About the fetches that a level takes, for the progress.
double level_cost(const PyramidOptions& options, int level) {
  const double side = options.size >> level;
  const double samples = options.base_variance > 0.0 ? 2.0 : options.samples;
  return side * side * (level == 0 ? 8.0 * samples * samples : 16.0 * 3.0 * options.level_variance);
}

}  // namespace

void validate(const PyramidOptions& options) {
  const int size = options.size;
  if (size < 1 || size > kMaxPyramidSize || (size & (size - 1)) != 0) {
    throw std::invalid_argument("size is " + std::to_string(size) +
                                ", but must be a power of two from 1 to " +
                                std::to_string(kMaxPyramidSize) + ".");
  }
  if (options.samples < 1 || options.samples > kMaxPyramidSamples) {
    throw std::invalid_argument("samples is " + std::to_string(options.samples) +
                                ", but must be from 1 to " + std::to_string(kMaxPyramidSamples) +
                                ".");
  }
  if (!(options.base_variance >= 0.0 && options.base_variance <= 16.0)) {
    throw std::invalid_argument("base_variance must be from 0 to 16.");
  }
  // A disc is no narrower than its rim, and a wider one no blur of the next level's texels.
  if (!(options.level_variance >= 0.1 && options.level_variance <= 16.0)) {
    throw std::invalid_argument("level_variance must be from 0.1 to 16.");
  }
}

std::size_t level_begin(int size, int level) {
  std::size_t begin = 0;
  for (int finer = 0; finer < level; ++finer) {
    const auto side = static_cast<std::size_t>(std::max(size >> finer, 1));
    begin += 4 * side * side;
  }
  return begin;
}

LightPyramid filter_panorama(const Panorama& panorama, const PyramidOptions& options,
                             Progress& progress) {
  validate(options);
  int levels = 1;
  double cost = level_cost(options, 0);
  for (; options.size >> levels > 0; ++levels) cost += level_cost(options, levels);
  LightPyramid pyramid;
  pyramid.size = options.size;
  for (auto& face : pyramid.faces) face.resize(level_begin(options.size, levels));

  const PanoramaLight light(panorama, options.is_srgb, options.as_sky);
  Progress first(progress, level_cost(options, 0) / cost);
  Level finer =
      fill_level(pyramid, options.size, 0, options, first, [&](int face, int column, int row) {
        const glm::dvec3 mean = level_0_texel(light, options, face, column, row);
        return glm::min(mean, glm::dvec3(static_cast<double>(kLargestHalf)));
      });
  for (int level = 1; level < levels; ++level) {
    const bool finer_is_blurred = level > 1 || options.base_variance > 0.0;
    const LevelKernel* coarse = coarse_disc(options.size >> level);
    LevelKernel kernel = coarse != nullptr
                             ? *coarse
                             : LevelKernel{options.is_gaussian, 3.0 * options.level_variance,
                                           3.0 * kTentVariance, 0.0};
    if (!finer_is_blurred) kernel.shrinking += kTentVariance;
    Progress part(progress, level_cost(options, level) / cost);
    finer = fill_level(pyramid, options.size >> level, level, options, part,
                       [&](int face, int column, int row) {
                         return blurred_texel(finer, kernel, face, column, row);
                       });
  }
  return pyramid;
}

}  // namespace lobelight
