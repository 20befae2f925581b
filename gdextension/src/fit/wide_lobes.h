#pragma once

#include "base/progress.h"
#include "brdf/brdf.h"
#include "table/lobe_table.h"

namespace lobelight {

// Lobes of wide isotropic highlights, by least squares.
//
// The horizon and the cosine make a wide slice end more abruptly than a Gaussian does. Gaussians
// with positive weights cannot follow that; EM puts all of them at the same place. If a lobe at or
// below the horizon may have a small negative weight, six lobes follow the slice closely.
//
// The error is the one that a picture shows. Light has less energy in finer detail, so the error is
// the sum of the squared differences of the spherical harmonics' coefficients, those of degree l
// divided by (l + 1/2)². Lobes have the coefficients of the kernels that are drawn in their place
// (fit/pyramid_kernel.h).

// The least width that counts as wide: narrower slices need higher degrees than are looked at.
inline constexpr double kLeastWideWidth = 0.25;

// Whether lobes may be fitted so: the material is isotropic, of one colour and wide.
bool is_wide(const Brdf& brdf, const LobeTable& table);

// As for sample_slice().
struct SliceNodes {
  int per_axis;
  double rotation;
};

// Fits the lobes of all views again, each view from its neighbour's. Keeps them if the error is
// smaller between the views, too, and returns whether it is. The table must satisfy is_wide().
// Throws Cancelled.
bool fit_wide_lobes(const Brdf& brdf, const SliceNodes& nodes, LobeTable& table,
                    Progress& progress);

}  // namespace lobelight
