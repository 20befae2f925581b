#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "fit/table_fitter.h"

namespace lobelight {

// The target of "lobes": "auto": the fewest lobes whose pictures reach this PSNR in all
// environments.
struct LobeTarget {
  double psnr = 30.0;                     // dB, at most 46
  int max_lobes = kMaxLobes;              // what is tried at most
  std::vector<std::string> environments;  // panoramas' paths (UTF-8), beside the synthetic one
};

// A number of lobes that was tried, and the lowest PSNR over the environments.
struct LobeCountTrial {
  int lobes = 0;
  double psnr = 0.0;
};

struct LobeCount {
  LobeTable table;
  FitReport report;
  std::vector<LobeCountTrial> trials;  // the last one is that of the table
};

// Environments are looked at with at most this many texels: the sphere is small.
constexpr int kEnvironmentWidth = 2048;
constexpr int kEnvironmentHeight = 1024;

// What a recipe does not say, with the values that every bake uses; tests vary them.
struct LobeCountOptions {
  int size = 32;  // of the sphere, in pixels
  int samples =
      1024;  // a pixel of the reference; the noise bounds the targets that can be asked for
  FitOptions fit;
};

// Throws std::invalid_argument with one sentence.
void validate(const LobeTarget& target);

// Fits tables of 1, 2, 3, 4, 6, 8, 12, 16, 24 and 32 lobes, up to max_lobes, until one reaches the
// target in every environment. The recipe's own number of lobes is ignored. The error is that of a
// sphere, measured as ./dev compare measures it, with the exact light under each lobe: it shows
// what the table loses, not what the pyramid of the run time adds. If lobes may be fitted by least
// squares (fit/wide_lobes.h), EM's are tried as well. Throws std::runtime_error with one sentence
// if max_lobes are not enough, ImageError and Cancelled.
LobeCount find_lobe_count(const LobeTarget& target, const Recipe& recipe, const Brdf& brdf,
                          Progress& progress, const LobeCountOptions& options = {});

}  // namespace lobelight
