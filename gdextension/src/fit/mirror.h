#pragma once

#include <vector>

#include "fit/mixture.h"

namespace lobelight {

// Mirror symmetry of a mixture: which lobe is the mirror image of which. A table is mirrored in the
// planes x = 0 and y = 0, so views on these planes need lobes that are their own mirror image as a
// set: anything else shows as a seam.
struct MirrorPairs {
  std::vector<int> x;  // lobe k's image under x → −x, possibly k itself; empty: not symmetric
  std::vector<int> y;  // the same for y → −y
};

inline glm::dvec3 mirrored_x(const glm::dvec3& v) { return {-v.x, v.y, v.z}; }
inline glm::dvec3 mirrored_y(const glm::dvec3& v) { return {v.x, -v.y, v.z}; }

// For every lobe the one nearest to its image; each lobe is used once.
std::vector<int> match_images(const Mixture& mixture, glm::dvec3 (*mirrored)(const glm::dvec3&));

// Averages every lobe with its image, so that the mixture is symmetric to the last bit.
void symmetrise(Mixture& mixture, const MirrorPairs& pairs);

// Pairs whose two lobes lie within `distance` standard deviations of the plane are one lobe, in
// effect, and cannot part along the plane while they are each other's image. Each lobe of such a
// pair becomes its own image, on the plane and half a standard deviation to either side of where
// the two met. `image` is changed with the mixture. `normal` is the plane's: x or y axis.
void split_merged_pairs(Mixture& mixture, std::vector<int>& image, const glm::dvec3& normal,
                        double distance);

}  // namespace lobelight
