#include "fit/symmetric_eigen.h"

#include <cmath>

namespace lobelight {

void diagonalise(Matrix3& a, Matrix3& vectors, std::size_t size, double relative,
                 double negligible) {
  vectors = {};
  for (std::size_t i = 0; i < 3; ++i) vectors[i][i] = 1.0;
  constexpr int kSweeps = 12;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t p = 0; p < size; ++p) {
      for (std::size_t q = p + 1; q < size; ++q) {
        const double beside = std::abs(a[p][p]) + std::abs(a[q][q]);
        if (std::abs(a[p][q]) <= relative * beside + negligible) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
        const double c = 1.0 / std::hypot(t, 1.0);
        const double s = t * c;
        const auto turn = [c, s](double& x, double& y) {
          const double before = x;
          x = c * before - s * y;
          y = s * before + c * y;
        };
        for (std::size_t i = 0; i < size; ++i) turn(a[i][p], a[i][q]);
        for (std::size_t i = 0; i < size; ++i) turn(a[p][i], a[q][i]);
        for (std::size_t i = 0; i < size; ++i) turn(vectors[i][p], vectors[i][q]);
      }
    }
  }
}

}  // namespace lobelight
