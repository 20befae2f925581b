#include <doctest/doctest.h>

#include <cmath>

#include "fit/symmetric_eigen.h"
#include "statistics.h"

namespace lobelight {
namespace {

TEST_CASE("diagonalise finds orthonormal eigenvectors with their eigenvalues") {
  testing::Uniform uniform(5);
  for (const std::size_t size : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    for (int trial = 0; trial < 100; ++trial) {
      Matrix3 matrix{};
      for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          matrix[i][j] = matrix[j][i] = std::exp(8.0 * uniform.next()) * (uniform.next() - 0.5);
        }
      }
      Matrix3 values = matrix;
      Matrix3 vectors{};
      diagonalise(values, vectors, size, 1e-15, 0.0);
      double scale = 0.0;
      for (const auto& row : matrix) {
        for (const double element : row) scale = std::max(scale, std::abs(element));
      }
      for (std::size_t e = 0; e < size; ++e) {
        for (std::size_t i = 0; i < size; ++i) {
          double product = 0.0;
          double dot = 0.0;
          for (std::size_t j = 0; j < size; ++j) {
            product += matrix[i][j] * vectors[j][e];
            dot += vectors[j][i] * vectors[j][e];
          }
          CHECK(std::abs(product - values[e][e] * vectors[i][e]) < 1e-13 * scale);
          CHECK(std::abs(dot - (i == e ? 1.0 : 0.0)) < 1e-14);
        }
      }
    }
  }
}

TEST_CASE("diagonalise leaves alone what is negligible") {
  Matrix3 matrix{{{1.0, 1e-10, 0.0}, {1e-10, 1.0, 0.0}, {0.0, 0.0, 2.0}}};
  Matrix3 vectors{};
  diagonalise(matrix, vectors, 3, 0.0, 1e-9);
  CHECK(vectors == Matrix3{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}});
}

}  // namespace
}  // namespace lobelight
