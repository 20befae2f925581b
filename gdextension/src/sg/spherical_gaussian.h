#pragma once

#include <glm/glm.hpp>

namespace lobelight {

// A spherical Gaussian (von Mises–Fisher density) on the unit sphere:
//   g(x; μ, κ) = κ / (2π (1 − e^{−2κ})) · e^{−κ |x − μ|² / 2}     [1/sr], ∫ g dω = 1
// which is κ / (4π sinh κ) · e^{κ μ·x} (Töral 2015, eq. 2.2) without its overflow and without the
// cancellation of μ·x − 1. Every function below holds for κ from 0 (the uniform density 1/4π) to
// 1e10.
struct SphericalGaussian {
  glm::dvec3 mean{0.0, 0.0, 1.0};  // unit vector
  double kappa = 0.0;              // sharpness, ≥ 0; per-axis variance 1/κ where κ is large
};

// log of the factor before the exponential: log(κ / (2π (1 − e^{−2κ}))).
double log_normalisation(double kappa);

// Logarithm of the density at the unit vector `direction`; the density itself, in 1/sr.
double log_density(const SphericalGaussian& gaussian, const glm::dvec3& direction);
double density(const SphericalGaussian& gaussian, const glm::dvec3& direction);

// Unit vector distributed as `gaussian` for u uniform in [0, 1)²: u.x chooses the distance from the
// mean (0 is the mean itself), u.y the angle around it.
glm::dvec3 sample(const SphericalGaussian& gaussian, const glm::dvec2& u);

// 1 − cos θ of the cap around the mean that holds `coverage` ∈ [0, 1] of the mass. Exact where
// Töral's eq. 2.8 is the limit of large κ.
double coverage_one_minus_cosine(double kappa, double coverage);

// 1 − R̄ of the density, R̄ = coth κ − 1/κ being the length of its mean vector.
double one_minus_mean_resultant(double kappa);

// The inverse: κ whose density has the given 1 − R̄. Infinity at 0 and below, 0 at 1 and above.
double kappa_from_one_minus_mean_resultant(double one_minus_r);

}  // namespace lobelight
