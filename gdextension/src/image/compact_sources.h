#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "base/progress.h"
#include "image/panorama.h"

namespace lobelight {

// Most sources that materials draw.
inline constexpr int kMaxSources = 4;

// A compact bright light of a panorama, as a sun or a lamp.
struct CompactSource {
  glm::dvec3 direction;  // unit vector, y up
  double deviation;      // radians; its square is the variance per axis, bilinear filter included
  glm::dvec3 energy;     // integral over solid angle of the radiance that was taken out
};

// Takes at most `most` compact bright sources out of a panorama of linear radiance, the brightest
// first, and leaves its surroundings' level where they were: their energy and the integral of what
// is left are that of the panorama as it was. A panorama whose light has none that pays stays as it
// is, and so does one of less than 64 rows, whose texels are too wide to tell. Values that are
// negative or not finite count as no light. `threads` as for parallel_for(); the result does not
// depend on it. Throws Cancelled.
//
// 1. A seed is the brightest texel (mean of the channels) that is not within 5° of a seed that was
//    rejected; the first one of several. At most 8 are looked at.
// 2. The ring's level m is the median at 128 directions around it, 5.75° to 9.4° away.
// 3. What stays is at most C, the lowest of max(1.5 m, peak/65536) 4^k, k = 0, 1 …, below half the
//    peak, at which what sticks out is compact. It is made of the texels within 5° that are
//    brighter than C and joined by a straight line of such texels (15 points of it, at each of
//    which one of the four around will do) with the middle of those so joined with the seed; of
//    each, the share 1 − C/mean of every channel is taken. It is compact if its deviation is at
//    most 1.2° (without the bilinear filter's) and, where the texels resolve it, its energy at
//    least a quarter of what a Gaussian of that deviation and height has: a core in a halo has
//    less, and C rises until the core alone sticks out. The halo can be a source of its own.
// 4. It pays if it has at least 2 % of the light that there is with it: a lobe of a deviation of
//    0.2 radians then shows it as bright as the mean of the whole map. Less of it gains less than
//    it costs: a pixel spends on a source what it spends on ten lobes.
std::vector<CompactSource> take_sources(Panorama& panorama, int most, int threads,
                                        Progress& progress);

// As materials read them, 4 × 3 texels of four floats, row by row, a column for each source: its
// direction and deviation; its energy, 0 where there is no source; and 1024 times what single
// precision cuts off its direction.
std::vector<float> source_texels(const std::vector<CompactSource>& sources);

}  // namespace lobelight
