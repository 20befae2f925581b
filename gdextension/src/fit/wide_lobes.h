#pragma once

#include "base/progress.h"
#include "brdf/brdf.h"
#include "table/lobe_table.h"

namespace lobelight {

// Lobes of wide isotropic highlights, by least squares.
//
// The horizon and the cosine cut a wide slice off more sharply than a Gaussian ends. Sums of
// Gaussians with positive weights cannot follow, and EM lays all of its lobes on top of one
// another. Where a lobe at or below the horizon may take a little away, six follow closely.
//
// What counts is the picture: light varies the less the finer it is looked at, so that a slice's
// error is the sum of the squares of its spherical harmonics' coefficients, those of degree l over
// (l + 1/2)². Lobes have the coefficients of what is drawn in their place (fit/pyramid_kernel.h).

// The narrowest width that is wide; what the degrees that are looked at can show.
inline constexpr double kLeastWideWidth = 0.25;

// Whether lobes may be fitted so: the material is isotropic, of one colour and wide.
bool is_wide(const Brdf& brdf, const LobeTable& table);

// As for sample_slice().
struct SliceNodes {
  int per_axis;
  double rotation;
};

// Fits the lobes of all views again, each view from its neighbour's, and keeps them where the error
// between the views is smaller as well; returns whether it is. is_wide() holds. Throws Cancelled.
bool fit_wide_lobes(const Brdf& brdf, const SliceNodes& nodes, LobeTable& table,
                    Progress& progress);

}  // namespace lobelight
