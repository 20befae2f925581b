// Slices of extreme materials and what EM makes of them; and single steps of EM, small enough to be
// repeated with 50 digits.

#include <algorithm>
#include <cmath>

#include "brdf/brdf.h"
#include "fit/em.h"
#include "fit/initial_guess.h"
#include "fit/slice.h"
#include "fit/view_error.h"
#include "stability.h"
#include "stability_em.h"
#include "stability_materials.h"

namespace lobelight::stability {

namespace {

void fit_slice(Record& record, const Material& material, const View& view, int lobes, int nodes) {
  describe(record, material, view);
  const auto brdf = make_brdf(material.brdf, material.alpha);
  const glm::dvec3 o = view.direction();
  const Slice slice = sample_slice(*brdf, o, nodes);
  const auto [least, most] = std::minmax_element(slice.weights.begin(), slice.weights.end());
  record.set("lobes", lobes)
      .set("nodes_per_axis", nodes)
      .set("nodes", static_cast<int>(slice.weights.size()))
      .set("albedo", slice.albedo);
  if (!slice.weights.empty()) record.set("least_node", *least).set("largest_node", *most);
  const EmResult result = run_em(slice, initial_guess(slice, lobes));
  describe(record, result);
  record.set("fit_error", l1_error(*brdf, o, result.mixture));
}

void one_step(Record& record, const Material& material, const View& view, int lobes) {
  describe(record, material, view);
  const Slice slice = sample_slice(*make_brdf(material.brdf, material.alpha), view.direction(), 16);
  const Mixture start = initial_guess(slice, lobes);
  EmOptions options;
  options.max_iterations = 1;
  options.accelerate = false;
  const EmResult result = run_em(slice, start, options);
  record.set("slice", slice).set("albedo", slice.albedo).set("start", start);
  describe(record, result);
  record.set("weight_floor", options.weight_floor)
      .set("kappa_max", options.kappa_max)
      .set("log_likelihood", result.log_likelihood);
}

}  // namespace

void describe(Record& record, const EmResult& result) {
  double fall = 0.0;
  bool finite = true;
  for (std::size_t n = 0; n < result.log_likelihood.size(); ++n) {
    const double now = result.log_likelihood[n];
    finite = finite && std::isfinite(now);
    if (n == 0) continue;
    const double before = result.log_likelihood[n - 1];
    fall = std::max(fall, (before - now) / std::max(1.0, std::abs(before)));
  }
  record.set("mixture", result.mixture)
      .set("iterations", result.iterations)
      .set("iteration_limit", EmOptions().max_iterations)
      .set("converged", result.converged)
      .set("log_likelihood_finite", finite)
      .set("largest_fall", fall);
}

std::vector<Case> step_cases(bool quick) {
  std::vector<Case> cases;
  for (const Material& material : materials(quick ? 0 : 1)) {
    for (const View& view : views(material, 0)) {
      cases.push_back({"step " + title(material, view),
                       [=](Record& record) { one_step(record, material, view, 8); }});
    }
  }
  return cases;
}

std::vector<Case> slice_cases(bool quick) {
  std::vector<Case> cases;
  const auto add = [&](const Material& material, const View& view, int lobes, int nodes) {
    cases.push_back({"slice " + title(material, view) + " lobes " + std::to_string(lobes) +
                         " nodes " + std::to_string(nodes * nodes),
                     [=](Record& record) { fit_slice(record, material, view, lobes, nodes); }});
  };
  for (const Material& material : materials(quick ? 1 : 2)) {
    const bool isotropic = material.alpha.x == material.alpha.y;
    for (const View& view : views(material, quick ? 0 : isotropic ? 2 : 1)) {
      add(material, view, 8, 64);
    }
  }
  for (const Material& material : materials(quick ? 0 : 1)) {
    for (const View& view : views(material, 0)) {
      if (quick && view.elevation == 60.0) continue;
      for (const int lobes : {1, 2, 3, 5, 16, 32}) {
        if (quick && lobes != 1 && lobes != 32) continue;
        add(material, view, lobes, quick ? 32 : 64);
      }
      // More lobes than samples.
      add(material, view, 32, 4);
    }
  }
  return cases;
}

}  // namespace lobelight::stability
