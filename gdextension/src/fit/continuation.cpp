#include "fit/continuation.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "fit/initial_guess.h"
#include "table/half_vector.h"

namespace lobelight {

namespace {

// The lobes of view `from_view` with the same half-vector form at `to_view`.
Mixture transport(const Mixture& from, const glm::dvec3& from_view, const glm::dvec3& to_view) {
  Mixture to = from;
  for (Lobe& lobe : to) {
    lobe.gaussian = from_half_vector(to_half_vector(lobe.gaussian, from_view), to_view);
  }
  return to;
}

// The inner views of a column in the order of smoothing: every second one, then the others.
std::vector<int> smoothing_order(int elevations) {
  std::vector<int> order;
  for (const int first : {1, 2}) {
    for (int t = first; t < elevations - 1; t += 2) order.push_back(t);
  }
  return order;
}

FitOptions with_short_steps(FitOptions options) {
  options.em.longest_step = std::min(options.em.longest_step, kContinuationStep);
  return options;
}

int count_fits(const Continuation& how, const glm::ivec2& views) {
  const int inner = (views.x - 2) * views.y;
  const int without_pole = (views.x - 1) * views.y;
  const int fits = 1 + without_pole + how.options.smoothing_passes * inner;
  return how.refine ? fits + 1 + without_pole + inner : fits;
}

// The fit of one table. At the pole all azimuths are the same view: it is fitted once and copied to
// each column, so that no column reads what another writes.
class Columns {
 public:
  Columns(const Continuation& how, const ColumnStarts& starts, LobeTable& table, Progress& progress,
          FitReport* report)
      : how_(how),
        starts_(starts),
        table_(table),
        fitter_(how.brdf, table, with_short_steps(how.options), how.seed,
                count_fits(how, table.views()), progress, report),
        progress_(progress),
        report_(report) {}

  void fit(Mixture pole);

 private:
  void fit_pole(Mixture start);
  void fit_column(int p);
  void smooth(int p, const std::vector<std::vector<Mirror>>& mirrors);
  void refine(int p, const std::vector<std::vector<Mirror>>& mirrors);

  const Continuation& how_;
  const ColumnStarts& starts_;
  LobeTable& table_;
  ViewFitter fitter_;
  Progress& progress_;
  FitReport* report_;
  std::vector<Mirror> pole_mirrors_;
  Mixture pole_lobes_;            // as they were fitted
  LobeTable::View pole_;          // as they are stored
  LobeTable::View refined_pole_;  // with `refine`
};

void Columns::fit(Mixture pole) {
  fit_pole(std::move(pole));
  parallel_for(static_cast<std::size_t>(table_.views().y), how_.threads, progress_,
               [&](std::size_t p) { fit_column(static_cast<int>(p)); });
}

void Columns::fit_pole(Mixture start) {
  // At normal incidence the slice is symmetric in both planes. Anisotropic tables are mirrored in
  // both, so their lobes are tied in both; in isotropic ones only y = 0, the plane of incidence,
  // matters.
  if (start.empty()) start = initial_guess(fitter_.slice(0, 0), table_.lobes());
  const glm::ivec2 views = table_.views();
  pole_mirrors_.push_back(match_images(start, 1));
  if (views.y > 1) pole_mirrors_.push_back(match_images(start, 0));
  pole_lobes_ = fitter_.fit(0, 0, std::move(start), pole_mirrors_, how_.options.em.max_iterations);
  pole_ = table_.stored_view(0, 0);
  if (how_.refine) {
    fitter_.refine(0, 0, table_.mixture_at_view(0, 0), pole_mirrors_,
                   how_.options.refinement_iterations);
    refined_pole_ = table_.stored_view(0, 0);
  }
  for (int p = 1; report_ && p < views.y; ++p) {
    report_->log_likelihood[static_cast<std::size_t>(p * views.x)] = report_->log_likelihood[0];
  }
}

void Columns::fit_column(int p) {
  table_.store_view(0, p, pole_);
  const NextStart next = starts_(p, pole_mirrors_);
  const int elevations = table_.views().x;
  std::vector<std::vector<Mirror>> mirrors(static_cast<std::size_t>(elevations));
  Mixture previous = pole_lobes_;
  for (int t = 1; t < elevations; ++t) {
    ViewStart start = next(t, previous);
    lift_above_horizon(start.lobes);
    std::vector<Mirror>& ties = mirrors[static_cast<std::size_t>(t)];
    ties = std::move(start.mirrors);
    previous = fitter_.fit(t, p, std::move(start.lobes), ties, how_.options.em.max_iterations);
  }
  smooth(p, mirrors);
  if (how_.refine) refine(p, mirrors);
}

void Columns::smooth(int p, const std::vector<std::vector<Mirror>>& mirrors) {
  for (int pass = 0; pass < how_.options.smoothing_passes; ++pass) {
    for (const int t : smoothing_order(table_.views().x)) {
      Mixture start = table_.smoothed_mixture_at_view(t, p);
      lift_above_horizon(start);
      fitter_.fit(t, p, std::move(start), mirrors[static_cast<std::size_t>(t)],
                  std::min(kSmoothingIterations, how_.options.em.max_iterations));
    }
  }
}

void Columns::refine(int p, const std::vector<std::vector<Mirror>>& mirrors) {
  const int elevations = table_.views().x;
  const int iterations = how_.options.refinement_iterations;
  table_.store_view(0, p, refined_pole_);
  for (int t = 1; t < elevations; ++t) {
    fitter_.refine(t, p, table_.mixture_at_view(t, p), mirrors[static_cast<std::size_t>(t)],
                   iterations);
  }
  // Views refined one by one drift apart, which costs accuracy between them: smooth them again.
  for (const int t : smoothing_order(elevations)) {
    fitter_.refine(t, p, table_.smoothed_mixture_at_view(t, p),
                   mirrors[static_cast<std::size_t>(t)], iterations / 2);
  }
}

}  // namespace

ColumnStarts neighbours_lobes(const LobeTable& table) {
  return [&table](int p, const std::vector<Mirror>& pole_mirrors) -> NextStart {
    // The first and the last column lie in a plane of symmetry, y = 0 and x = 0.
    std::optional<MovingMirror> mirror;
    for (const Mirror& candidate : pole_mirrors) {
      const int column = candidate.axis == 1 ? 0 : table.views().y - 1;
      if (p == column) mirror.emplace(candidate);
    }
    return [&table, p, mirror](int t, const Mixture& previous) mutable {
      ViewStart start{transport(previous, table.view(t - 1, p), table.view(t, p)), {}};
      if (mirror) {
        mirror->advance(start.lobes);
        start.mirrors = mirror->mirrors();
      }
      return start;
    };
  };
}

void continue_over_views(const Continuation& how, Mixture pole, const ColumnStarts& starts,
                         LobeTable& table, Progress& progress, FitReport* report) {
  Columns(how, starts, table, progress, report).fit(std::move(pole));
}

void lift_above_horizon(Mixture& mixture) {
  constexpr double kMinHeight = 1e-3;
  for (Lobe& lobe : mixture) {
    lobe.gaussian.mean.z = std::max(lobe.gaussian.mean.z, kMinHeight);
    lobe.gaussian.mean = glm::normalize(lobe.gaussian.mean);
  }
}

}  // namespace lobelight
