#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace lobelight {

// Functions on the unit square, tabulated at the corners of (columns − 1) × (rows − 1) equal cells
// and bilinear within each: x runs along a row, y from row to row. There is one such slice for
// every pair of nodes of two parameters; between nodes slices are blended linearly. This is how
// Dupuy and Jakob 2018, "An adaptive parameterization for efficient material acquisition and
// rendering", store reflectance.

// The slices between which a pair of parameters lies, and their shares, which sum to 1.
struct Blend {
  std::array<std::size_t, 4> slice{};
  std::array<double, 4> share{};
};

// Nodes of two parameters, ascending; slice (a, b) is number a · second.size() + b. Parameters
// beyond the nodes are clamped.
class ParameterGrid {
 public:
  // At least one node each; throws std::invalid_argument where they do not ascend.
  ParameterGrid(std::vector<double> first, std::vector<double> second);

  std::size_t slices() const { return first_.size() * second_.size(); }
  const std::vector<double>& first() const { return first_; }
  const std::vector<double>& second() const { return second_; }
  Blend locate(double first, double second) const;

 private:
  std::vector<double> first_;
  std::vector<double> second_;
};

// The size of every slice, at least 2 × 2.
struct GridSize {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::size_t values() const { return columns * rows; }
};

// Tabulated functions as they are.
class GriddedFunction {
 public:
  // `values`: slice by slice, row by row. Throws std::invalid_argument for a wrong count.
  GriddedFunction(const GridSize& size, std::vector<float> values);

  const GridSize& size() const { return size_; }

  // Value of one slice at a point, which is clamped to the unit square.
  double value(const glm::dvec2& point, std::size_t slice = 0) const;

 private:
  GridSize size_;
  std::vector<float> values_;
};

// Tabulated functions as densities: every slice is divided by its integral, so any blend of slices
// integrates to 1. A slice of zeros becomes the uniform density.
//
// Sampling chooses y by the marginal density and then x by the conditional one. Blending is linear
// in the values and in their integrals, and within a cell both are quadratic, so that the map from
// [0, 1)² to points and its inverse are exact.
class GriddedDistribution {
 public:
  // `values` as in GriddedFunction, finite and ≥ 0.
  GriddedDistribution(const GridSize& size, const std::vector<float>& values);

  double density(const glm::dvec2& point, const Blend& blend) const;

  // The point to which u belongs, and back: u of a point where the density is not 0.
  glm::dvec2 sample(const glm::dvec2& u, const Blend& blend) const;
  glm::dvec2 invert(const glm::dvec2& point, const Blend& blend) const;

  // Share of the mass below y.
  double marginal_cdf(double y, const Blend& blend) const;

 private:
  // Blended values and integrals along the line at height `fraction` between two rows.
  double line_value(std::size_t row, double fraction, std::size_t column, const Blend&) const;
  double line_integral(std::size_t row, double fraction, std::size_t column, const Blend&) const;
  double row_integral(std::size_t row, const Blend&) const;
  double mass_below(std::size_t row, const Blend&) const;

  GridSize size_;
  std::vector<double> values_;
  std::vector<double> along_;  // integral along the row from x = 0, one for each value
  std::vector<double> below_;  // mass below the row, one for each row
};

}  // namespace lobelight
