#include "fit/table_fitter.h"

#include <chrono>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/one_line.h"
#include "base/parallel.h"
#include "brdf/measured.h"
#include "fit/arc.h"
#include "fit/continuation.h"
#include "fit/picture_error.h"
#include "fit/wide_lobes.h"

namespace lobelight {

namespace {

[[noreturn]] void refuse(const std::ostringstream& sentence) {
  throw std::invalid_argument(sentence.str());
}

// Measurements may be in any unit. Weights far from 1 would be stored as the largest half float, or
// as 0; such tables are refused.
void refuse_unstorable(const LobeTable& table, const Brdf& brdf) {
  double greatest = 0.0;
  int too_bright = 0;
  for (int p = 0; p < table.views().y; ++p) {
    for (int t = 0; t < table.views().x; ++t) {
      const double albedo = total_weight(table.mixture_at_view(t, p));
      if (!(albedo <= greatest)) greatest = albedo;
      if (!(albedo <= LobeTable::kMaxWeight)) ++too_bright;
    }
  }
  std::ostringstream sentence;
  sentence << brdf.name() << " reflects up to " << greatest << " times the light that falls on it";
  if (too_bright > 0) {
    sentence << ", in " << too_bright << " of " << table.views().x * table.views().y
             << " views more than the " << LobeTable::kMaxWeight
             << " that a table holds: its numbers are not in 1/sr.";
    refuse(sentence);
  }
  if (greatest < LobeTable::kMinWeight) {
    sentence << ", and a table holds no less than " << LobeTable::kMinWeight
             << ": its numbers are not in 1/sr.";
    refuse(sentence);
  }
}

void fit_independently(const Brdf& brdf, const Recipe& recipe, const FitOptions& options,
                       LobeTable& table, Progress& progress, FitReport& report) {
  const auto views = report.iterations.size();
  ViewFitter fitter(brdf, table, options, recipe.seed,
                    static_cast<int>(recipe.refine ? 2 * views : views), progress, &report);
  parallel_for(views, recipe.threads, progress, [&](std::size_t view) {
    const int t = static_cast<int>(view) % table.views().x;
    const int p = static_cast<int>(view) / table.views().x;
    fitter.fit(t, p, {}, {}, options.em.max_iterations);
    if (recipe.refine) {
      fitter.refine(t, p, table.mixture_at_view(t, p), {}, options.refinement_iterations);
    }
  });
}

// Shares of the progress: of arcs and of least squares in a fit that also tries them, and of the
// invented lights in that of arcs.
constexpr double kArcShare = 0.25;
constexpr double kSquaresShare = 0.5;
constexpr double kLightShare = 0.5;
// Arcs replace EM's lobes only if they are better by a tenth under both lights: smaller differences
// need not hold under other lights.
bool is_clearly_better(const PictureErrors& arcs, const PictureErrors& em) {
  return arcs.lamps < 0.9 * em.lamps && arcs.windows < 0.9 * em.windows;
}

// A table whose weights are the views' albedos and nothing else, for recipes that ask for arcs.
LobeTable albedos(const Brdf& brdf, const Recipe& recipe, const FitOptions& options,
                  const LobeTable& grid, const Progress& progress) {
  LobeTable table = grid;
  const glm::ivec2 views = grid.views();
  parallel_for(
      static_cast<std::size_t>(views.x * views.y), recipe.threads, progress, [&](std::size_t view) {
        const int t = static_cast<int>(view) % views.x;
        const int p = static_cast<int>(view) / views.x;
        const Slice slice = sample_slice(brdf, table.view(t, p), options.nodes_per_axis,
                                         seed_rotation(recipe.seed));
        Mixture lobes(static_cast<std::size_t>(table.lobes()), {0.0, {{0.0, 0.0, 1.0}, 1.0}});
        lobes.front().weight = slice.albedo;
        table.set_mixture_at_view(t, p, lobes);
      });
  return table;
}

// Fills the report for arcs: they take no iterations, but have a likelihood.
void report_arcs(const Brdf& brdf, const Recipe& recipe, const FitOptions& options,
                 const ArcTable& arcs, const Progress& progress, FitReport& report) {
  const int elevations = arcs.table.views().x;
  parallel_for(report.iterations.size(), recipe.threads, progress, [&](std::size_t view) {
    const int t = static_cast<int>(view) % elevations;
    const int p = static_cast<int>(view) / elevations;
    const Slice slice = sample_slice(brdf, arcs.table.view(t, p), options.nodes_per_axis / 2,
                                     seed_rotation(recipe.seed));
    EmOptions none;
    none.max_iterations = 0;
    const EmResult result = run_em(slice, arcs.table.mixture_at_view(t, p), none);
    report.iterations[view] = 0;
    report.log_likelihood[view] =
        result.log_likelihood.empty() ? 0.0 : result.log_likelihood.back();
  });
  report.first_view_curve = {report.log_likelihood.front()};
  report.arc_reach = arcs.reach;
}

}  // namespace

bool looks_at_arcs(const Recipe& recipe, std::string_view brdf, const glm::dvec2& alpha) {
  if (recipe.placement == Placement::arc) return true;
  return recipe.placement == Placement::automatic && recipe.method == FitMethod::continuation &&
         !recipe.refine && arcs_may_win(brdf, alpha, recipe.lobes);
}

std::string_view to_string(FitMethod method) {
  return method == FitMethod::independent ? "independent" : "continuation";
}

FitMethod fit_method_from_string(std::string_view name) {
  for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
    if (name == to_string(method)) return method;
  }
  std::ostringstream sentence;
  sentence << "method is \"" << one_line(name)
           << "\", which is not known; known are \"continuation\", \"independent\".";
  refuse(sentence);
}

glm::ivec2 resolve_views(const Recipe& recipe, bool isotropic) {
  glm::ivec2 views = recipe.views;
  if (views.x == 0) views.x = 16;
  if (views.y == 0) views.y = isotropic ? 1 : 8;
  return views;
}

glm::ivec2 resolve_views(const Recipe& recipe) {
  return resolve_views(recipe, recipe.alpha.x == recipe.alpha.y);
}

namespace {

// Checks what does not depend on the BRDF.
void validate_counts(const Recipe& recipe) {
  std::ostringstream sentence;
  if (recipe.lobes < 1 || recipe.lobes > kMaxLobes) {
    sentence << "lobes is " << recipe.lobes << ", but must be between 1 and " << kMaxLobes << ".";
    refuse(sentence);
  }
  if (recipe.reach != 0.0 && !(recipe.reach >= kLeastReach && recipe.reach <= kGreatestReach)) {
    sentence << "reach is " << recipe.reach << ", but must be between " << kLeastReach << " and "
             << kGreatestReach << ", or 0 for the best one.";
    refuse(sentence);
  }
  if (recipe.reach != 0.0 && recipe.placement == Placement::em) {
    sentence << "reach is " << recipe.reach << ", but placement \"em\" has none.";
    refuse(sentence);
  }
  if (recipe.placement == Placement::arc && recipe.method == FitMethod::independent) {
    sentence << "placement is \"arc\", which goes with method \"continuation\" only.";
    refuse(sentence);
  }
  if (recipe.placement == Placement::arc && recipe.refine) {
    sentence << "placement is \"arc\", whose lobes cannot be refined.";
    refuse(sentence);
  }
  const glm::ivec2 views = resolve_views(recipe, true);
  if (views.x < 2 || views.x > kMaxViews || views.y < 1 || views.y > kMaxViews) {
    sentence << "views is (" << recipe.views.x << ", " << recipe.views.y << "), but needs 2 to "
             << kMaxViews << " elevations and 1 to " << kMaxViews
             << " azimuths (0 for the default).";
    refuse(sentence);
  }
}

// Checks what depends on the BRDF.
void validate_material(const Recipe& recipe, const glm::dvec2& alpha, bool isotropic) {
  const glm::ivec2 views = resolve_views(recipe, isotropic);
  std::ostringstream sentence;
  if (views.y == 1 && !isotropic) {
    sentence << "views is (" << recipe.views.x << ", " << recipe.views.y
             << "), but an anisotropic alpha needs at least 2 azimuths.";
    refuse(sentence);
  }
  if (views.y == 1 && alpha.x != alpha.y) {
    sentence << "alpha is (" << alpha.x << ", " << alpha.y
             << "), but the measurements are isotropic: both widths must be equal.";
    refuse(sentence);
  }
}

}  // namespace

void validate(const Recipe& recipe) {
  validate_counts(recipe);
  validate_brdf(recipe.brdf, recipe.alpha);
  if (is_measured_file(recipe.brdf)) return;
  if (recipe.placement == Placement::arc && !has_arc(recipe.brdf, recipe.alpha)) {
    std::ostringstream sentence;
    sentence << "placement is \"arc\", but " << recipe.brdf << " of the widths (" << recipe.alpha.x
             << ", " << recipe.alpha.y << ") has no long highlight.";
    refuse(sentence);
  }
  validate_material(recipe, recipe.alpha, recipe.alpha.x == recipe.alpha.y);
}

LobeTable fit_table(const Brdf& brdf, const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options) {
  validate_counts(recipe);
  validate_material(recipe, brdf.alpha(), brdf.is_isotropic());
  if (recipe.placement == Placement::arc && !has_arc(brdf)) {
    std::ostringstream sentence;
    sentence << "placement is \"arc\", but " << brdf.name() << " has no long highlight.";
    refuse(sentence);
  }
  const auto start = std::chrono::steady_clock::now();
  FitReport own;
  FitReport& used = report ? *report : own;
  used = {};
  LobeTable table(brdf.alpha(), recipe.lobes, resolve_views(recipe, brdf.is_isotropic()));
  if (brdf.is_coloured()) table.add_second_texels();
  const auto views =
      static_cast<std::size_t>(table.views().x) * static_cast<std::size_t>(table.views().y);
  used.iterations.assign(views, 0);
  used.log_likelihood.assign(views, 0.0);
  progress.set(0.0);
  const bool arcs = looks_at_arcs(recipe, brdf.name(), brdf.alpha());
  const bool alone = recipe.placement == Placement::arc;
  const bool squares = recipe.placement == Placement::automatic &&
                       recipe.method == FitMethod::continuation && !recipe.refine &&
                       is_wide(brdf, table);
  Progress em(progress, alone || !(arcs || squares) ? 1.0
                        : arcs                      ? 1.0 - kArcShare
                                                    : 1.0 - kSquaresShare);
  if (alone) {
    table = albedos(brdf, recipe, options, table, progress);
  } else if (recipe.method == FitMethod::independent) {
    fit_independently(brdf, recipe, options, table, em, used);
  } else {
    const Continuation how{brdf, recipe.seed, recipe.threads, recipe.refine, options};
    continue_over_views(how, {}, neighbours_lobes(table), table, em, &used);
  }
  if (squares) {
    const SliceNodes nodes{options.nodes_per_axis, seed_rotation(recipe.seed)};
    Progress part(progress, kSquaresShare);
    used.is_by_squares = fit_wide_lobes(brdf, nodes, table, part);
  }
  if (arcs) {
    Progress part(progress, alone ? 1.0 : kArcShare);
    Progress light(part, kLightShare);
    Progress tables(part, 1.0 - kLightShare);
    const PictureError error(brdf, table.views(), recipe.threads, light);
    PictureErrors likely;
    if (!alone) likely = error(table);
    ArcTable found = fit_arcs(brdf, table, recipe.reach, error, alone ? nullptr : &likely,
                              recipe.threads, tables);
    if (alone || is_clearly_better(found.errors, likely)) {
      report_arcs(brdf, recipe, options, found, progress, used);
      table = std::move(found.table);
    }
  }
  refuse_unstorable(table, brdf);
  progress.set(1.0);
  used.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return table;
}

LobeTable fit_table(const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options) {
  validate(recipe);
  return fit_table(*make_brdf(recipe.brdf, recipe.alpha), recipe, progress, report, options);
}

}  // namespace lobelight
