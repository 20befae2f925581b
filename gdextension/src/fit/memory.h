#pragma once

#include <cstddef>

#include "fit/table_fitter.h"

namespace lobelight {

// Bytes that fit_table() never allocates more of at a time, for a recipe whose BRDF is a model:
//
//   64 KiB + T·P·(32 K + 16) + threads · (96 N + 4 KiB · (K + 1) + 32 (I + 1))
//
// T × P views, K lobes, N nodes a slice, I iterations at most. The middle part is the table and the
// report. Of the 96 N, 32 are a slice; 32 are what the first guess sorts by, or the slice again as
// em_pass() wants it; 32 are for data of which nodes have to be left out. Per lobe the working
// memory is a block's columns and what the acceleration remembers, per iteration the likelihood.
// Where lobes along the highlight are looked at as well (fit/placement.h), two more tables, 64
// T·P·K, and what they are compared by, PictureError::memory_bound() and 128 KiB a thread, are
// added. Least squares (fit/wide_lobes.h) come after EM, and take 64 N + T·P (32 K + 640) in place
// of its part. A measured BRDF's own data come on top, once. Threads' stacks are not counted.
std::size_t fit_memory_bound(const Recipe& recipe, const FitOptions& options = {});

}  // namespace lobelight
