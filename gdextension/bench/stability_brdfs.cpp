// Reflectances point by point: values, densities and sampled directions at extreme widths, ratios
// and views.

#include <cmath>

#include "brdf/brdf.h"
#include "stability.h"
#include "stability_materials.h"

namespace lobelight::stability {

namespace {

// For each u: u, weight and pdf of the sample, its direction, then the library's value and density
// at that very direction. Nine numbers; u and seven NaN where the sample falls below the horizon.
void evaluate_samples(Record& record, const Material& material, const glm::dvec3& o) {
  const auto brdf = make_brdf(material.brdf, material.alpha);
  std::vector<double> values;
  for (const double distance : {1e-6, 0.1, 0.4, 0.75, 0.97, 0.9999}) {
    for (const double turn : {0.03, 0.26, 0.55, 0.81}) {
      const auto sample = brdf->sample(o, {distance, turn});
      values.insert(values.end(), {distance, turn});
      if (!sample) {
        values.insert(values.end(), 7, std::nan(""));
        continue;
      }
      const glm::dvec3& i = sample->direction;
      values.insert(values.end(), {sample->weight, sample->pdf, i.x, i.y, i.z, brdf->evaluate(i, o),
                                   brdf->pdf(i, o)});
    }
  }
  record.set("values", values);
}

}  // namespace

std::vector<Case> brdf_cases(bool quick) {
  std::vector<Case> cases;
  for (const Material& material : materials(quick ? 1 : 2)) {
    for (const View& view : views(material, quick ? 0 : 1)) {
      cases.push_back({"brdf " + title(material, view), [=](Record& record) {
                         describe(record, material, view);
                         evaluate_samples(record, material, view.direction());
                       }});
    }
  }
  return cases;
}

}  // namespace lobelight::stability
