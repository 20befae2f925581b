#include "fit/view_error.h"

#include <atomic>

#include "base/parallel.h"
#include "fit/slice.h"

namespace lobelight {

namespace {

// Other nodes than the 64² that mixtures are fitted to.
constexpr int kNodesPerAxis = 48;
constexpr double kRotation = 0.5;

}  // namespace

double l1_error(const Brdf& brdf, const glm::dvec3& o, const Mixture& mixture) {
  const Slice slice = sample_slice(brdf, o, kNodesPerAxis, kRotation);
  const double weight = total_weight(mixture);
  if (weight == 0.0) return slice.albedo > 0.0 ? 2.0 : 0.0;
  if (slice.albedo == 0.0) return 0.0 * weight;
  const double scale = slice.albedo / weight;
  double sum = 0.0;
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    const glm::dvec3& i = slice.directions[n];
    const double value = brdf.evaluate(i, o) * i.z;
    // Far from the lobe of an extreme material the value underflows to 0.
    if (!(value > 0.0)) continue;
    const double missing = 1.0 - scale * evaluate(mixture, i) / value;
    // Written so that NaN counts.
    if (!(missing <= 0.0)) sum += slice.weights[n] * missing;
  }
  return 2.0 * sum / slice.albedo;
}

std::vector<double> view_errors(const LobeTable& table, const Brdf& brdf, int threads,
                                Progress& progress) {
  const int elevations = table.views().x;
  std::vector<double> errors(static_cast<std::size_t>(elevations * table.views().y));
  std::atomic<int> finished{0};
  parallel_for(errors.size(), threads, progress, [&](std::size_t n) {
    const int t = static_cast<int>(n) % elevations;
    const int p = static_cast<int>(n) / elevations;
    errors[n] = l1_error(brdf, table.view(t, p), table.mixture_at_view(t, p));
    progress.set(static_cast<double>(++finished) / static_cast<double>(errors.size()));
  });
  return errors;
}

}  // namespace lobelight
