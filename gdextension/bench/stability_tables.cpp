// Whole tables at the extremes, what storing them as half floats makes of their entries, and the
// lobes of any view.

#include <algorithm>

#include "fit/table_fitter.h"
#include "stability.h"
#include "stability_materials.h"

namespace lobelight::stability {

namespace {

// Four numbers a lobe; lobes of all views, view by view, elevations first.
std::vector<double> entries_of(const LobeTable& table) {
  std::vector<double> values;
  for (int p = 0; p < table.views().y; ++p) {
    for (int t = 0; t < table.views().x; ++t) {
      for (int k = 0; k < table.lobes(); ++k) {
        const LobeTable::Entry& e = table.entry(k, t, p);
        values.insert(values.end(), {e.x, e.y, e.z, e.w});
      }
    }
  }
  return values;
}

// Any direction of the view, not only the grid's: all quadrants, in the planes of symmetry, beyond
// the last elevation and below the horizon. For every direction the view itself, then the lobes,
// five numbers each: weight, mean, kappa.
void interpolate(Record& record, const LobeTable& table) {
  std::vector<double> directions;
  std::vector<double> lobes;
  for (const double elevation : {0.0, 1e-2, 10.0, 47.0, 80.0, 89.3, 89.7, 90.0, 100.0}) {
    for (const double azimuth : {0.0, 35.0, 90.0, 160.0, 250.0, 359.999}) {
      const glm::dvec3 o = view_at(elevation, azimuth);
      directions.insert(directions.end(), {o.x, o.y, o.z});
      for (const Lobe& lobe : table.interpolate(o)) {
        const glm::dvec3& mean = lobe.gaussian.mean;
        lobes.insert(lobes.end(), {lobe.weight, mean.x, mean.y, mean.z, lobe.gaussian.kappa});
      }
    }
  }
  record.set("directions", directions).set("interpolated", lobes);
}

void fit(Record& record, const Recipe& recipe, const FitOptions& options) {
  Progress progress;
  FitReport report;
  const LobeTable table = fit_table(recipe, progress, &report, options);

  std::vector<double> views;
  for (int p = 0; p < table.views().y; ++p) {
    for (int t = 0; t < table.views().x; ++t) {
      const glm::dvec3 o = table.view(t, p);
      views.insert(views.end(), {o.x, o.y, o.z});
    }
  }
  const LobeTable half =
      LobeTable::from_rgba16f(table.alpha(), table.lobes(), table.views(), table.to_rgba16f());
  record.set("brdf", std::string_view(recipe.brdf))
      .set("alpha", recipe.alpha)
      .set("lobes", recipe.lobes)
      .set("nodes_per_axis", options.nodes_per_axis)
      .set("method", to_string(recipe.method))
      .set("seconds", report.seconds)
      .set("iterations", *std::max_element(report.iterations.begin(), report.iterations.end()))
      .set("iteration_limit",
           options.em.max_iterations + options.smoothing_passes * kSmoothingIterations)
      .set("log_likelihood", report.log_likelihood)
      .set("kappa_max", options.em.kappa_max)
      .set("views", views)
      .set("grid", glm::dvec2(table.views()))
      .set("entries", entries_of(table))
      .set("half", entries_of(half));
  interpolate(record, table);
}

}  // namespace

std::vector<Case> table_cases(bool quick) {
  std::vector<Case> cases;
  const auto add = [&](const Material& material, int lobes, FitMethod method) {
    Recipe recipe;
    recipe.brdf = material.brdf;
    recipe.alpha = material.alpha;
    recipe.lobes = lobes;
    recipe.views = {7, material.alpha.x == material.alpha.y ? 1 : 4};
    recipe.method = method;
    recipe.threads = 1;
    FitOptions options;
    options.nodes_per_axis = quick ? 24 : 64;
    cases.push_back({"table " + title(material) + " lobes " + std::to_string(lobes) + ' ' +
                         std::string(to_string(method)),
                     [=](Record& record) { fit(record, recipe, options); }});
  };
  for (const Material& material : materials(0)) {
    for (const int lobes : {1, 32}) add(material, lobes, FitMethod::continuation);
  }
  for (const Material& material : materials(quick ? 0 : 1)) {
    for (const FitMethod method : {FitMethod::continuation, FitMethod::independent}) {
      add(material, 8, method);
    }
  }
  return cases;
}

}  // namespace lobelight::stability
