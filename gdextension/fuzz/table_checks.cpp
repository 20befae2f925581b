#include "table_checks.h"

#include <cmath>
#include <glm/glm.hpp>

#include "checks.h"
#include "fit/slice.h"
#include "fit/wide_lobes.h"

namespace lobelight::fuzz {

namespace {

// Weights come from the nodes' by sums of a few thousand numbers.
constexpr double kEnergyTolerance = 1e-6;

bool is_number(std::uint16_t half) { return (half & 0x7c00U) != 0x7c00U; }

// What lobes that take away have at most in all, of what is left: a few times as much, with few
// nodes.
constexpr double kMostTaken = 16.0;

void check_view(const LobeTable& table, const Brdf& brdf, const Slice& slice, bool may_take_away,
                int t, int p) {
  double sum = 0.0;
  double magnitudes = 0.0;
  for (const Lobe& lobe : table.mixture_at_view(t, p)) {
    require(std::isfinite(lobe.weight) && (may_take_away || lobe.weight >= 0.0),
            "gives a lobe a weight that is none");
    require(std::isfinite(lobe.gaussian.kappa) && lobe.gaussian.kappa > 0.0,
            "gives a lobe a sharpness that is none");
    require(std::abs(glm::length(lobe.gaussian.mean) - 1.0) < 1e-6,
            "gives a lobe a mean that is no direction");
    sum += lobe.weight;
    magnitudes += std::abs(lobe.weight);
  }
  require(magnitudes <= kMostTaken * sum, "gives lobes that take too much away");
  require(std::abs(sum - slice.albedo) <= kEnergyTolerance * slice.albedo,
          "gives lobes other light than the slice's");
  if (!table.has_second_texels()) return;
  glm::dvec3 light(0.0);
  for (const glm::dvec3& weight : table.channel_weights_at_view(t, p)) {
    for (int channel = 0; channel < 3; ++channel) {
      require(std::isfinite(weight[channel]) && weight[channel] >= 0.0,
              "gives a lobe's channel a weight that is none");
    }
    light += weight;
  }
  require(std::abs((light.x + light.y + light.z) / 3.0 - sum) <= kEnergyTolerance * sum,
          "gives channels other light than their mean's");
  require(brdf.is_coloured(), "gives a grey material colours");
}

}  // namespace

FitOptions tiny_fit() {
  FitOptions options;
  options.nodes_per_axis = 16;
  options.em.max_iterations = 8;
  options.smoothing_passes = 1;
  options.refinement_iterations = 2;
  return options;
}

void accept_table(const LobeTable& table, const Brdf& brdf, const Recipe& recipe,
                  const FitOptions& options) {
  const bool may_take_away = recipe.placement == Placement::automatic &&
                             recipe.method == FitMethod::continuation && !recipe.refine &&
                             is_wide(brdf, table);
  for (int p = 0; p < table.views().y; ++p) {
    for (int t = 0; t < table.views().x; ++t) {
      const Slice slice =
          sample_slice(brdf, table.view(t, p), options.nodes_per_axis, seed_rotation(recipe.seed));
      check_view(table, brdf, slice, may_take_away, t, p);
    }
  }
  for (const std::uint16_t half : table.to_rgba16f()) {
    require(is_number(half), "gives a texture that holds what is no number");
  }
}

}  // namespace lobelight::fuzz
