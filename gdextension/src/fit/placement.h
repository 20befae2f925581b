#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "fit/picture_error.h"
#include "table/lobe_table.h"

namespace lobelight {

// Where a table's lobes are.
enum class Placement {
  automatic,  // whichever has the smaller error (fit/picture_error.h, fit/wide_lobes.h)
  em,         // by maximum likelihood (fit/em.h)
  arc,        // along the highlight (fit/arc.h)
};

// "auto", "em", "arc"; the inverse throws std::invalid_argument naming the known ones.
std::string_view to_string(Placement placement);
Placement placement_from_string(std::string_view name);

// Reaches that a recipe may ask for, in slopes over alpha.
constexpr double kLeastReach = 0.5;
constexpr double kGreatestReach = 32.0;

// Whether `automatic` tries arcs. For rounder highlights and for few lobes EM is always better.
bool arcs_may_win(std::string_view brdf, const glm::dvec2& alpha, int lobes);

struct ArcTable {
  LobeTable table;
  double reach = 0.0;
  PictureErrors errors;
};

// The best table of arcs for `brdf`, with the lobes, views and albedos of `model`. If `reach` is 0,
// the reach with the smallest error is taken: the larger of the two lights' errors, each relative
// to that of `others` unless that is null. All views have the same shape, so that they can be
// interpolated.
ArcTable fit_arcs(const Brdf& brdf, const LobeTable& model, double reach, const PictureError& error,
                  const PictureErrors* others, int threads, Progress& progress);

}  // namespace lobelight
