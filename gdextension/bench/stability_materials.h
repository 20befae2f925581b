#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "stability.h"

namespace lobelight::stability {

struct Material {
  std::string brdf;
  glm::dvec2 alpha;
};

struct View {
  double elevation;  // degrees from the normal
  double azimuth;    // degrees from the tangent
  glm::dvec3 direction() const { return view_at(elevation, azimuth); }
};

// Every BRDF at widths from 1e-4 to 2 and ratios from 1:1 to 1:1000, along either axis. density 0:
// the corners of that range; 1: about a third of the grid; 2: the whole grid.
std::vector<Material> materials(int density);

// Elevations from 0° to 89.99° and azimuths over the quadrant: density 0: few, 1: more, 2: all.
// Isotropic materials have one azimuth.
std::vector<View> views(const Material& material, int density);

// "ward 0.01,0.2 view 60,30"
std::string title(const Material& material);
std::string title(const Material& material, const View& view);

// Puts brdf, alpha, elevation, azimuth and the view's direction into the record.
void describe(Record& record, const Material& material, const View& view);

}  // namespace lobelight::stability
