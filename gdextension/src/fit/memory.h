#pragma once

#include <cstddef>

#include "fit/table_fitter.h"

namespace lobelight {

// Bytes that fit_table() never allocates more of at a time, for a recipe whose BRDF is a model:
//
//   64 KiB + T·P·(32 K + 16) + threads · (96 N + 4 KiB · (K + 1) + 32 (I + 1))
//
// for T × P views, K lobes, N nodes in a slice and at most I iterations. The second term is the
// table and the report. Of the 96 N, 32 N are a slice, 32 N are the keys that the first guess sorts
// by or the blocks of em_pass(), and 32 N are a copy without unusable nodes. The rest of the third
// term: for each lobe the columns of a block and the memory of the acceleration, for each iteration
// the likelihood.
//
// Added if arcs are tried as well (fit/placement.h): two tables, 64 T·P·K, and
// PictureError::memory_bound() with 128 KiB for each thread. Least squares (fit/wide_lobes.h) run
// after EM and take 64 N + T·P (32 K + 640) instead of EM's part. A measured BRDF's own data are
// added once. Threads' stacks are not counted.
std::size_t fit_memory_bound(const Recipe& recipe, const FitOptions& options = {});

}  // namespace lobelight
