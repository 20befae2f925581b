#include "fit/table_fitter.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include "base/parallel.h"
#include "fit/initial_guess.h"
#include "table/half_vector.h"

namespace lobelight {

namespace {

constexpr double kGoldenRatioFraction = 0.61803398874989484820;

// Pairs of mirror images this close to their plane, in standard deviations, are let go (two
// Gaussians less than two standard deviations apart have a single peak). On Ward and GGX, (0.05,
// 0.2) and (0.05, 0.5), 0.8 brings the mean L1 error of the views in the plane back to that of fits
// without symmetry; never letting go costs up to 40 % more there, mostly near grazing, where lobes
// that lay across the plane are needed along it.
constexpr double kMergedPair = 0.8;

[[noreturn]] void refuse(const std::ostringstream& sentence) {
  throw std::invalid_argument(sentence.str());
}

// One bake: everything that is shared by its views.
class TableFit {
 public:
  TableFit(const Recipe& recipe, const FitOptions& options, Progress& progress, FitReport& report)
      : recipe_(recipe),
        options_(options),
        progress_(progress),
        report_(report),
        brdf_(make_brdf(recipe.brdf, recipe.alpha)),
        table_(recipe.alpha, recipe.lobes, resolve_views(recipe)) {
    options_.em.progress = &progress;
    const double turns = static_cast<double>(recipe.seed % 1048576) * kGoldenRatioFraction;
    rotation_ = turns - std::floor(turns);
    const auto views =
        static_cast<std::size_t>(elevations()) * static_cast<std::size_t>(azimuths());
    report_.iterations.assign(views, 0);
    report_.log_likelihood.assign(views, 0.0);
    progress_.set(0.0);
  }

  LobeTable run() {
    if (recipe_.method == FitMethod::independent) {
      fit_independently();
    } else {
      fit_by_continuation();
    }
    progress_.set(1.0);
    return std::move(table_);
  }

 private:
  int elevations() const { return table_.views().x; }
  int azimuths() const { return table_.views().y; }

  void fit_independently();
  void fit_by_continuation();
  void fit_column(int p, const Mixture& pole, const MirrorPairs& pole_mirror);

  // Fits view (t, p) from `start`, or from Töral's guess when it is empty, and stores the lobes.
  Mixture fit_view(int t, int p, Mixture start, const MirrorPairs& mirror);

  const Recipe& recipe_;
  FitOptions options_;
  Progress& progress_;
  FitReport& report_;
  std::unique_ptr<Brdf> brdf_;
  LobeTable table_;
  double rotation_ = 0.0;
  std::mutex finished_mutex_;
  int finished_ = 0;
};

Mixture TableFit::fit_view(int t, int p, Mixture start, const MirrorPairs& mirror) {
  progress_.throw_if_cancelled();
  const Slice slice = sample_slice(*brdf_, table_.view(t, p), options_.nodes_per_axis, rotation_);
  if (start.empty()) start = initial_guess(slice, recipe_.lobes);
  EmOptions em = options_.em;
  em.mirror = mirror;
  EmResult result = run_em(slice, std::move(start), em);
  table_.set_mixture_at_view(t, p, result.mixture);

  const auto view = static_cast<std::size_t>(p * elevations() + t);
  report_.iterations[view] = result.iterations;
  if (!result.log_likelihood.empty()) report_.log_likelihood[view] = result.log_likelihood.back();
  if (view == 0) report_.first_view_curve = result.log_likelihood;
  const std::lock_guard<std::mutex> lock(finished_mutex_);
  ++finished_;
  progress_.set(static_cast<double>(finished_) / static_cast<double>(report_.iterations.size()));
  return std::move(result.mixture);
}

void TableFit::fit_independently() {
  parallel_for(report_.iterations.size(), recipe_.threads, [this](std::size_t view) {
    const int t = static_cast<int>(view) % elevations();
    const int p = static_cast<int>(view) / elevations();
    fit_view(t, p, {}, {});
  });
}

// The neighbour's lobes in half-vector form, read at this view.
Mixture transport(const Mixture& from, const glm::dvec3& from_view, const glm::dvec3& to_view) {
  // Means that land below the horizon start just above it.
  constexpr double kMinHeight = 1e-3;
  Mixture to = from;
  for (Lobe& lobe : to) {
    lobe.gaussian = from_half_vector(to_half_vector(lobe.gaussian, from_view), to_view);
    lobe.gaussian.mean.z = std::max(lobe.gaussian.mean.z, kMinHeight);
    lobe.gaussian.mean = glm::normalize(lobe.gaussian.mean);
  }
  return to;
}

void TableFit::fit_by_continuation() {
  // Normal incidence: symmetric in both planes, but only those count that the table is mirrored in.
  const Slice slice = sample_slice(*brdf_, table_.view(0, 0), options_.nodes_per_axis, rotation_);
  Mixture start = initial_guess(slice, recipe_.lobes);
  MirrorPairs mirror;
  if (options_.keep_mirror_symmetry) {
    mirror.y = match_images(start, mirrored_y);
    if (azimuths() > 1) mirror.x = match_images(start, mirrored_x);
    symmetrise(start, mirror);
  }
  const Mixture pole = fit_view(0, 0, std::move(start), mirror);

  parallel_for(static_cast<std::size_t>(azimuths()), recipe_.threads,
               [&](std::size_t p) { fit_column(static_cast<int>(p), pole, mirror); });
}

void TableFit::fit_column(int p, const Mixture& pole, const MirrorPairs& pole_mirror) {
  MirrorPairs mirror;
  if (p == 0) mirror.y = pole_mirror.y;
  if (p > 0 && p == azimuths() - 1) mirror.x = pole_mirror.x;
  if (p > 0) {
    // At the pole all azimuths are one view.
    table_.set_mixture_at_view(0, p, pole);
    const auto view = static_cast<std::size_t>(p * elevations());
    report_.log_likelihood[view] = report_.log_likelihood[0];
    const std::lock_guard<std::mutex> lock(finished_mutex_);
    ++finished_;
  }
  Mixture previous = pole;
  for (int t = 1; t < elevations(); ++t) {
    Mixture start = transport(previous, table_.view(t - 1, p), table_.view(t, p));
    split_merged_pairs(start, mirror.x, {1.0, 0.0, 0.0}, kMergedPair);
    split_merged_pairs(start, mirror.y, {0.0, 1.0, 0.0}, kMergedPair);
    previous = fit_view(t, p, std::move(start), mirror);
  }
}

}  // namespace

std::string_view to_string(FitMethod method) {
  return method == FitMethod::independent ? "independent" : "continuation";
}

FitMethod fit_method_from_string(std::string_view name) {
  for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
    if (name == to_string(method)) return method;
  }
  std::ostringstream sentence;
  sentence << "method is \"" << name
           << "\", which is not known; known are \"continuation\", \"independent\".";
  refuse(sentence);
}

glm::ivec2 resolve_views(const Recipe& recipe) {
  glm::ivec2 views = recipe.views;
  if (views.x == 0) views.x = 16;
  if (views.y == 0) views.y = recipe.alpha.x == recipe.alpha.y ? 1 : 8;
  return views;
}

void validate(const Recipe& recipe) {
  make_brdf(recipe.brdf, recipe.alpha);  // refuses unknown names and widths out of range
  std::ostringstream sentence;
  if (recipe.lobes < 1 || recipe.lobes > kMaxLobes) {
    sentence << "lobes is " << recipe.lobes << ", but must be between 1 and " << kMaxLobes << ".";
    refuse(sentence);
  }
  const glm::ivec2 views = resolve_views(recipe);
  if (views.x < 2 || views.x > kMaxViews || views.y < 1 || views.y > kMaxViews) {
    sentence << "views is (" << recipe.views.x << ", " << recipe.views.y << "), but needs 2 to "
             << kMaxViews << " elevations and 1 to " << kMaxViews
             << " azimuths (0 for the default).";
    refuse(sentence);
  }
  if (views.y == 1 && recipe.alpha.x != recipe.alpha.y) {
    sentence << "views is (" << recipe.views.x << ", " << recipe.views.y
             << "), but an anisotropic alpha needs at least 2 azimuths.";
    refuse(sentence);
  }
}

LobeTable fit_table(const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options) {
  validate(recipe);
  const auto start = std::chrono::steady_clock::now();
  FitReport own;
  FitReport& used = report ? *report : own;
  used = {};
  LobeTable table = TableFit(recipe, options, progress, used).run();
  used.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return table;
}

}  // namespace lobelight
