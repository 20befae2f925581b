#include "stability_materials.h"

#include "brdf/brdf.h"

namespace lobelight::stability {

namespace {

// (larger width, ratio): the smaller width is their quotient.
struct Shape {
  double width;
  double ratio;
};

std::vector<Shape> shapes(int density) {
  if (density == 0) return {{kMinAlpha, 1.0}, {0.1, 1000.0}, {kMaxAlpha, 1000.0}, {kMaxAlpha, 1.0}};
  std::vector<double> widths{1e-4, 1e-3, 0.01, 0.1, 0.2, 2.0};
  std::vector<double> ratios{1.0, 4.0, 20.0, 1000.0};
  if (density > 1) {
    widths = {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0};
    ratios = {1.0, 2.0, 4.0, 20.0, 100.0, 1000.0};
  }
  std::vector<Shape> list;
  for (const double width : widths) {
    for (const double ratio : ratios) {
      // 0.1/1000 is to count as kMinAlpha whatever the last bit.
      if (width / ratio > 0.999 * kMinAlpha) list.push_back({width, ratio});
    }
  }
  return list;
}

}  // namespace

std::vector<Material> materials(int density) {
  std::vector<Material> list;
  for (const std::string& brdf : brdf_names()) {
    // Sheen has one width, in a range where it is smooth.
    if (is_always_isotropic(brdf)) continue;
    bool along_y = true;
    for (const Shape& shape : shapes(density)) {
      const double narrow = std::max(shape.width / shape.ratio, kMinAlpha);
      // In turns, so that neither axis is always the narrow one.
      list.push_back(
          {brdf, along_y ? glm::dvec2(narrow, shape.width) : glm::dvec2(shape.width, narrow)});
      along_y = !along_y;
    }
  }
  return list;
}

std::vector<View> views(const Material& material, int density) {
  std::vector<double> elevations{0.0, 60.0, 89.4, 89.99};
  std::vector<double> azimuths{0.0, 30.0, 90.0};
  if (density == 1) elevations = {0.0, 30.0, 60.0, 80.0, 89.0, 89.4, 89.99};
  if (density == 2) {
    elevations = {0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 80.0, 85.0, 88.0, 89.0, 89.4, 89.9, 89.99};
  }
  if (density == 0) azimuths = {30.0};
  if (material.alpha.x == material.alpha.y) azimuths = {0.0};
  std::vector<View> list;
  for (const double elevation : elevations) {
    for (const double azimuth : azimuths) {
      list.push_back({elevation, azimuth});
      if (elevation == 0.0) break;
    }
  }
  return list;
}

std::string title(const Material& material) {
  return material.brdf + ' ' + short_number(material.alpha.x) + ',' +
         short_number(material.alpha.y);
}

std::string title(const Material& material, const View& view) {
  return title(material) + " view " + short_number(view.elevation) + ',' +
         short_number(view.azimuth);
}

void describe(Record& record, const Material& material, const View& view) {
  record.set("brdf", std::string_view(material.brdf))
      .set("alpha", material.alpha)
      .set("elevation", view.elevation)
      .set("azimuth", view.azimuth)
      .set("o", view.direction());
}

}  // namespace lobelight::stability
