#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "fit/table_fitter.h"

namespace lobelight {

// "lobes": "auto" of a recipe: the smallest count that reaches an error on a set of environments.
struct LobeCountRequest {
  Recipe recipe;                          // its `lobes` counts for nothing
  double target = 30.0;                   // dB
  int max_lobes = kMaxLobes;              // what is tried at most
  std::vector<std::string> environments;  // panoramas' paths, beside the synthetic one
};

// What was tried: a count, and the lowest PSNR over the environments.
struct LobeCountTrial {
  int lobes = 0;
  double psnr = 0.0;
};

struct LobeCount {
  LobeTable table;
  FitReport report;
  std::vector<LobeCountTrial> trials;  // the last one is that of the table
};

// Throws std::invalid_argument with one sentence.
void validate(const LobeCountRequest& request);

// Fits tables of 1, 2, 3, 4, 6, 8, 12, 16, 24 and 32 lobes, as far as max_lobes goes, until one
// reaches the target in every environment. A table's error is that of a sphere as ./dev compare
// measures it, each lobe being given the light under it exactly: what the table loses, not what the
// run time's pyramid adds. Throws std::runtime_error with one sentence where max_lobes do not do,
// ImageError and Cancelled.
LobeCount find_lobe_count(const LobeCountRequest& request, const Brdf& brdf, Progress& progress);

}  // namespace lobelight
