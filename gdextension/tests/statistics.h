#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <random>

namespace lobelight::testing {

// Uniform numbers in [0, 1), the same on every machine (std::uniform_real_distribution is not).
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  glm::dvec2 next2() {
    const double x = next();
    return {x, next()};
  }
  glm::dvec3 direction();        // uniform on the sphere
  glm::dvec3 direction_above();  // uniform on the upper hemisphere

 private:
  std::mt19937_64 engine_;
};

// Probability that a χ² variable with `degrees` degrees of freedom exceeds `statistic`.
double chi_square_tail(double statistic, int degrees);

struct SphereTest {
  int samples = 400000;
  int rows = 24;     // bins in z
  int columns = 36;  // bins in azimuth
  double lowest_z = -1.0;
  int subdivisions = 24;  // per bin and axis, for the integral of the density
  std::uint64_t seed = 1;
};

// p-value of Pearson's χ² test that `sampler` draws directions with the density `pdf` (1/sr). The
// sphere above lowest_z is cut into bins of equal solid angle; a sample that the sampler refuses
// falls into one bin more, whose expectation is what the density lacks to 1. Bins that expect fewer
// than five samples are pooled, as in Mitsuba 3's chi2.py.
double sampler_p_value(const std::function<double(const glm::dvec3&)>& pdf,
                       const std::function<std::optional<glm::dvec3>(const glm::dvec2&)>& sampler,
                       const SphereTest& test);

// Threshold for one of `tests` p-values so that all of them pass together with probability 0.99
// where every hypothesis holds (Šidák's correction).
double significance(int tests);

}  // namespace lobelight::testing
