// The fitter for Python's ctypes, so that ./dev bench times it in one process with its rivals, on
// the same arrays and by the same clock. Arrays are C-ordered doubles; a lobe is five of them:
// weight, mean x, y, z, kappa. Every function returns a count ≥ 0, or −1 after bad input, of which
// lobelight_last_error() then tells.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "fit/em.h"
#include "fit/initial_guess.h"

#if defined(_WIN32)
#define LOBELIGHT_BENCH_EXPORT extern "C" __declspec(dllexport)
#else
#define LOBELIGHT_BENCH_EXPORT extern "C" __attribute__((visibility("default")))
#endif

namespace {

using namespace lobelight;

constexpr int kLobeSize = 5;
std::string last_error;

template <typename Work>
int guarded(const Work& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    last_error = error.what();
    return -1;
  }
}

Slice make_slice(int count, const double* directions, const double* weights) {
  Slice slice;
  slice.directions.resize(static_cast<std::size_t>(count));
  slice.weights.assign(weights, weights + count);
  for (std::size_t n = 0; n < slice.directions.size(); ++n) {
    slice.directions[n] = {directions[3 * n], directions[3 * n + 1], directions[3 * n + 2]};
    slice.albedo += slice.weights[n];
  }
  return slice;
}

Mixture read_lobes(int lobes, const double* values) {
  Mixture mixture(static_cast<std::size_t>(lobes));
  for (Lobe& lobe : mixture) {
    lobe = {values[0], {{values[1], values[2], values[3]}, values[4]}};
    values += kLobeSize;
  }
  return mixture;
}

void write_lobes(const Mixture& mixture, double* values) {
  for (const Lobe& lobe : mixture) {
    const glm::dvec3& mean = lobe.gaussian.mean;
    for (const double value : {lobe.weight, mean.x, mean.y, mean.z, lobe.gaussian.kappa}) {
      *values++ = value;
    }
  }
}

}  // namespace

LOBELIGHT_BENCH_EXPORT const char* lobelight_last_error() { return last_error.c_str(); }

// sample_slice(): writes at most `capacity` nodes, directions (capacity, 3) and weights (capacity);
// returns how many there are.
LOBELIGHT_BENCH_EXPORT int lobelight_sample_slice(const char* brdf, const double* alpha,
                                                  const double* view, int nodes_per_axis,
                                                  int capacity, double* directions,
                                                  double* weights) {
  return guarded([&] {
    const auto model = make_brdf(brdf, {alpha[0], alpha[1]});
    const Slice slice = sample_slice(*model, {view[0], view[1], view[2]}, nodes_per_axis);
    const std::size_t count = slice.weights.size();
    if (count > static_cast<std::size_t>(capacity)) {
      throw std::invalid_argument("There are more nodes than the arrays hold.");
    }
    std::copy(slice.weights.begin(), slice.weights.end(), weights);
    for (std::size_t n = 0; n < count; ++n) {
      for (int axis = 0; axis < 3; ++axis) *directions++ = slice.directions[n][axis];
    }
    return static_cast<int>(count);
  });
}

// ρ(i, o) i_z for `count` directions i.
LOBELIGHT_BENCH_EXPORT int lobelight_evaluate(const char* brdf, const double* alpha,
                                              const double* view, int count,
                                              const double* directions, double* values) {
  return guarded([&] {
    const auto model = make_brdf(brdf, {alpha[0], alpha[1]});
    const glm::dvec3 o(view[0], view[1], view[2]);
    for (int n = 0; n < count; ++n) {
      const glm::dvec3 i(directions[3 * n], directions[3 * n + 1], directions[3 * n + 2]);
      values[n] = model->evaluate(i, o) * std::max(0.0, i.z);
    }
    return count;
  });
}

// initial_guess(): `out` (lobes, 5).
LOBELIGHT_BENCH_EXPORT int lobelight_initial_guess(int count, const double* directions,
                                                   const double* weights, int lobes, double* out) {
  return guarded([&] {
    write_lobes(initial_guess(make_slice(count, directions, weights), lobes), out);
    return lobes;
  });
}

// run_em() from `start` (lobes, 5) to `out` (lobes, 5); returns the iterations.
LOBELIGHT_BENCH_EXPORT int lobelight_run_em(int count, const double* directions,
                                            const double* weights, int lobes, const double* start,
                                            int max_iterations, double tolerance, int accelerate,
                                            double* out) {
  return guarded([&] {
    EmOptions options;
    options.max_iterations = max_iterations;
    options.tolerance = tolerance;
    options.accelerate = accelerate != 0;
    const EmResult result =
        run_em(make_slice(count, directions, weights), read_lobes(lobes, start), options);
    write_lobes(result.mixture, out);
    return result.iterations;
  });
}
