// Whole tables at the extremes, and what storing them as half floats or bytes and decoding them in
// single precision makes of their lobes.

#include <algorithm>
#include <cmath>

#include "fit/table_fitter.h"
#include "stability.h"
#include "stability_byte_table.h"
#include "stability_materials.h"
#include "stability_shader.h"

namespace lobelight::stability {

namespace {

// Five numbers a lobe: weight, mean, kappa; lobes of all views, view by view, elevations first.
template <typename Texel>
std::vector<double> decode_all(const LobeTable& table, Texel texel) {
  std::vector<double> values;
  for (int p = 0; p < table.views().y; ++p) {
    for (int t = 0; t < table.views().x; ++t) {
      const glm::vec3 o = shader_clamp_view(glm::vec3(table.view(t, p)));
      for (int k = 0; k < table.lobes(); ++k) {
        const ShaderLobe lobe = shader_decode_lobe(texel(k, t, p), glm::vec2(table.alpha()), o);
        values.insert(values.end(),
                      {lobe.weight, lobe.mean.x, lobe.mean.y, lobe.mean.z, 1.0 / lobe.variance});
      }
    }
  }
  return values;
}

auto texels_of(const LobeTable& table) {
  return [&table](int k, int t, int p) { return glm::vec4(table.entry(k, t, p)); };
}

// Any direction of the view, not only the grid's: all quadrants, in the planes of symmetry, beyond
// the last elevation and below the horizon. For every direction the view itself, then the lobes by
// LobeTable::interpolate() and by the shader's formulas, five numbers each.
void look_up(Record& record, const LobeTable& table) {
  std::vector<double> directions;
  std::vector<double> wanted;
  std::vector<double> found;
  for (const double elevation : {0.0, 1e-2, 10.0, 47.0, 80.0, 89.3, 89.7, 90.0, 100.0}) {
    for (const double azimuth : {0.0, 35.0, 90.0, 160.0, 250.0, 359.999}) {
      const glm::dvec3 o = view_at(elevation, azimuth);
      directions.insert(directions.end(), {o.x, o.y, o.z});
      const Mixture mixture = table.interpolate(o);
      for (int k = 0; k < table.lobes(); ++k) {
        const Lobe& own = mixture[static_cast<std::size_t>(k)];
        const glm::dvec3& mean = own.gaussian.mean;
        wanted.insert(wanted.end(), {own.weight, mean.x, mean.y, mean.z, own.gaussian.kappa});
        const ShaderLobe lobe = shader_lobe_at(table, glm::vec3(o), k, texels_of(table));
        found.insert(found.end(),
                     {lobe.weight, lobe.mean.x, lobe.mean.y, lobe.mean.z, 1.0 / lobe.variance});
      }
    }
  }
  record.set("directions", directions).set("interpolated", wanted).set("looked_up", found);
}

void fit(Record& record, const Recipe& recipe, const FitOptions& options) {
  Progress progress;
  FitReport report;
  const LobeTable table = fit_table(recipe, progress, &report, options);

  std::vector<double> views;
  std::vector<double> entries;
  for (int p = 0; p < table.views().y; ++p) {
    for (int t = 0; t < table.views().x; ++t) {
      const glm::dvec3 o = table.view(t, p);
      views.insert(views.end(), {o.x, o.y, o.z});
      for (int k = 0; k < table.lobes(); ++k) {
        const LobeTable::Entry& e = table.entry(k, t, p);
        entries.insert(entries.end(), {e.x, e.y, e.z, e.w});
      }
    }
  }
  const LobeTable half =
      LobeTable::from_rgba16f(table.alpha(), table.lobes(), table.views(), table.to_rgba16f());
  const ByteTable bytes(table);
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
      .set("entries", entries)
      .set("float", decode_all(table, texels_of(table)))
      .set("half", decode_all(half, texels_of(half)))
      .set("byte", decode_all(table, [&](int k, int t, int p) { return bytes.texel(k, t, p); }));
  look_up(record, table);
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
