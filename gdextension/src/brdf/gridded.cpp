#include "brdf/gridded.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace lobelight {

namespace {

// The cell of a coordinate in [0, 1], and where in it the coordinate lies.
struct Cell {
  std::size_t first;
  double fraction;
};

Cell cell_of(double coordinate, std::size_t nodes) {
  const auto cells = static_cast<double>(nodes - 1);
  // Written so that NaN ends in the first cell.
  const double c = coordinate > 0.0 ? std::min(coordinate, 1.0) * cells : 0.0;
  const std::size_t first = std::min(static_cast<std::size_t>(c), nodes - 2);
  return {first, c - static_cast<double>(first)};
}

// ∫_0^t of the line from v0 at 0 to v1 at 1.
double ramp_integral(double v0, double v1, double t) { return t * (v0 + 0.5 * t * (v1 - v0)); }

// t at which that integral is s: t = 2s / (v0 + √(v0² + 2 s (v1 − v0))), which does not cancel.
double invert_ramp(double v0, double v1, double s) {
  const double root = std::sqrt(std::max(0.0, v0 * v0 + 2.0 * s * (v1 - v0)));
  const double denominator = v0 + root;
  return denominator > 0.0 ? std::clamp(2.0 * s / denominator, 0.0, 1.0) : 0.0;
}

// The last i in [0, count − 1) with value(i) ≤ s, for ascending values.
template <typename Value>
std::size_t last_not_above(std::size_t count, double s, const Value& value) {
  std::size_t low = 0;
  std::size_t high = count - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (value(middle) <= s ? low : high) = middle;
  }
  return low;
}

struct Node {
  std::size_t first;
  std::size_t second;
  double fraction;
};

Node locate_node(const std::vector<double>& nodes, double value) {
  if (nodes.size() == 1 || !(value > nodes.front())) return {0, 0, 0.0};
  if (value >= nodes.back()) return {nodes.size() - 1, nodes.size() - 1, 0.0};
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), value);
  const auto second = static_cast<std::size_t>(above - nodes.begin());
  const double low = nodes[second - 1];
  return {second - 1, second, (value - low) / (nodes[second] - low)};
}

void check_nodes(const std::vector<double>& nodes) {
  bool ascending = !nodes.empty();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    ascending = ascending && std::isfinite(nodes[n]) && (n == 0 || nodes[n - 1] < nodes[n]);
  }
  if (!ascending) throw std::invalid_argument("the nodes of a parameter must ascend");
}

void check_size(const GridSize& size, std::size_t values) {
  if (size.columns < 2 || size.rows < 2 || values == 0 || values % size.values() != 0) {
    throw std::invalid_argument("a grid needs at least 2 x 2 values in every slice");
  }
}

}  // namespace

ParameterGrid::ParameterGrid(std::vector<double> first, std::vector<double> second)
    : first_(std::move(first)), second_(std::move(second)) {
  check_nodes(first_);
  check_nodes(second_);
}

Blend ParameterGrid::locate(double first, double second) const {
  const Node a = locate_node(first_, first);
  const Node b = locate_node(second_, second);
  const std::size_t stride = second_.size();
  Blend blend;
  blend.slice = {a.first * stride + b.first, a.first * stride + b.second,
                 a.second * stride + b.first, a.second * stride + b.second};
  blend.share = {(1.0 - a.fraction) * (1.0 - b.fraction), (1.0 - a.fraction) * b.fraction,
                 a.fraction * (1.0 - b.fraction), a.fraction * b.fraction};
  return blend;
}

GriddedFunction::GriddedFunction(const GridSize& size, std::vector<float> values)
    : size_(size), values_(std::move(values)) {
  check_size(size_, values_.size());
}

double GriddedFunction::value(const glm::dvec2& point, std::size_t slice) const {
  const Cell x = cell_of(point.x, size_.columns);
  const Cell y = cell_of(point.y, size_.rows);
  const float* low = &values_[slice * size_.values() + y.first * size_.columns + x.first];
  const float* high = low + size_.columns;
  const auto mix = [](const float* pair, double t) {
    return (1.0 - t) * static_cast<double>(pair[0]) + t * static_cast<double>(pair[1]);
  };
  return (1.0 - y.fraction) * mix(low, x.fraction) + y.fraction * mix(high, x.fraction);
}

GriddedDistribution::GriddedDistribution(const GridSize& size, const std::vector<float>& values)
    : size_(size), values_(values.begin(), values.end()) {
  check_size(size_, values_.size());
  const double dx = 1.0 / static_cast<double>(size_.columns - 1);
  const double dy = 1.0 / static_cast<double>(size_.rows - 1);
  const std::size_t slices = values_.size() / size_.values();
  along_.resize(values_.size());
  below_.resize(slices * size_.rows);
  for (std::size_t slice = 0; slice < slices; ++slice) {
    double* const value = &values_[slice * size_.values()];
    double* const along = &along_[slice * size_.values()];
    double* const below = &below_[slice * size_.rows];
    const auto integrate = [&] {
      double mass = 0.0;
      for (std::size_t row = 0; row < size_.rows; ++row) {
        const double* const v = value + row * size_.columns;
        double* const a = along + row * size_.columns;
        a[0] = 0.0;
        for (std::size_t c = 1; c < size_.columns; ++c) {
          a[c] = a[c - 1] + 0.5 * dx * (v[c - 1] + v[c]);
        }
        const double total = a[size_.columns - 1];
        if (row > 0) mass += 0.5 * dy * (a[-1] + total);
        below[row] = mass;
      }
      return mass;
    };
    double mass = integrate();
    if (!(mass > 0.0)) {
      std::fill(value, value + size_.values(), 1.0);
      mass = integrate();
    }
    const auto normalise = [mass](double& x) { x /= mass; };
    std::for_each(value, value + size_.values(), normalise);
    std::for_each(along, along + size_.values(), normalise);
    std::for_each(below, below + size_.rows, normalise);
  }
}

double GriddedDistribution::line_value(std::size_t row, double fraction, std::size_t column,
                                       const Blend& blend) const {
  double sum = 0.0;
  for (std::size_t n = 0; n < 4; ++n) {
    const double* v = &values_[blend.slice[n] * size_.values() + row * size_.columns + column];
    sum += blend.share[n] * ((1.0 - fraction) * v[0] + fraction * v[size_.columns]);
  }
  return sum;
}

double GriddedDistribution::line_integral(std::size_t row, double fraction, std::size_t column,
                                          const Blend& blend) const {
  double sum = 0.0;
  for (std::size_t n = 0; n < 4; ++n) {
    const double* a = &along_[blend.slice[n] * size_.values() + row * size_.columns + column];
    sum += blend.share[n] * ((1.0 - fraction) * a[0] + fraction * a[size_.columns]);
  }
  return sum;
}

double GriddedDistribution::row_integral(std::size_t row, const Blend& blend) const {
  double sum = 0.0;
  for (std::size_t n = 0; n < 4; ++n) {
    sum += blend.share[n] * along_[blend.slice[n] * size_.values() + (row + 1) * size_.columns - 1];
  }
  return sum;
}

double GriddedDistribution::mass_below(std::size_t row, const Blend& blend) const {
  double sum = 0.0;
  for (std::size_t n = 0; n < 4; ++n) {
    sum += blend.share[n] * below_[blend.slice[n] * size_.rows + row];
  }
  return sum;
}

double GriddedDistribution::density(const glm::dvec2& point, const Blend& blend) const {
  const Cell x = cell_of(point.x, size_.columns);
  const Cell y = cell_of(point.y, size_.rows);
  return (1.0 - x.fraction) * line_value(y.first, y.fraction, x.first, blend) +
         x.fraction * line_value(y.first, y.fraction, x.first + 1, blend);
}

double GriddedDistribution::marginal_cdf(double y, const Blend& blend) const {
  const Cell cell = cell_of(y, size_.rows);
  const double dy = 1.0 / static_cast<double>(size_.rows - 1);
  return mass_below(cell.first, blend) + dy * ramp_integral(row_integral(cell.first, blend),
                                                            row_integral(cell.first + 1, blend),
                                                            cell.fraction);
}

glm::dvec2 GriddedDistribution::sample(const glm::dvec2& u, const Blend& blend) const {
  const auto cells_x = static_cast<double>(size_.columns - 1);
  const auto cells_y = static_cast<double>(size_.rows - 1);
  const std::size_t row =
      last_not_above(size_.rows, u.y, [&](std::size_t r) { return mass_below(r, blend); });
  const double fraction = invert_ramp(row_integral(row, blend), row_integral(row + 1, blend),
                                      (u.y - mass_below(row, blend)) * cells_y);

  const double s = u.x * line_integral(row, fraction, size_.columns - 1, blend);
  const std::size_t column = last_not_above(
      size_.columns, s, [&](std::size_t c) { return line_integral(row, fraction, c, blend); });
  const double rest = (s - line_integral(row, fraction, column, blend)) * cells_x;
  const double x = invert_ramp(line_value(row, fraction, column, blend),
                               line_value(row, fraction, column + 1, blend), rest);
  return {(static_cast<double>(column) + x) / cells_x,
          (static_cast<double>(row) + fraction) / cells_y};
}

glm::dvec2 GriddedDistribution::invert(const glm::dvec2& point, const Blend& blend) const {
  const Cell x = cell_of(point.x, size_.columns);
  const Cell y = cell_of(point.y, size_.rows);
  const double dx = 1.0 / static_cast<double>(size_.columns - 1);
  const double total = line_integral(y.first, y.fraction, size_.columns - 1, blend);
  const double before =
      line_integral(y.first, y.fraction, x.first, blend) +
      dx * ramp_integral(line_value(y.first, y.fraction, x.first, blend),
                         line_value(y.first, y.fraction, x.first + 1, blend), x.fraction);
  return {total > 0.0 ? std::min(1.0, before / total) : 0.0, marginal_cdf(point.y, blend)};
}

}  // namespace lobelight
