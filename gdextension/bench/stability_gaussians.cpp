// Spherical Gaussians of every sharpness: the functions of sg/spherical_gaussian.h at inputs that
// are printed with their results.

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pi.h"
#include "sg/frame.h"
#include "sg/spherical_gaussian.h"
#include "stability.h"

namespace lobelight::stability {

namespace {

// 1e-8 … 1e10, and where the library goes from one formula to another (0.25 and 20).
std::vector<double> sharpnesses(bool quick) {
  std::vector<double> kappas{0.0, 1e-300, 0.2499999, 0.25, 0.2500001, 19.99, 20.01};
  const int steps = quick ? 1 : 4;
  for (int n = -8 * steps; n <= 10 * steps; ++n) {
    kappas.push_back(std::pow(10.0, static_cast<double>(n) / steps));
  }
  return kappas;
}

const std::vector<glm::dvec3>& means() {
  static const std::vector<glm::dvec3> list{{0.0, 0.0, 1.0},
                                            {0.0, 0.0, -1.0},
                                            glm::normalize(glm::dvec3(0.3, -0.5, 0.2)),
                                            glm::normalize(glm::dvec3(1.0, 1e-9, -1e-12))};
  return list;
}

// Angles from the mean: multiples of the lobe's width, and the far side of the sphere.
std::vector<double> angles(double kappa) {
  const double width = kappa > 0.1 ? 1.0 / std::sqrt(kappa) : kPi;
  std::vector<double> list{0.0, 0.5 * kPi, kPi};
  for (const double factor : {1e-3, 0.5, 1.0, 3.0, 8.0}) {
    if (factor * width < kPi) list.push_back(factor * width);
  }
  return list;
}

// Directions at these angles from every mean; seven numbers each: mean, direction, value.
template <typename F>
void evaluate_around(Record& record, double kappa, F function) {
  std::vector<double> values;
  for (const glm::dvec3& mean : means()) {
    const Frame frame = frame_around(mean);
    for (const double angle : angles(kappa)) {
      const glm::dvec3 side = std::cos(2.1) * frame.x + std::sin(2.1) * frame.y;
      const glm::dvec3 x = glm::normalize(std::cos(angle) * mean + std::sin(angle) * side);
      values.insert(values.end(), {mean.x, mean.y, mean.z, x.x, x.y, x.z,
                                   function(SphericalGaussian{mean, kappa}, x)});
    }
  }
  record.set("values", values);
}

// ∫ g dω by Gauss–Legendre with two nodes a cell, over the angle from the mean.
double integral(double kappa) {
  constexpr int kCells = 4000;
  const double end = kappa > 0.0 ? std::min(kPi, std::sqrt(100.0 / kappa)) : kPi;
  double sum = 0.0;
  for (int n = 0; n < kCells; ++n) {
    for (const double node : {0.21132486540518712, 0.78867513459481288}) {
      const double angle = end * (n + node) / kCells;
      const double sine = std::sin(angle);
      sum += sine * density({{0.0, 0.0, 1.0}, kappa}, {sine, 0.0, std::cos(angle)});
    }
  }
  return 2.0 * kPi * sum * end / (2 * kCells);
}

void coverage(Record& record, double kappa) {
  std::vector<double> values;
  for (const double share : {0.0, 1e-18, 1e-12, 1e-6, 0.01, 0.1, 0.25, 0.47, 0.5, 0.77, 0.9, 0.999,
                             1.0 - 1e-9, 1.0 - 0x1p-53, 1.0}) {
    values.insert(values.end(), {share, coverage_one_minus_cosine(kappa, share)});
  }
  record.set("values", values);
}

void samples(Record& record, double kappa) {
  std::vector<double> values;
  for (const glm::dvec3& mean : means()) {
    for (const double u : {0.0, 1e-12, 0.02, 0.3, 0.7, 0.98, 1.0 - 1e-9, 1.0 - 0x1p-53}) {
      for (const double v : {0.0, 0.21, 0.5, 0.83}) {
        const glm::dvec3 x = sample({mean, kappa}, {u, v});
        values.insert(values.end(), {mean.x, mean.y, mean.z, u, v, x.x, x.y, x.z});
      }
    }
  }
  record.set("values", values);
}

}  // namespace

std::vector<Case> gaussian_cases(bool quick) {
  std::vector<Case> cases;
  for (const double kappa : sharpnesses(quick)) {
    const std::string suffix = " kappa " + short_number(kappa);
    const auto add = [&](const char* function, auto run) {
      cases.push_back({"gaussian " + std::string(function) + suffix, [=](Record& record) {
                         record.set("function", function).set("kappa", kappa);
                         run(record);
                       }});
    };
    add("log density", [=](Record& r) { evaluate_around(r, kappa, log_density); });
    add("density", [=](Record& r) {
      evaluate_around(r, kappa, density);
      r.set("integral", integral(kappa));
    });
    add("coverage", [=](Record& r) { coverage(r, kappa); });
    add("mean resultant",
        [=](Record& r) { r.set("values", std::vector<double>{one_minus_mean_resultant(kappa)}); });
    add("kappa from resultant", [=](Record& r) {
      const double t = one_minus_mean_resultant(kappa);
      r.set("values", std::vector<double>{t, kappa_from_one_minus_mean_resultant(t)});
    });
    add("sample", [=](Record& r) { samples(r, kappa); });
  }
  return cases;
}

}  // namespace lobelight::stability
