#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "brdf/brdf.h"
#include "sg/mixture.h"

namespace lobelight {

// Lobes placed in a row along a long highlight.
//
// Let t be the half-vector's slopes over alpha. A microfacet BRDF is a density of t that is round.
// Reflection maps it to a strip of light; the strip's axis is where the image of a circle of t is
// longest. The axis is cut into cells. Each lobe lies in the middle of a cell and has the cell's
// light. If the strip is long and the lobes are few, they are made narrower than maximum likelihood
// (fit/em.h) would have them: in a picture, gaps between lobes do less harm than light blurred
// across the strip.

// What the BRDF does not determine.
struct ArcShape {
  // Cells cover the axis from −reach to reach, in t. The light beyond is shared among them.
  double reach = 2.0;
  // Every cell has the same integral, along the strip, of the density to this power: at 0 all cells
  // are equally long, at 1 they have equal weights.
  double evenness = 0.15;
  // The variance of t across the strip; for GGX, times 1 + a² at place a of the axis.
  double across = 0.5;
  // A lobe narrower than `gap` times its cell's length is made wider: its variance is multiplied by
  // the ratio of the two squares to the power of `softness`.
  double gap = 0.45;
  double softness = 0.3;
  // Lobes have a width of their own, which makes the strip longer. Their places are moved towards
  // the middle to make up for this share of it.
  double drawing_in = 1.0;
};

// The shape that serves most counts and widths of `brdf`, for a given reach.
ArcShape arc_shape(const Brdf& brdf, double reach);

// Whether lobes can be placed along the highlights of `brdf`: models of microfacets with two
// widths.
bool has_arc(const Brdf& brdf);
bool has_arc(std::string_view brdf, const glm::dvec2& alpha);

// The lobes of the view `o`, in order along the strip. They depend continuously on `o` above the
// horizon. Means are above the horizon; weights sum to `albedo`.
Mixture arc_lobes(const Brdf& brdf, const glm::dvec3& o, int lobes, const ArcShape& shape,
                  double albedo);

}  // namespace lobelight
