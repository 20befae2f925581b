#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "table/lobe_table.h"

namespace lobelight {

// Mean squared errors over a sphere's pixels under two lights.
struct PictureErrors {
  double lamps = 0.0;
  double windows = 0.0;
};

// How wrong a picture of a material is when it is drawn with a table: what likelihood (fit/em.h)
// only stands in for. It compares two placements of lobes for one material; as a number it means
// little.
//
// The lights are made up and no real place's: a night of small lamps whose brightness spreads over
// four powers of ten, and a room of windows and lamps that spread over two. Each is a sum of
// spherical Gaussians, so that what a lobe sees of it is one as well, in the two levels that are
// drawn in its place (fit/pyramid_kernel.h). What the material really reflects is the sum over
// other nodes than mixtures are fitted to, at views between those of the table, each turned against
// the lights in several ways. Both are shown as ./dev compare shows them: exposed so that the
// median is 0.18, clamped, to the power of 1/2.2.
class PictureError {
 public:
  // For tables with `views`. Throws Cancelled. `threads` as for parallel_for(); the result does not
  // depend on it. `progress`, which must outlive the object, is that of making it.
  PictureError(const Brdf& brdf, const glm::ivec2& views, int threads, Progress& progress);

  // Throws Cancelled.
  PictureErrors operator()(const LobeTable& table) const;

  // Bytes that it takes at most, but for a slice and its lights in each thread.
  static std::size_t memory_bound(const glm::ivec2& views);

 private:
  struct Sample {
    glm::dmat3 turn;  // from the tangent frame to the light's
    double shown;     // of what the material reflects
  };
  struct View {
    glm::dvec3 direction;
    double share;                 // of a sphere's pixels
    std::vector<Sample> samples;  // under the lamps, then as many under the windows
  };

  std::vector<View> views_;
  std::array<double, 2> exposures_{};
  int threads_;
  const Progress& progress_;
};

}  // namespace lobelight
