// Time, memory and error of table fitting.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>

#include "fit/table_fitter.h"

using namespace lobelight;

namespace {

// ∫ |m − f| / ∫ f for a mixture with the slice's mass: 2 ∫ max(0, f − m), which needs nodes only
// where f is.
double l1_error(const Brdf& brdf, const glm::dvec3& o, Mixture m, int nodes = 96) {
  const Slice s = sample_slice(brdf, o, nodes);
  const double scale = s.albedo / total_weight(m);
  double sum = 0;
  for (std::size_t n = 0; n < s.directions.size(); ++n) {
    const glm::dvec3& i = s.directions[n];
    const double f = brdf.evaluate(i, o) * i.z;
    sum += s.weights[n] * std::max(0.0, 1.0 - scale * evaluate(m, i) / f);
  }
  return 2 * sum / s.albedo;
}

struct Errors { double mean = 0, worst = 0; };

void add(Errors& e, double v, int n) { e.mean += v / n; e.worst = std::max(e.worst, v); }

glm::dvec3 direction(double elevation, double azimuth) {
  return {std::sin(elevation) * std::cos(azimuth), std::sin(elevation) * std::sin(azimuth), std::cos(elevation)};
}

}  // namespace

int main(int argc, char** argv) {
  struct Case { const char* brdf; glm::dvec2 alpha; };
  const Case cases[] = {{"ward", {0.01, 0.01}}, {"ward", {0.1, 0.1}}, {"ward", {0.2, 0.2}}, {"ward", {0.05, 0.2}}, {"ward", {0.05, 0.5}}, {"ward", {0.01, 0.2}}, {"ggx", {0.1, 0.1}}, {"ggx", {0.05, 0.2}}};
  int lobes = argc > 1 ? std::atoi(argv[1]) : 8;
  int iters = argc > 2 ? std::atoi(argv[2]) : 200;
  double tol = argc > 3 ? std::atof(argv[3]) : 1e-7;
  int only = argc > 4 ? std::atoi(argv[4]) : -1;
  int T = argc > 5 ? std::atoi(argv[5]) : 0, P = argc > 6 ? std::atoi(argv[6]) : 0;
  for (int c = 0; c < 8; ++c) {
    if (only >= 0 && c != only) continue;
    for (int mode = 0; mode < 3; ++mode) {  // independent, continuation, continuation+mirror
      Recipe r; r.brdf = cases[c].brdf; r.alpha = cases[c].alpha; r.lobes = lobes;
      r.views = {T, P}; if (r.alpha.x == r.alpha.y) r.views.y = 0;
      r.method = mode == 0 ? FitMethod::independent : FitMethod::continuation;
      FitOptions options; options.em.max_iterations = iters; options.em.tolerance = tol; options.keep_mirror_symmetry = mode == 2;
      Progress progress; FitReport report;
      const LobeTable table = fit_table(r, progress, &report, options);
      const auto brdf = make_brdf(r.brdf, r.alpha);
      Errors on, off; double ll = 0; double it = 0;
      const int TT = table.views().x, PP = table.views().y;
      for (int p = 0; p < PP; ++p) for (int t = 0; t < TT; ++t) add(on, l1_error(*brdf, table.view(t, p), table.mixture_at_view(t, p), 48), TT * PP);
      const int offn = (TT - 1) * std::max(1, PP - 1);
      for (int p = 0; p < std::max(1, PP - 1); ++p) for (int t = 0; t + 1 < TT; ++t) {
        const double e = (t + 0.5) / (TT - 1) * LobeTable::kMaxElevation;
        const double a = PP == 1 ? 0 : (p + 0.5) / (PP - 1) * 1.5707963267948966;
        const glm::dvec3 o = direction(e, a);
        Mixture m;
        if (mode == 0) m = table.interpolate(direction(t * LobeTable::kMaxElevation / (TT - 1), PP == 1 ? 0 : p * 1.5707963267948966 / (PP - 1)));
        else m = table.interpolate(o);
        add(off, l1_error(*brdf, o, m, 48), offn);
      }
      for (double v : report.log_likelihood) ll += v / (double)report.log_likelihood.size();
      for (int v : report.iterations) it += v / (double)report.iterations.size();
      rusage u; getrusage(RUSAGE_SELF, &u);
      std::printf("%s (%g,%g) K%d %dx%d %-12s %.2fs it %.0f max %d ll %.5f on %.4f/%.4f off %.4f/%.4f rss %ld\n", r.brdf.c_str(), r.alpha.x, r.alpha.y, lobes, TT, PP,
                  mode == 0 ? "independent" : mode == 1 ? "continuation" : "cont+mirror", report.seconds, it, *std::max_element(report.iterations.begin(), report.iterations.end()), ll, on.mean, on.worst, off.mean, off.worst, u.ru_maxrss / 1024);
      std::fflush(stdout);
    }
  }
}
