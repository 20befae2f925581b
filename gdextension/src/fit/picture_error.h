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

// The error of a picture that is drawn with a table. It decides between two placements of the lobes
// for one material, for which the likelihood (fit/em.h) is only a substitute. Errors of different
// materials cannot be compared.
//
// There are two invented lights: small lamps at night, with brightnesses over four powers of ten,
// and windows and lamps in a room, over two. A light is a sum of spherical Gaussians, so what a
// lobe sees of it has a closed form, in the two levels in which the lobe is drawn
// (fit/pyramid_kernel.h). The truth is a sum over nodes of the slice, others than those that
// mixtures are fitted to, at views between those of the table, each turned against the lights in
// several ways. Pictures are shown as ./dev compare shows them: the median at 0.18, clamped, to the
// power of 1/2.2.
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
