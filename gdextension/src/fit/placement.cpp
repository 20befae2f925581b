#include "fit/placement.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "base/one_line.h"
#include "base/parallel.h"
#include "fit/arc.h"
#include "fit/mirror.h"
#include "fit/picture_error.h"

namespace lobelight {

namespace {

// The least ratio of the two widths and the least number of lobes for arcs. Below the ratio, arcs
// are as good as EM under small lamps, which the invented lights have, but 1 to 4 dB worse under
// skies and in rooms (ratios of 5 to 15). Fewer lobes leave gaps along the highlight that cost as
// much.
constexpr double kLeastArcRatio = 18.0;
constexpr int kFewestArcLobes = 8;
constexpr double kMostArcRatioPerLobe = 5.0;

LobeTable arc_table(const Brdf& brdf, const LobeTable& model, const ArcShape& shape, int threads,
                    const Progress& progress) {
  LobeTable table(brdf.alpha(), model.lobes(), model.views());
  const glm::ivec2 views = model.views();
  parallel_for(static_cast<std::size_t>(views.x * views.y), threads, progress,
               [&](std::size_t view) {
                 const int t = static_cast<int>(view) % views.x;
                 const int p = static_cast<int>(view) / views.x;
                 Mixture lobes = arc_lobes(brdf, table.view(t, p), model.lobes(), shape,
                                           total_weight(model.mixture_at_view(t, p)));
                 // To the last bit, as the table is mirrored.
                 std::vector<Mirror> mirrors;
                 if (p == 0 || t == 0) mirrors.push_back(match_images(lobes, 1));
                 if (p == views.y - 1 || t == 0) mirrors.push_back(match_images(lobes, 0));
                 symmetrise(lobes, mirrors);
                 table.set_mixture_at_view(t, p, lobes);
               });
  return table;
}

}  // namespace

std::string_view to_string(Placement placement) {
  switch (placement) {
    case Placement::em:
      return "em";
    case Placement::arc:
      return "arc";
    default:
      return "auto";
  }
}

Placement placement_from_string(std::string_view name) {
  for (const Placement placement : {Placement::automatic, Placement::em, Placement::arc}) {
    if (name == to_string(placement)) return placement;
  }
  std::ostringstream sentence;
  sentence << "placement is \"" << one_line(name)
           << "\", which is not known; known are \"auto\", \"em\", \"arc\".";
  throw std::invalid_argument(sentence.str());
}

bool arcs_may_win(std::string_view brdf, const glm::dvec2& alpha, int lobes) {
  const double narrow = std::min(alpha.x, alpha.y);
  const double wide = std::max(alpha.x, alpha.y);
  return has_arc(brdf, alpha) && wide >= kLeastArcRatio * narrow && lobes >= kFewestArcLobes &&
         wide <= kMostArcRatioPerLobe * lobes * narrow;
}

ArcTable fit_arcs(const Brdf& brdf, const LobeTable& model, double reach, const PictureError& error,
                  const PictureErrors* others, int threads, Progress& progress) {
  const bool ggx = brdf.name() == "ggx";
  const std::vector<double> reaches = reach > 0.0 ? std::vector<double>{reach}
                                      : ggx       ? std::vector<double>{6.0, 8.5, 12.0}
                                                  : std::vector<double>{1.6, 1.8, 2.0, 2.3, 2.6};
  std::optional<ArcTable> best;
  double least = 0.0;
  PictureErrors yardstick;
  if (others) yardstick = *others;
  int tried = 0;
  for (const double candidate : reaches) {
    LobeTable table = arc_table(brdf, model, arc_shape(brdf, candidate), threads, progress);
    const PictureErrors own = error(table);
    progress.set(static_cast<double>(++tried) / static_cast<double>(reaches.size()));
    if (!best && !others) yardstick = own;
    // The error under the light where it is larger.
    const double worse = std::max(own.lamps / yardstick.lamps, own.windows / yardstick.windows);
    if (best && !(worse < least)) continue;
    least = worse;
    best = ArcTable{std::move(table), candidate, own};
  }
  return std::move(*best);
}

}  // namespace lobelight
