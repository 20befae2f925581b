#include "reference/integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "reference/environment_distribution.h"

namespace lobelight {
namespace {

// Independent scrambles of one point set: their spread is the standard error. More of them give a
// steadier error estimate, fewer a better stratified whole.
constexpr std::size_t kBatches = 4;

// Samples after which it is time to ask whether to go on.
constexpr std::size_t kBetweenChecks = 1024;

std::size_t points_per_batch(int samples) {
  std::size_t points = 4;
  while (points * kBatches < static_cast<std::size_t>(std::max(samples, 1))) points *= 2;
  return points;
}

glm::dvec3 to_world(const glm::dvec3& local, const SurfaceFrame& frame) {
  return local.x * frame.tangent + local.y * frame.bitangent + local.z * frame.normal;
}

glm::dvec3 to_local(const glm::dvec3& world, const SurfaceFrame& frame) {
  return {glm::dot(world, frame.tangent), glm::dot(world, frame.bitangent),
          glm::dot(world, frame.normal)};
}

// The channels' reflectances over their mean, which is what sampling goes by.
glm::dvec3 tint(const Brdf& brdf, const glm::dvec3& i, const glm::dvec3& o) {
  if (!brdf.is_coloured()) return glm::dvec3(1.0);
  const glm::dvec3 rgb = brdf.evaluate_rgb(i, o);
  const double mean = (rgb.x + rgb.y + rgb.z) / 3.0;
  return mean > 0.0 ? rgb / mean : glm::dvec3(1.0);
}

}  // namespace

Integrator::Integrator(std::shared_ptr<const IncomingLight> light, const Brdf& brdf, int samples,
                       const Progress* progress)
    : brdf_(brdf), light_(std::move(light)), points_(points_per_batch(samples), progress) {}

Integrator::Integrator(const Panorama& panorama, const Brdf& brdf, int samples,
                       const Progress* progress)
    : Integrator(std::make_shared<const EnvironmentDistribution>(panorama, progress), brdf, samples,
                 progress) {}

ClusterChoice Integrator::choose_clusters(const glm::dvec3& o, const SurfaceFrame& frame) const {
  return light_->choose(frame.point, [&](const glm::dvec3& direction) {
    const glm::dvec3 i = to_local(direction, frame);
    return i.z > 0.0 ? brdf_.evaluate(i, o) * i.z : 0.0;
  });
}

// Multiple importance sampling with the balance heuristic (Veach 1997, "Robust Monte Carlo methods
// for light transport simulation", eq. 9.8). With as many samples of either kind, each one counts
//   f(i) / (p_brdf(i) + p_light(i)),  f(i) = L(i) ρ(i, o) i_z.
glm::dvec3 Integrator::batch(const glm::dvec3& o, const SurfaceFrame& frame,
                             const ClusterChoice& choice, std::uint64_t seed,
                             const Progress* progress) const {
  const std::uint64_t brdf_seed = mix_bits(seed);
  const std::uint64_t light_seed = mix_bits(~seed);
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (k % kBetweenChecks == 0) throw_if_cancelled(progress);
    const auto drawn = brdf_.sample(o, points_.scrambled(k, brdf_seed));
    if (!drawn) continue;
    const EnvironmentSample light =
        light_->at(choice, frame.point, to_world(drawn->direction, frame));
    sum += light.radiance * tint(brdf_, drawn->direction, o) *
           (drawn->weight / (1.0 + light.pdf / drawn->pdf));
  }
  for (std::size_t k = 0; k < points_.size() && !choice.empty(); ++k) {
    if (k % kBetweenChecks == 0) throw_if_cancelled(progress);
    const EnvironmentSample light =
        light_->sample(choice, frame.point, points_.scrambled(k, light_seed));
    const glm::dvec3 i = to_local(light.direction, frame);
    if (!(i.z > 0.0) || !(light.pdf > 0.0)) continue;
    const double reflected = brdf_.evaluate(i, o) * i.z;
    if (!(reflected > 0.0)) continue;
    sum += light.radiance * tint(brdf_, i, o) * (reflected / (brdf_.pdf(i, o) + light.pdf));
  }
  return sum / static_cast<double>(points_.size());
}

RadianceEstimate Integrator::integrate(const glm::dvec3& view, const SurfaceFrame& frame,
                                       std::uint64_t seed, const Progress* progress) const {
  const glm::dvec3 o = to_local(view, frame);
  if (!(o.z > 0.0)) return {glm::dvec3(0.0), glm::dvec3(0.0)};
  const ClusterChoice choice = choose_clusters(o, frame);
  std::array<glm::dvec3, kBatches> batches;
  glm::dvec3 mean(0.0);
  for (std::size_t b = 0; b < kBatches; ++b) {
    batches[b] = batch(o, frame, choice, mix_bits(seed) + b, progress);
    mean += batches[b] / static_cast<double>(kBatches);
  }
  glm::dvec3 squares(0.0);
  for (const glm::dvec3& value : batches) squares += (value - mean) * (value - mean);
  return {mean, glm::sqrt(squares / static_cast<double>(kBatches * (kBatches - 1)))};
}

}  // namespace lobelight
