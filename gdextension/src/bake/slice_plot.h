#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace lobelight {

// What plots ask of a BRDF. `brdf` and `alpha` are as make_brdf() takes them; the measurements of
// the last file are kept for the next call, since plots ask for many slices of them. `view` needs
// not be of unit length. Throws what make_brdf() does, and std::invalid_argument with one sentence
// for a view that is not above the horizon.

// Share of an even light that is reflected into the view.
double directional_albedo(const std::string& brdf, const glm::dvec2& alpha, const glm::dvec3& view);

// ρ(i, o) i_z for `count` light directions i, 2 to 100000, in the plane of the normal and the view
// o: at equal angles from −90° to 90° from the normal, positive on the view's side. Throws
// std::invalid_argument also for another count.
std::vector<double> slice_in_plane(const std::string& brdf, const glm::dvec2& alpha,
                                   const glm::dvec3& view, int count);

}  // namespace lobelight
