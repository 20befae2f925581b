#include "sg/spherical_gaussian.h"

#include <cmath>
#include <limits>

#include "base/pi.h"
#include "sg/frame.h"

namespace lobelight {

namespace {

constexpr double kTwoPi = 2.0 * kPi;

// Below this sharpness the closed form of R̄ cancels; its series is exact to a few ulp there.
constexpr double kSeriesLimit = 0.25;

// coth κ − 1/κ = κ/3 − κ³/45 + 2κ⁵/945 − …  (radius of convergence π)
double mean_resultant_series(double kappa) {
  const double q = kappa * kappa;
  return kappa * (1.0 / 3.0 +
                  q * (-1.0 / 45.0 +
                       q * (2.0 / 945.0 + q * (-1.0 / 4725.0 +
                                               q * (2.0 / 93555.0 + q * (-1382.0 / 638512875.0 +
                                                                         q * 4.0 / 18243225.0))))));
}

}  // namespace

double log_normalisation(double kappa) {
  // (1 − e^{−2κ})/κ → 2 as κ → 0; expm1 keeps the quotient exact down to the smallest numbers.
  if (!(kappa > std::numeric_limits<double>::min())) return -std::log(2.0 * kTwoPi);
  return std::log(kappa / (-kTwoPi * std::expm1(-2.0 * kappa)));
}

double log_density(const SphericalGaussian& gaussian, const glm::dvec3& direction) {
  const glm::dvec3 d = direction - gaussian.mean;
  return log_normalisation(gaussian.kappa) - 0.5 * gaussian.kappa * glm::dot(d, d);
}

double density(const SphericalGaussian& gaussian, const glm::dvec3& direction) {
  return std::exp(log_density(gaussian, direction));
}

double coverage_one_minus_cosine(double kappa, double coverage) {
  // Mass within θ: (1 − e^{−κ(1 − cos θ)}) / (1 − e^{−2κ}); solved for 1 − cos θ.
  // t = 2 coverage (1 − κ (1 − coverage) + …): the first term alone where κ is below the last bit,
  // and well before κ · coverage underflows.
  if (!(kappa > 1e-17)) return 2.0 * coverage;
  // What lies beyond θ, e^{−κ(1 − cos θ)} = 1 − m with m = coverage (1 − e^{−2κ}), as the sum of
  // two positive numbers where it is small: close to full coverage 1 − m would be nothing but
  // rounding.
  const double m = -coverage * std::expm1(-2.0 * kappa);
  const double log_rest =
      m < 0.5 ? std::log1p(-m) : std::log((1.0 - coverage) + coverage * std::exp(-2.0 * kappa));
  // Full coverage of a sharp lobe has e^{−2κ} = 0: the whole sphere is the bound.
  return std::fmin(2.0, -log_rest / kappa);
}

glm::dvec3 sample(const SphericalGaussian& gaussian, const glm::dvec2& u) {
  // The cap with the share u.x of the mass has a boundary that is distributed as the density is.
  const double t = coverage_one_minus_cosine(gaussian.kappa, u.x);
  const double sine = std::sqrt(t * (2.0 - t));
  const double angle = kTwoPi * u.y;
  const Frame frame = frame_around(gaussian.mean);
  return glm::normalize(frame.x * (sine * std::cos(angle)) + frame.y * (sine * std::sin(angle)) +
                        gaussian.mean * (1.0 - t));
}

double one_minus_mean_resultant(double kappa) {
  if (kappa < kSeriesLimit) return 1.0 - mean_resultant_series(kappa);
  // 1 − coth κ + 1/κ with coth κ = 1 + 2/(e^{2κ} − 1): nothing cancels where κ is large.
  return 1.0 / kappa - 2.0 / std::expm1(2.0 * kappa);
}

double kappa_from_one_minus_mean_resultant(double one_minus_r) {
  if (!(one_minus_r > 0.0)) return std::numeric_limits<double>::infinity();
  if (one_minus_r >= 1.0) return 0.0;
  // From κ = 20 upwards 2/(e^{2κ} − 1) is below the last bit of 1/κ.
  if (one_minus_r <= 0.05) return 1.0 / one_minus_r;

  // Start: Banerjee et al. 2005, "Clustering on the unit hypersphere using von Mises–Fisher
  // distributions", eq. 4.4 for the sphere in three dimensions; then Newton on R̄(κ) − R̄ = 0 with
  // R̄' = 1 − R̄² − 2R̄/κ. Five steps are two more than any R̄ needs.
  const double r = 1.0 - one_minus_r;
  double kappa = r * (3.0 - r * r) / (1.0 - r * r);
  for (int step = 0; step < 5; ++step) {
    if (kappa < kSeriesLimit) {
      const double slope = 1.0 / 3.0 - kappa * kappa * (1.0 / 15.0 - kappa * kappa * 2.0 / 189.0);
      kappa -= (mean_resultant_series(kappa) - r) / slope;
    } else {
      const double error = one_minus_r - one_minus_mean_resultant(kappa);
      const double a = r + error;
      kappa -= error / (1.0 - a * a - 2.0 * a / kappa);
    }
  }
  return kappa;
}

}  // namespace lobelight
