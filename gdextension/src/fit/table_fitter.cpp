#include "fit/table_fitter.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "brdf/measured.h"
#include "fit/channel_weights.h"
#include "fit/initial_guess.h"
#include "fit/refinement.h"
#include "table/half_vector.h"

namespace lobelight {

namespace {

[[noreturn]] void refuse(const std::ostringstream& sentence) {
  throw std::invalid_argument(sentence.str());
}

// One bake: everything that is shared by its views.
class TableFit {
 public:
  TableFit(const Brdf& brdf, const Recipe& recipe, const FitOptions& options, Progress& progress,
           FitReport& report)
      : recipe_(recipe),
        options_(options),
        progress_(progress),
        report_(report),
        brdf_(brdf),
        table_(brdf.alpha(), recipe.lobes, resolve_views(recipe, brdf.is_isotropic())) {
    if (brdf.is_coloured()) table_.add_second_texels();
    options_.em.progress = &progress;
    rotation_ = seed_rotation(recipe.seed);
    const auto views =
        static_cast<std::size_t>(elevations()) * static_cast<std::size_t>(azimuths());
    report_.iterations.assign(views, 0);
    report_.log_likelihood.assign(views, 0.0);
    fits_ = static_cast<int>(views);
    if (recipe.method == FitMethod::continuation) {
      fits_ += options_.smoothing_passes * (elevations() - 2) * azimuths();
    }
    if (recipe.refine) {
      const bool smoothed = recipe.method == FitMethod::continuation;
      fits_ += (smoothed ? 2 * elevations() - 2 : elevations()) * azimuths();
    }
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
  void fit_column(int p, const Mixture& pole, const std::vector<Mirror>& pole_mirrors);

  // Brings the lobes of a column's neighbouring views together (FitOptions::smoothing_passes);
  // mirrors[t] are the ties of view t.
  void smooth_column(int p, const std::vector<std::vector<Mirror>>& mirrors);

  // Fits view (t, p) from `start`, or from Töral's guess when it is empty, and stores the lobes.
  Mixture fit_view(int t, int p, Mixture start, std::vector<Mirror> mirrors, int max_iterations);

  // Refines a column's views, then the inner ones once more from what smooth_column() starts from.
  void refine_column(int p, const std::vector<std::vector<Mirror>>& mirrors);

  // Refines view (t, p) from `start` on (fit/refinement.h), and stores the lobes.
  void refine_view(int t, int p, Mixture start, const std::vector<Mirror>& mirrors,
                   int max_iterations);

  void count_fit();

  const Recipe& recipe_;
  FitOptions options_;
  Progress& progress_;
  FitReport& report_;
  const Brdf& brdf_;
  LobeTable table_;
  double rotation_ = 0.0;
  std::mutex finished_mutex_;
  int finished_ = 0;
  int fits_ = 0;
};

Mixture TableFit::fit_view(int t, int p, Mixture start, std::vector<Mirror> mirrors,
                           int max_iterations) {
  progress_.throw_if_cancelled();
  const Slice slice = sample_slice(brdf_, table_.view(t, p), options_.nodes_per_axis, rotation_);
  if (start.empty()) start = initial_guess(slice, recipe_.lobes);
  EmOptions em = options_.em;
  em.mirrors = std::move(mirrors);
  em.max_iterations = max_iterations;
  EmResult result = run_em(slice, std::move(start), em);
  table_.set_mixture_at_view(t, p, result.mixture);
  if (table_.has_second_texels()) {
    const auto nodes = channel_node_weights(brdf_, table_.view(t, p), slice);
    table_.set_channel_weights_at_view(t, p, channel_weights(slice, nodes, result.mixture));
  }

  const auto view = static_cast<std::size_t>(p * elevations() + t);
  report_.iterations[view] += result.iterations;
  if (!result.log_likelihood.empty()) report_.log_likelihood[view] = result.log_likelihood.back();
  if (view == 0) report_.first_view_curve = result.log_likelihood;
  count_fit();
  return std::move(result.mixture);
}

void TableFit::refine_view(int t, int p, Mixture start, const std::vector<Mirror>& mirrors,
                           int max_iterations) {
  progress_.throw_if_cancelled();
  const glm::dvec3 o = table_.view(t, p);
  const Slice slice = sample_slice(brdf_, o, options_.nodes_per_axis, rotation_);
  lift_above_horizon(start);
  RefinementOptions refinement;
  refinement.max_iterations = max_iterations;
  refinement.weight_floor = options_.em.weight_floor;
  refinement.kappa_max = options_.em.kappa_max;
  refinement.mirrors = mirrors;
  refinement.progress = &progress_;
  const RefinementResult result = refine(slice, std::move(start), refinement);
  table_.set_mixture_at_view(t, p, result.mixture);
  if (table_.has_second_texels()) {
    std::vector<double> weights;
    for (const Lobe& lobe : result.mixture) weights.push_back(lobe.weight);
    table_.set_channel_weights_at_view(
        t, p,
        channel_weights(channel_node_weights(brdf_, o, slice),
                        drawn_log_densities(slice, result.mixture), weights));
  }
  const auto view = static_cast<std::size_t>(p * elevations() + t);
  report_.iterations[view] += result.iterations;
  if (!result.log_likelihood.empty()) report_.log_likelihood[view] = result.log_likelihood.back();
  count_fit();
}

void TableFit::count_fit() {
  const std::lock_guard<std::mutex> lock(finished_mutex_);
  ++finished_;
  progress_.set(static_cast<double>(finished_) / fits_);
}

void TableFit::fit_independently() {
  parallel_for(report_.iterations.size(), recipe_.threads, [this](std::size_t view) {
    const int t = static_cast<int>(view) % elevations();
    const int p = static_cast<int>(view) / elevations();
    fit_view(t, p, {}, {}, options_.em.max_iterations);
    if (recipe_.refine) {
      refine_view(t, p, table_.mixture_at_view(t, p), {}, options_.refinement_iterations);
    }
  });
}

// The neighbour's lobes in half-vector form, read at this view.
Mixture transport(const Mixture& from, const glm::dvec3& from_view, const glm::dvec3& to_view) {
  Mixture to = from;
  for (Lobe& lobe : to) {
    lobe.gaussian = from_half_vector(to_half_vector(lobe.gaussian, from_view), to_view);
  }
  return to;
}

void TableFit::fit_by_continuation() {
  options_.em.longest_step = std::min(options_.em.longest_step, kContinuationStep);
  // Normal incidence is symmetric in both planes; the planes that count are those that the table is
  // mirrored in and, for isotropic ones, the plane of incidence.
  const Slice slice = sample_slice(brdf_, table_.view(0, 0), options_.nodes_per_axis, rotation_);
  Mixture start = initial_guess(slice, recipe_.lobes);
  std::vector<Mirror> mirrors;
  if (options_.keep_mirror_symmetry) {
    mirrors.push_back(match_images(start, 1));
    if (azimuths() > 1) mirrors.push_back(match_images(start, 0));
  }
  const Mixture pole = fit_view(0, 0, std::move(start), mirrors, options_.em.max_iterations);

  parallel_for(static_cast<std::size_t>(azimuths()), recipe_.threads,
               [&](std::size_t p) { fit_column(static_cast<int>(p), pole, mirrors); });
}

void TableFit::fit_column(int p, const Mixture& pole, const std::vector<Mirror>& pole_mirrors) {
  if (p > 0) {
    // At the pole all azimuths are one view.
    table_.set_mixture_at_view(0, p, pole);
    if (table_.has_second_texels()) {
      table_.set_channel_weights_at_view(0, p, table_.channel_weights_at_view(0, 0));
    }
    report_.log_likelihood[static_cast<std::size_t>(p * elevations())] = report_.log_likelihood[0];
    count_fit();
  }
  // The columns at the ends of the quadrant lie in a plane of symmetry: y = 0 and x = 0.
  std::optional<MovingMirror> mirror;
  for (const Mirror& candidate : pole_mirrors) {
    const int column = candidate.axis == 1 ? 0 : azimuths() - 1;
    if (p == column) mirror.emplace(candidate);
  }
  std::vector<std::vector<Mirror>> mirrors(static_cast<std::size_t>(elevations()));
  Mixture previous = pole;
  for (int t = 1; t < elevations(); ++t) {
    Mixture start = transport(previous, table_.view(t - 1, p), table_.view(t, p));
    if (mirror) mirror->advance(start);
    lift_above_horizon(start);
    std::vector<Mirror>& ties = mirrors[static_cast<std::size_t>(t)];
    if (mirror) ties = mirror->mirrors();
    previous = fit_view(t, p, std::move(start), ties, options_.em.max_iterations);
  }
  smooth_column(p, mirrors);
  if (!recipe_.refine) return;
  mirrors[0] = pole_mirrors;
  refine_column(p, mirrors);
}

void TableFit::smooth_column(int p, const std::vector<std::vector<Mirror>>& mirrors) {
  for (int pass = 0; pass < options_.smoothing_passes; ++pass) {
    for (const int t : smoothing_order(elevations())) {
      Mixture start = table_.smoothed_mixture_at_view(t, p);
      lift_above_horizon(start);
      fit_view(t, p, std::move(start), mirrors[static_cast<std::size_t>(t)],
               std::min(kSmoothingIterations, options_.em.max_iterations));
    }
  }
}

void TableFit::refine_column(int p, const std::vector<std::vector<Mirror>>& mirrors) {
  // The lobes at the pole are the same in every column; they are refined anew for each, with the
  // same result.
  for (int t = 0; t < elevations(); ++t) {
    refine_view(t, p, table_.mixture_at_view(t, p), mirrors[static_cast<std::size_t>(t)],
                options_.refinement_iterations);
  }
  // Views part on the way, and tables would gain less between views than at them.
  for (const int t : smoothing_order(elevations())) {
    refine_view(t, p, table_.smoothed_mixture_at_view(t, p), mirrors[static_cast<std::size_t>(t)],
                options_.refinement_iterations / 2);
  }
}

}  // namespace

std::vector<int> smoothing_order(int elevations) {
  std::vector<int> order;
  for (const int first : {1, 2}) {
    for (int t = first; t < elevations - 1; t += 2) order.push_back(t);
  }
  return order;
}

void lift_above_horizon(Mixture& mixture) {
  constexpr double kMinHeight = 1e-3;
  for (Lobe& lobe : mixture) {
    lobe.gaussian.mean.z = std::max(lobe.gaussian.mean.z, kMinHeight);
    lobe.gaussian.mean = glm::normalize(lobe.gaussian.mean);
  }
}

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

// What does not depend on the BRDF.
void validate_counts(const Recipe& recipe) {
  std::ostringstream sentence;
  if (recipe.lobes < 1 || recipe.lobes > kMaxLobes) {
    sentence << "lobes is " << recipe.lobes << ", but must be between 1 and " << kMaxLobes << ".";
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

// What does.
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
  if (is_measured_file(recipe.brdf)) return;
  const auto brdf = make_brdf(recipe.brdf, recipe.alpha);  // refuses unknown names, widths
  validate_material(recipe, brdf->alpha(), brdf->is_isotropic());
}

LobeTable fit_table(const Brdf& brdf, const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options) {
  validate_counts(recipe);
  validate_material(recipe, brdf.alpha(), brdf.is_isotropic());
  const auto start = std::chrono::steady_clock::now();
  FitReport own;
  FitReport& used = report ? *report : own;
  used = {};
  LobeTable table = TableFit(brdf, recipe, options, progress, used).run();
  used.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return table;
}

LobeTable fit_table(const Recipe& recipe, Progress& progress, FitReport* report,
                    const FitOptions& options) {
  validate(recipe);
  return fit_table(*make_brdf(recipe.brdf, recipe.alpha), recipe, progress, report, options);
}

}  // namespace lobelight
