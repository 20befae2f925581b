#include "image/compact_sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "base/pi.h"

namespace lobelight {

namespace {

constexpr double kDegree = kPi / 180.0;
// Texels are no larger than about half the reach.
constexpr int kLeastHeight = 64;
constexpr int kMostSeeds = 8;
constexpr double kReach = 5.0 * kDegree;
// Circles of equal solid angles between 5° and 10°, and directions on each.
constexpr std::array<double, 4> kRing = {5.75 * kDegree, 7.1 * kDegree, 8.2 * kDegree,
                                         9.4 * kDegree};
constexpr int kAzimuths = 32;
constexpr double kAboveRing = 1.5;
constexpr double kMostContrast = 65536.0;
constexpr double kLevelRatio = 4.0;
constexpr int kLineParts = 16;
// Texels after which it is time to ask whether to go on.
constexpr std::size_t kBetweenChecks = 4096;
constexpr double kMostDeviation = 1.2 * kDegree;
constexpr double kLeastFilling = 0.25;
constexpr double kLeastShare = 0.02;

class SourceFinder {
 public:
  SourceFinder(Panorama& panorama, int threads, Progress& progress)
      : panorama_(panorama),
        width_(panorama.width),
        height_(panorama.height),
        threads_(threads),
        progress_(progress),
        azimuths_(static_cast<std::size_t>(width_)),
        rows_(static_cast<std::size_t>(height_)) {
    for (int column = 0; column < width_; ++column) {
      const double azimuth = 2.0 * kPi * (column + 0.5) / width_;
      azimuths_[static_cast<std::size_t>(column)] = {std::sin(azimuth), -std::cos(azimuth)};
    }
    look_at_rows(0, height_);
  }

  // The next source, taken out; none if the seed is rejected.
  std::optional<CompactSource> take() {
    const std::optional<Texel> seed = brightest();
    if (!seed) return std::nullopt;
    const glm::dvec3 middle = direction(seed->row, seed->column);
    std::vector<Texel> texels;
    const double lowest = std::max(kAboveRing * ring_level(middle), seed->mean / kMostContrast);
    double total = 0.0;
    for (const Row& row : rows_) total += row.sum;
    for (double level = lowest; level < 0.5 * seed->mean; level *= kLevelRatio) {
      if (texels.empty()) texels = texels_near(middle, level);
      // The seed may lie at the edge.
      const glm::dvec3 first = shape_of(joined_to(middle, texels, level), level).direction;
      const std::vector<Texel> region = joined_to(first, texels, level);
      const std::optional<Shape> shape = compact_shape(region, level, seed->mean);
      if (!shape) continue;
      if (shape->energy < kLeastShare * total) break;
      return cut(middle, region, level, *shape);
    }
    rejected_.push_back(middle);
    look_at_rows_near(middle);
    return std::nullopt;
  }

 private:
  struct Texel {
    int row;
    int column;
    double mean;
  };

  // What is known of a row: its brightest texel that may be a seed, and its light.
  struct Row {
    double peak = 0.0;
    int column = 0;
    double sum = 0.0;  // of the texels' means times their solid angles
  };

  // Of what sticks out, by the channels' mean.
  struct Shape {
    glm::dvec3 direction;
    double variance;
    double energy;
  };

  std::size_t at(int row, int column) const {
    return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(column));
  }

  double channel(std::size_t index) const {
    const float value = panorama_.rgb[index];
    return value > 0.0f && value <= std::numeric_limits<float>::max() ? static_cast<double>(value)
                                                                      : 0.0;
  }

  double mean(int row, int column) const {
    const std::size_t first = at(row, column);
    return (channel(first) + channel(first + 1) + channel(first + 2)) / 3.0;
  }

  // At the texel that a direction, which need not be a unit vector, lies in.
  double mean(const glm::dvec3& d) const {
    const glm::dvec2 position = panorama_position(glm::normalize(d));
    return mean(std::min(static_cast<int>(position.y * height_), height_ - 1),
                std::min(static_cast<int>(position.x * width_), width_ - 1));
  }

  // Of the four texels whose middles are around a direction, the brightest.
  double mean_around(const glm::dvec3& d) const {
    const glm::dvec2 position = panorama_position(glm::normalize(d));
    const int left = static_cast<int>(std::floor(position.x * width_ - 0.5)) + width_;
    const int top = static_cast<int>(std::floor(position.y * height_ - 0.5));
    double most = 0.0;
    for (const int row : {std::max(top, 0), std::min(top + 1, height_ - 1)}) {
      most = std::max({most, mean(row, left % width_), mean(row, (left + 1) % width_)});
    }
    return most;
  }

  glm::dvec3 direction(int row, int column) const {
    const double polar = kPi * (row + 0.5) / height_;
    const glm::dvec2& azimuth = azimuths_[static_cast<std::size_t>(column)];
    return {std::sin(polar) * azimuth.x, std::cos(polar), std::sin(polar) * azimuth.y};
  }

  double solid_angle(int row) const {
    const double top = std::cos(kPi * row / height_);
    const double bottom = std::cos(kPi * (row + 1) / height_);
    return 2.0 * kPi / width_ * (top - bottom);
  }

  void look_at_rows(int first, int end) {
    parallel_for(static_cast<std::size_t>(end - first), threads_, progress_,
                 [&](std::size_t index) { look_at_row(first + static_cast<int>(index)); });
  }

  void look_at_row(int row) {
    Row seen;
    for (int column = 0; column < width_; ++column) {
      const double value = mean(row, column);
      seen.sum += value;
      if (value > seen.peak && !is_near_rejected(row, column)) {
        seen.peak = value;
        seen.column = column;
      }
    }
    seen.sum *= solid_angle(row);
    rows_[static_cast<std::size_t>(row)] = seen;
  }

  bool is_near_rejected(int row, int column) const {
    if (rejected_.empty()) return false;
    const glm::dvec3 d = direction(row, column);
    return std::any_of(rejected_.begin(), rejected_.end(), [&](const glm::dvec3& seed) {
      return glm::dot(seed, d) > std::cos(kReach);
    });
  }

  // The first row within the reach, and the one after the last.
  std::array<int, 2> rows_near(const glm::dvec3& middle) const {
    const double row = panorama_position(middle).y * height_;
    const double reach = kReach / kPi * height_ + 1.0;
    return {std::max(static_cast<int>(std::floor(row - reach)), 0),
            std::min(static_cast<int>(std::ceil(row + reach)), height_)};
  }

  void look_at_rows_near(const glm::dvec3& middle) {
    const std::array<int, 2> near = rows_near(middle);
    look_at_rows(near[0], near[1]);
  }

  std::optional<Texel> brightest() const {
    Texel found{0, 0, 0.0};
    for (int row = 0; row < height_; ++row) {
      const Row& seen = rows_[static_cast<std::size_t>(row)];
      if (seen.peak > found.mean) found = {row, seen.column, seen.peak};
    }
    if (!(found.mean > 0.0)) return std::nullopt;
    return found;
  }

  double ring_level(const glm::dvec3& middle) const {
    const glm::dvec3 axis =
        std::abs(middle.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(axis, middle));
    const glm::dvec3 bitangent = glm::cross(middle, tangent);
    std::vector<double> levels;
    for (const double angle : kRing) {
      for (int k = 0; k < kAzimuths; ++k) {
        const double azimuth = 2.0 * kPi * k / kAzimuths;
        levels.push_back(
            mean(std::cos(angle) * middle +
                 std::sin(angle) * (std::cos(azimuth) * tangent + std::sin(azimuth) * bitangent)));
      }
    }
    const auto median = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
    std::nth_element(levels.begin(), median, levels.end());
    return *median;
  }

  // Those within the reach that are brighter than a level, row by row.
  std::vector<Texel> texels_near(const glm::dvec3& middle, double level) const {
    std::vector<Texel> found;
    const double least_cosine = std::cos(kReach);
    const std::array<int, 2> near = rows_near(middle);
    for (int row = near[0]; row < near[1]; ++row) {
      progress_.throw_if_cancelled();
      for (int column = 0; column < width_; ++column) {
        const double value = mean(row, column);
        if (value > level && glm::dot(direction(row, column), middle) > least_cosine) {
          found.push_back({row, column, value});
        }
      }
    }
    return found;
  }

  std::vector<Texel> joined_to(const glm::dvec3& middle, const std::vector<Texel>& texels,
                               double level) const {
    std::vector<Texel> joined;
    for (std::size_t n = 0; n < texels.size(); ++n) {
      if (n % kBetweenChecks == 0) progress_.throw_if_cancelled();
      const Texel& texel = texels[n];
      if (!(texel.mean > level)) continue;
      const glm::dvec3 step = (middle - direction(texel.row, texel.column)) / double{kLineParts};
      bool is_joined = true;
      for (int k = 1; k < kLineParts && is_joined; ++k) {
        is_joined = mean_around(middle - static_cast<double>(k) * step) > level;
      }
      if (is_joined) joined.push_back(texel);
    }
    return joined;
  }

  // The variance is without the bilinear filter's.
  Shape shape_of(const std::vector<Texel>& region, double level) const {
    double energy = 0.0;
    glm::dvec3 moment(0.0);
    for (const Texel& texel : region) {
      const double weight = (texel.mean - level) * solid_angle(texel.row);
      energy += weight;
      moment += weight * direction(texel.row, texel.column);
    }
    const glm::dvec3 middle = glm::normalize(moment);
    double squares = 0.0;
    for (const Texel& texel : region) {
      const glm::dvec3 off = direction(texel.row, texel.column) - middle;
      squares += (texel.mean - level) * solid_angle(texel.row) * glm::dot(off, off);
    }
    return {middle, 0.5 * squares / energy, energy};
  }

  std::optional<Shape> compact_shape(const std::vector<Texel>& region, double level,
                                     double peak) const {
    if (region.empty()) return std::nullopt;
    Shape shape = shape_of(region, level);
    if (shape.variance > kMostDeviation * kMostDeviation) return std::nullopt;
    // The filter is a tent, of a sixth of a squared texel along each axis.
    const double sine = std::hypot(shape.direction.x, shape.direction.z);
    const glm::dvec2 texel(2.0 * kPi * sine / width_, kPi / height_);
    shape.variance += glm::dot(texel, texel) / 12.0;
    const double of_gaussian = 2.0 * kPi * shape.variance * (peak - level);
    // What is as narrow as the texels has no shape.
    const bool is_resolved = shape.variance > texel.y * texel.y;
    if (is_resolved && shape.energy < kLeastFilling * of_gaussian) return std::nullopt;
    return shape;
  }

  CompactSource cut(const glm::dvec3& seed, const std::vector<Texel>& region, double level,
                    const Shape& shape) {
    glm::dvec3 energy(0.0);
    for (const Texel& texel : region) {
      for (int c = 0; c < 3; ++c) {
        const std::size_t index = at(texel.row, texel.column) + static_cast<std::size_t>(c);
        const double before = channel(index);
        panorama_.rgb[index] = static_cast<float>(before * level / texel.mean);
        energy[c] += (before - static_cast<double>(panorama_.rgb[index])) * solid_angle(texel.row);
      }
    }
    look_at_rows_near(seed);
    return {shape.direction, std::sqrt(shape.variance), energy};
  }

  Panorama& panorama_;
  int width_;
  int height_;
  int threads_;
  Progress& progress_;
  std::vector<glm::dvec2> azimuths_;  // x and z of each column's directions at the equator
  std::vector<Row> rows_;
  std::vector<glm::dvec3> rejected_;
};

}  // namespace

std::vector<CompactSource> take_sources(Panorama& panorama, int most, int threads,
                                        Progress& progress) {
  std::vector<CompactSource> sources;
  if (most < 1 || panorama.height < kLeastHeight) return sources;
  SourceFinder finder(panorama, threads, progress);
  for (int seed = 0; seed < kMostSeeds && static_cast<int>(sources.size()) < most; ++seed) {
    if (const std::optional<CompactSource> source = finder.take()) sources.push_back(*source);
  }
  return sources;
}

std::vector<float> source_texels(const std::vector<CompactSource>& sources) {
  constexpr std::size_t kRow = 4 * kMaxSources;
  constexpr double kFiner = 1024.0;
  std::vector<float> texels(3 * kRow);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const CompactSource& source = sources[n];
    float* texel = &texels[4 * n];
    for (int axis = 0; axis < 3; ++axis) {
      // Where this is not volatile, g++ 12 vectorises the loop and leaves the rounding out.
      const volatile float rounded = static_cast<float>(source.direction[axis]);
      texel[axis] = rounded;
      texel[kRow + static_cast<std::size_t>(axis)] = static_cast<float>(source.energy[axis]);
      texel[2 * kRow + static_cast<std::size_t>(axis)] =
          static_cast<float>(kFiner * (source.direction[axis] - static_cast<double>(rounded)));
    }
    texel[3] = static_cast<float>(source.deviation);
  }
  return texels;
}

}  // namespace lobelight
