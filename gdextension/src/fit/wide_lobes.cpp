#include "fit/wide_lobes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/pi.h"
#include "fit/pyramid_kernel.h"
#include "fit/slice.h"

namespace lobelight {

namespace {

constexpr int kDegrees = kHarmonicDegrees;
// Functions that are even in y: degree l has l + 1 of them.
constexpr std::size_t kFunctions = (kDegrees + 1) * (kDegrees + 2) / 2;
using Coefficients = std::vector<double>;
using Parameters = std::vector<double>;  // angles from the normal, then logarithms of variances

// The most lobes that are fitted: further ones would only cancel one another.
constexpr std::size_t kMostLobes = 6;
// Penalties: for the squares of weights, which keeps them small, and for changes from the
// neighbouring view's angles and logarithms.
constexpr double kWeightCost = 1e-4;
constexpr double kChangeCost = 1e-4;
// Bounds of the variances: the least is what the degrees can show, the largest is the second widest
// level.
constexpr double kLeastVariance = 0.01;
constexpr double kGreatestVariance = 1.0;
// Bounds of the angles: half-vectors need the mean on one side of the view and above the horizon.
constexpr double kGreatestTurn = 176.0 * kPi / 180.0;
constexpr double kGreatestSum = 150.0 * kPi / 180.0;
constexpr int kFirstSteps = 60;
constexpr int kSteps = 30;
constexpr int kStarts = 4;

// The factor of the coefficients of degree l.
double degree_weight(int degree) { return 1.0 / (degree + 0.5); }

// The real spherical harmonics that are even in y, times degree_weight(), at a unit vector.
Coefficients harmonics(const glm::dvec3& d) {
  const double c = d.z;
  const double s = std::hypot(d.x, d.y);
  const double azimuth = std::atan2(d.y, d.x);
  Coefficients values(kFunctions);
  const auto at = [](int l, int m) { return static_cast<std::size_t>(l * (l + 1) / 2 + m); };
  double diagonal = std::sqrt(0.25 / kPi);
  for (int m = 0; m <= kDegrees; ++m) {
    if (m > 0) diagonal *= s * std::sqrt((2.0 * m + 1.0) / (2.0 * m));
    double before = 0.0, value = diagonal;
    for (int l = m; l <= kDegrees; ++l) {
      if (l > m) {
        const double a = std::sqrt((4.0 * l * l - 1.0) / (l * l - m * m));
        const double b =
            std::sqrt(((l - 1.0) * (l - 1.0) - m * m) / (4.0 * (l - 1.0) * (l - 1.0) - 1.0));
        const double next = a * (c * value - b * before);
        before = value;
        value = next;
      }
      values[at(l, m)] =
          degree_weight(l) * value * (m > 0 ? std::sqrt(2.0) * std::cos(m * azimuth) : 1.0);
    }
  }
  return values;
}

Coefficients slice_harmonics(const Slice& slice) {
  Coefficients sum(kFunctions, 0.0);
  for (std::size_t n = 0; n < slice.directions.size(); ++n) {
    const Coefficients values = harmonics(slice.directions[n]);
    for (std::size_t k = 0; k < kFunctions; ++k) sum[k] += slice.weights[n] * values[k];
  }
  for (double& value : sum) value /= slice.albedo;
  return sum;
}

// A lobe of weight 1 as it is drawn.
Coefficients lobe_harmonics(const glm::dvec3& mean, double variance) {
  Coefficients values = harmonics(mean);
  const DrawnHarmonics drawn = drawn_harmonics(variance);
  std::size_t k = 0;
  for (int l = 0; l <= kDegrees; ++l) {
    for (int m = 0; m <= l; ++m, ++k) values[k] *= drawn[static_cast<std::size_t>(l)];
  }
  return values;
}

double squared_error(const Coefficients& wanted, const Mixture& lobes, double albedo) {
  Coefficients rest = wanted;
  for (const Lobe& lobe : lobes) {
    const double kappa = std::max(lobe.gaussian.kappa, 1.0 / kGreatestVariance);
    const Coefficients values = lobe_harmonics(lobe.gaussian.mean, 1.0 / kappa);
    for (std::size_t k = 0; k < kFunctions; ++k) rest[k] -= lobe.weight / albedo * values[k];
  }
  double sum = 0.0;
  for (const double value : rest) sum += value * value;
  return sum;
}

// Solves the symmetric positive definite a x = b, a row by row; b becomes x.
void solve(std::vector<double> a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      double sum = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / a[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

// The lobes of one view as a function of their angles and variances; the weights follow by linear
// least squares.
class WideView {
 public:
  WideView(Coefficients wanted, double elevation, Parameters before)
      : wanted_(std::move(wanted)), elevation_(elevation), before_(std::move(before)) {}

  // Brings parameters to where lobes can be stored.
  void bound(Parameters& x) const {
    const std::size_t lobes = x.size() / 2;
    const double least = std::max(elevation_ - kGreatestTurn, -kGreatestSum - elevation_);
    for (std::size_t k = 0; k < lobes; ++k) {
      x[k] = std::clamp(x[k], least, std::max(least, kGreatestSum - elevation_));
      x[lobes + k] =
          std::clamp(x[lobes + k], std::log(kLeastVariance), std::log(kGreatestVariance));
    }
  }

  // The residuals: of the slice, then the penalties. Also gives the weights.
  std::vector<double> residuals(const Parameters& x, std::vector<double>& weights) const {
    const std::size_t lobes = x.size() / 2;
    std::vector<Coefficients> columns;
    for (std::size_t k = 0; k < lobes; ++k) {
      columns.push_back(
          lobe_harmonics({std::sin(x[k]), 0.0, std::cos(x[k])}, std::exp(x[lobes + k])));
    }
    std::vector<double> normal(lobes * lobes);
    weights.assign(lobes, 0.0);
    for (std::size_t i = 0; i < lobes; ++i) {
      for (std::size_t f = 0; f < kFunctions; ++f) weights[i] += columns[i][f] * wanted_[f];
      for (std::size_t j = 0; j < lobes; ++j) {
        double sum = i == j ? kWeightCost : 0.0;
        for (std::size_t f = 0; f < kFunctions; ++f) sum += columns[i][f] * columns[j][f];
        normal[i * lobes + j] = sum;
      }
    }
    solve(std::move(normal), weights);
    std::vector<double> rest = wanted_;
    for (std::size_t k = 0; k < lobes; ++k) {
      for (std::size_t f = 0; f < kFunctions; ++f) rest[f] -= weights[k] * columns[k][f];
    }
    for (const double weight : weights) rest.push_back(std::sqrt(kWeightCost) * weight);
    for (std::size_t n = 0; n < before_.size(); ++n) {
      rest.push_back(std::sqrt(kChangeCost) * (x[n] - before_[n]));
    }
    return rest;
  }

  // Levenberg and Marquardt's steps from x on; the sum of squares.
  double improve(Parameters& x, int steps, const Progress& progress) const {
    constexpr double kDifference = 1e-4;
    bound(x);
    std::vector<double> weights;
    std::vector<double> rest = residuals(x, weights);
    double error = squares(rest);
    double damping = 1e-3;
    const std::size_t n = x.size();
    for (int step = 0; step < steps; ++step) {
      progress.throw_if_cancelled();
      std::vector<std::vector<double>> slopes;
      for (std::size_t i = 0; i < n; ++i) {
        Parameters moved = x;
        moved[i] += kDifference;
        slopes.push_back(residuals(moved, weights));
        for (std::size_t r = 0; r < rest.size(); ++r) {
          slopes[i][r] = (slopes[i][r] - rest[r]) / kDifference;
        }
      }
      std::vector<double> gradient(n, 0.0), hessian(n * n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t r = 0; r < rest.size(); ++r) gradient[i] -= slopes[i][r] * rest[r];
        for (std::size_t j = 0; j < n; ++j) {
          for (std::size_t r = 0; r < rest.size(); ++r) {
            hessian[i * n + j] += slopes[i][r] * slopes[j][r];
          }
        }
      }
      bool is_better = false;
      for (int attempt = 0; attempt < 8 && !is_better; ++attempt) {
        std::vector<double> damped = hessian, change = gradient;
        for (std::size_t i = 0; i < n; ++i) {
          damped[i * n + i] += damping * (hessian[i * n + i] + 1e-6);
        }
        solve(std::move(damped), change);
        Parameters next = x;
        for (std::size_t i = 0; i < n; ++i) next[i] += std::clamp(change[i], -0.5, 0.5);
        bound(next);
        std::vector<double> next_rest = residuals(next, weights);
        const double next_error = squares(next_rest);
        is_better = next_error < error;
        damping *= is_better ? 0.3 : 4.0;
        if (is_better) {
          const bool is_done = next_error > (1.0 - 1e-5) * error;
          x = std::move(next);
          rest = std::move(next_rest);
          error = next_error;
          if (is_done) return error;
        }
      }
      if (!is_better) break;
    }
    return error;
  }

  static double squares(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value * value;
    return sum;
  }

 private:
  Coefficients wanted_;
  double elevation_;
  Parameters before_;  // empty for the first view
};

struct WideSlice {
  Coefficients wanted;
  double albedo = 0.0;
};

WideSlice wide_slice(const Brdf& brdf, const SliceNodes& nodes, const glm::dvec3& o) {
  const Slice slice = usable_nodes(sample_slice(brdf, o, nodes.per_axis, nodes.rotation));
  WideSlice result;
  result.albedo = slice.albedo;
  if (slice.albedo > 0.0) result.wanted = slice_harmonics(slice);
  return result;
}

// Fills up to the number of lobes that the table has: the added lobes have weight 0 and lie on the
// last one.
Mixture stored_lobes(const Parameters& x, const std::vector<double>& weights, double albedo,
                     int count) {
  const std::size_t lobes = weights.size();
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  Mixture mixture;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const std::size_t from = std::min(k, lobes - 1);
    mixture.push_back({k < lobes ? weights[k] / sum * albedo : 0.0,
                       {{std::sin(x[from]), 0.0, std::cos(x[from])}, std::exp(-x[lobes + from])}});
  }
  return mixture;
}

// The error of a table at its views and between them.
double table_error(const Brdf& brdf, const SliceNodes& nodes, const LobeTable& table,
                   const Progress& progress) {
  double sum = 0.0;
  for (int n = 0; n < 2 * table.views().x - 1; ++n) {
    progress.throw_if_cancelled();
    const double elevation = table.elevation(0.5 * n);
    const glm::dvec3 o(std::sin(elevation), 0.0, std::cos(elevation));
    const WideSlice slice = wide_slice(brdf, nodes, o);
    if (slice.albedo > 0.0) {
      sum += std::sin(2.0 * elevation) *
             squared_error(slice.wanted, table.interpolate(o), slice.albedo);
    }
  }
  return sum;
}

}  // namespace

bool is_wide(const Brdf& brdf, const LobeTable& table) {
  return table.is_isotropic() && !brdf.is_coloured() && table.lobes() > 2 &&
         std::min(brdf.alpha().x, brdf.alpha().y) >= kLeastWideWidth;
}

bool fit_wide_lobes(const Brdf& brdf, const SliceNodes& nodes, LobeTable& table,
                    Progress& progress) {
  const int views = table.views().x;
  const int steps = kStarts + views;
  int done = 0;
  // The two errors at the end take little time.
  const auto step = [&] { progress.set(static_cast<double>(++done) / (steps + 1)); };
  std::vector<WideSlice> slices;
  for (int t = 0; t < views; ++t) {
    slices.push_back(wide_slice(brdf, nodes, table.view(t, 0)));
    if (!(slices.back().albedo > 0.0)) return false;
    progress.throw_if_cancelled();
  }
  const std::size_t lobes = std::min(static_cast<std::size_t>(table.lobes()), kMostLobes);
  LobeTable result = table;
  const auto store = [&](int t, const Parameters& x) {
    const auto& slice = slices[static_cast<std::size_t>(t)];
    std::vector<double> weights;
    WideView(slice.wanted, table.elevation(t), {}).residuals(x, weights);
    result.set_mixture_at_view(t, 0, stored_lobes(x, weights, slice.albedo, table.lobes()));
  };

  // The first view has a highlight that is neither round nor cut off by much.
  const int first = 3 * views / 8;
  const WideView start(slices[static_cast<std::size_t>(first)].wanted, table.elevation(first), {});
  Parameters best;
  double least = 0.0;
  for (int n = 0; n < kStarts; ++n) {
    Parameters x(2 * lobes);
    for (std::size_t k = 0; k < lobes; ++k) {
      const double way = static_cast<double>(k) / static_cast<double>(lobes - 1);
      // Numbers from -1/2 to 1/2 that are spread evenly, 0 at first.
      const auto spread = [&](double step) {
        const double place = n * step * (static_cast<double>(k) + 1.0);
        return n == 0 ? 0.0 : place - std::floor(place) - 0.5;
      };
      x[k] = (165.0 * way - 95.0) * kPi / 180.0 + 0.6 * spread(0.618034);
      x[lobes + k] = std::log(std::clamp(0.5 * brdf.alpha().x, 0.03, 0.4)) + 1.4 * spread(0.754878);
    }
    const double error = start.improve(x, kFirstSteps, progress);
    step();
    if (n == 0 || error < least) {
      least = error;
      best = std::move(x);
    }
  }
  store(first, best);
  for (const int way : {1, -1}) {
    Parameters x = best;
    for (int t = first + way; t >= 0 && t < views; t += way) {
      const double turn = table.elevation(t) - table.elevation(t - way);
      for (std::size_t k = 0; k < lobes; ++k) x[k] -= 0.5 * turn;
      const WideView view(slices[static_cast<std::size_t>(t)].wanted, table.elevation(t), x);
      view.improve(x, kSteps, progress);
      step();
      store(t, x);
    }
  }
  const double error = table_error(brdf, nodes, result, progress);
  const bool better = error < table_error(brdf, nodes, table, progress);
  progress.set(1.0);
  if (!better) return false;
  table = std::move(result);
  return true;
}

}  // namespace lobelight
