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
  automatic,  // as the smaller error says (fit/picture_error.h, fit/wide_lobes.h)
  em,         // where the likelihood wants them (fit/em.h)
  arc,        // along the highlight (fit/arc.h)
};

// "auto", "em", "arc"; the inverse throws std::invalid_argument naming the known ones.
std::string_view to_string(Placement placement);
Placement placement_from_string(std::string_view name);

// Reaches that a recipe may ask for, in slopes over alpha.
constexpr double kLeastReach = 0.5;
constexpr double kGreatestReach = 32.0;

// Whether `automatic` looks at arcs at all: rounder highlights and few lobes are always the better
// served by EM.
bool arcs_may_win(std::string_view brdf, const glm::dvec2& alpha, int lobes);

struct ArcTable {
  LobeTable table;
  double reach = 0.0;
  PictureErrors errors;
};

// The best table of arcs for `brdf`, of as many lobes and views as `model`, and with the weights of
// its views: the error chooses the reach, unless `reach` is above 0: beside that of `others`, which
// may be null, under the light where the arcs fare worse. All views have one shape, so
// that neighbouring ones can be interpolated.
ArcTable fit_arcs(const Brdf& brdf, const LobeTable& model, double reach, const PictureError& error,
                  const PictureErrors* others, int threads, Progress& progress);

}  // namespace lobelight
