#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "brdf/brdf.h"
#include "sg/mixture.h"

namespace lobelight {

// Lobes strung along a highlight. A BRDF of microfacets is a density of slopes over alpha, t, that
// is round in t; the mirror makes of it a strip of light along the axis in which the image of a
// circle of t is longest. Lobes lie on that axis, each in the middle of a cell of it, with the
// light of its cell. Where lobes are few for a long strip, they are kept narrower than the
// likelihood wants them (fit/em.h): gaps between them cost less in a picture than light that is
// blurred across the strip.

// What the integrals do not say.
struct ArcShape {
  // Cells are cut from −reach to reach along the axis, in t; what lies beyond is left to the
  // others.
  double reach = 2.0;
  // Cells have equal integrals of the density to this power over the strip's length: 0 makes them
  // equally long, 1 equally heavy.
  double evenness = 0.15;
  // The variance of t across the strip is this, with GGX times 1 + a² at the place a.
  double across = 0.5;
  // A lobe that is narrower than `gap` times its cell's length is made wider, by the ratio of the
  // two to the power of `softness`.
  double gap = 0.45;
  double softness = 0.3;
  // Lobes widen the strip along its axis; their places are drawn in by this share of what would
  // make up for it.
  double drawing_in = 1.0;
};

// The shape that serves most counts and widths of `brdf`, for a given reach.
ArcShape arc_shape(const Brdf& brdf, double reach);

// Whether lobes can be placed along the highlights of `brdf`: models of microfacets with two
// widths.
bool has_arc(const Brdf& brdf);
bool has_arc(std::string_view brdf, const glm::dvec2& alpha);

// Lobes for the view `o`, in the order of their places; a continuous function of `o` above the
// horizon. Means are above the horizon; weights sum to `albedo`.
Mixture arc_lobes(const Brdf& brdf, const glm::dvec3& o, int lobes, const ArcShape& shape,
                  double albedo);

}  // namespace lobelight
