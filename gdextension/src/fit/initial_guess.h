#pragma once

#include "fit/slice.h"
#include "sg/mixture.h"

namespace lobelight {

// Töral 2015's start for EM: the slice's nodes sorted along the axis of their largest variance, cut
// into `lobes` sets of equal mass, one spherical Gaussian estimated from each. Weights sum to the
// slice's albedo.
Mixture initial_guess(const Slice& slice, int lobes);

}  // namespace lobelight
