// Time and memory of the fit, by Google Benchmark: sampling a slice, EM on one, a whole table;
// against lobes, views, nodes per axis and threads.

#include <benchmark/benchmark.h>

#include "allocated_bytes.h"
#include "fit/em.h"
#include "fit/initial_guess.h"
#include "fit/memory.h"

namespace {

using namespace lobelight;

constexpr glm::dvec2 kAlpha(0.05, 0.2);
const glm::dvec3 kView = glm::normalize(glm::dvec3(0.7, 0.3, 0.8));

void sample(benchmark::State& state) {
  const auto brdf = make_brdf("ward", kAlpha);
  for (auto _ : state) {
    benchmark::DoNotOptimize(sample_slice(*brdf, kView, static_cast<int>(state.range(0))));
  }
}
BENCHMARK(sample)->ArgNames({"nodes"})->Arg(32)->Arg(64)->Arg(128)->Unit(benchmark::kMicrosecond);

// Twenty iterations from the first guess; accelerated 1, or as in the textbook 0.
void em(benchmark::State& state) {
  const Slice slice =
      sample_slice(*make_brdf("ward", kAlpha), kView, static_cast<int>(state.range(1)));
  const Mixture start = initial_guess(slice, static_cast<int>(state.range(0)));
  EmOptions options;
  options.max_iterations = 20;
  options.tolerance = -1.0;
  options.accelerate = state.range(2) != 0;
  int iterations = 0;
  for (auto _ : state) {
    const EmResult result = run_em(slice, start, options);
    benchmark::DoNotOptimize(result.mixture.data());
    iterations = result.iterations;
  }
  state.counters["ns_per_node_lobe"] = benchmark::Counter(
      1e-9 * iterations * static_cast<double>(slice.weights.size() * start.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(em)
    ->ArgNames({"lobes", "nodes", "accelerated"})
    ->ArgsProduct({{4, 8, 16, 24}, {64}, {0, 1}})
    ->ArgsProduct({{8}, {32, 48, 96}, {1}})
    ->Unit(benchmark::kMicrosecond);

// A table as it is baked.
void table(benchmark::State& state) {
  Recipe recipe;
  recipe.alpha = kAlpha;
  recipe.lobes = static_cast<int>(state.range(0));
  recipe.views = {static_cast<int>(state.range(1)), static_cast<int>(state.range(2))};
  recipe.threads = static_cast<int>(state.range(4));
  FitOptions options;
  options.nodes_per_axis = static_cast<int>(state.range(3));
  std::size_t peak = 0;
  for (auto _ : state) {
    Progress progress;
    bench::reset_peak_bytes();
    const std::size_t before = bench::held_bytes();
    benchmark::DoNotOptimize(fit_table(recipe, progress, nullptr, options));
    peak = std::max(peak, bench::peak_bytes() - before);
  }
  state.counters["peak_bytes"] = static_cast<double>(peak);
  state.counters["bound_bytes"] = static_cast<double>(fit_memory_bound(recipe, options));
}
BENCHMARK(table)
    ->ArgNames({"lobes", "elevations", "azimuths", "nodes", "threads"})
    ->ArgsProduct({{4, 8, 16, 24}, {16}, {8}, {64}, {1, 2}})
    ->ArgsProduct({{8}, {8}, {4}, {64}, {1, 2}})
    ->ArgsProduct({{8}, {32}, {16}, {64}, {1, 2}})
    ->ArgsProduct({{8}, {16}, {8}, {32, 96}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
