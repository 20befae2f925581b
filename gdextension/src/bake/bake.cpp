#include "bake/bake.h"

#include <chrono>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bake/memory.h"
#include "brdf/measured.h"
#include "fit/view_error.h"

namespace lobelight {

namespace {

// Shares of the progress.
constexpr double kReadShare = 0.1;  // of what measurements take
constexpr double kErrorShare = 0.05;

}  // namespace

void validate(const TableRequest& request) {
  Recipe recipe = request.recipe;
  if (request.target) {
    if (recipe.refine) {
      throw std::invalid_argument(
          "refine is true, but \"auto\" counts Gaussians: lobes must be a number.");
    }
    validate(*request.target);
    recipe.lobes = request.target->max_lobes;
  }
  validate(recipe);
  check_memory(request);
}

void validate_set(const SetRecipe& recipe) {
  validate(recipe);
  check_memory(recipe);
}

BakedTable bake_table(const TableRequest& request, Progress& progress,
                      const LobeCountOptions& options) {
  validate(request);
  const Recipe& recipe = request.recipe;
  const double read_share = is_measured_file(recipe.brdf) ? kReadShare : 0.0;
  const double error_share = recipe.refine ? 0.0 : kErrorShare;
  Progress read(progress, read_share);
  Progress fit(progress, 1.0 - read_share - error_share);
  Progress errors(progress, error_share);

  const std::unique_ptr<Brdf> brdf = make_brdf(recipe.brdf, recipe.alpha, &read);
  read.set(1.0);
  FitReport report;
  std::optional<double> psnr;
  LobeTable table = [&] {
    if (!request.target) return fit_table(*brdf, recipe, fit, &report, options.fit);
    LobeCount found = find_lobe_count(*request.target, recipe, *brdf, fit, options);
    report = std::move(found.report);
    psnr = found.trials.back().psnr;
    return std::move(found.table);
  }();

  BakedTable baked{
      std::string(brdf->name()), recipe, std::move(table), std::move(report), {}, psnr, {}};
  baked.recipe.lobes = baked.table.lobes();
  // The recipe that makes this table again.
  baked.recipe.placement = baked.report.arc_reach > 0.0 ? Placement::arc
                           : baked.report.is_by_squares ? Placement::automatic
                                                        : Placement::em;
  baked.recipe.reach = baked.report.arc_reach;
  if (!recipe.refine) baked.errors = view_errors(baked.table, *brdf, recipe.threads, errors);
  if (const auto* measured = dynamic_cast<const MeasuredBrdf*>(brdf.get())) {
    baked.measurements = {measured->clamped(), measured->asymmetry()};
  }
  progress.set(1.0);
  return baked;
}

BakedSet bake_set(const SetRecipe& recipe, Progress& progress) {
  validate_set(recipe);
  const auto start = std::chrono::steady_clock::now();
  BakedSet baked{recipe, fit_table_set(recipe, progress), 0.0};
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  baked.seconds = elapsed.count();
  return baked;
}

}  // namespace lobelight
