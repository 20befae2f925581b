#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/pi.h"
#include "fit/mirror.h"
#include "fit/placement.h"
#include "fit/table_fitter.h"
#include "image/synthetic_panorama.h"
#include "reference/gaussian_convolution.h"
#include "reference/sphere_renderer.h"
#include "reference/table_renderer.h"

namespace lobelight {
namespace {

Recipe long_recipe(const char* brdf, Placement placement) {
  Recipe recipe;
  recipe.brdf = brdf;
  recipe.alpha = {0.015, 0.3};
  recipe.lobes = 7;
  recipe.views = {6, 4};
  recipe.placement = placement;
  return recipe;
}

LobeTable fit(const Recipe& recipe, FitReport* report = nullptr) {
  Progress progress;
  return fit_table(recipe, progress, report);
}

// Ward's lobes in closed form for one view, without integrals over the slice: slopes are a Gaussian
// along the long axis of what the mirror makes of a circle, each lobe has the model's weight at its
// own half-vector (the addon's comparators/line_lobes.gd and closed_form.gdshaderinc).
Mixture closed_form(const glm::dvec2& alpha, const glm::dvec3& o, int lobes) {
  constexpr double kReach = 1.556;
  constexpr int kSteps = 8192;
  const double step = 2.0 * kReach / kSteps;
  const auto density = [](double t) { return std::exp(-t * t) / std::sqrt(kPi); };
  double whole = 0.0;
  for (int i = 0; i < kSteps; ++i) whole += std::pow(density((i + 0.5) * step - kReach), 0.15);
  std::vector<double> mass(static_cast<std::size_t>(lobes)), place(mass.size());
  double reached = 0.0;
  double all = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step - kReach;
    const auto cell =
        static_cast<std::size_t>(std::min(static_cast<int>(reached / whole * lobes), lobes - 1));
    reached += std::pow(density(t), 0.15);
    mass[cell] += density(t) * step;
    place[cell] += density(t) * step * t;
    all += density(t) * step;
  }
  double of_points = 0.0;
  for (std::size_t k = 0; k < mass.size(); ++k) {
    place[k] /= mass[k];
    of_points += mass[k] / all * place[k] * place[k];
  }
  const double xx = alpha.x * alpha.x * (o.x * o.x + o.z * o.z);
  const double yy = alpha.y * alpha.y * (o.y * o.y + o.z * o.z);
  const double xy = alpha.x * alpha.y * o.x * o.y;
  const double half = 0.5 * (xx - yy);
  const double root = std::hypot(half, xy);
  const glm::dvec2 along =
      half >= 0.0 ? glm::dvec2(root + half + 1e-12, xy) : glm::dvec2(xy, root - half);
  const glm::dvec2 axis = glm::normalize(along) * alpha;
  const double longest = 0.5 * (xx + yy) + root;
  const double ratio = std::pow(alpha.x * alpha.y * o.z / longest, 2.0);
  const double gap = 0.5 * (place.back() - place.front()) / (lobes - 1) / std::sqrt(0.5);
  const double width = std::max(ratio, std::pow(ratio, 0.7) * std::pow(gap * gap, 0.3));
  const double stretch = std::sqrt(0.5 / of_points * std::max(1.0 - width, 0.0));
  Mixture mixture;
  for (std::size_t k = 0; k < mass.size(); ++k) {
    const glm::dvec3 h = glm::normalize(glm::dvec3(stretch * place[k] * axis, 1.0));
    const double cosine = std::max(glm::dot(o, h), 1e-4);
    glm::dvec3 mean = 2.0 * cosine * h - o;
    mean.z = std::max(mean.z, 1e-3);
    mean = glm::normalize(mean);
    const double across = cosine * h.z / o.z;
    mixture.push_back({mass[k] / all * h.z * h.z * h.z * cosine * std::sqrt(mean.z / o.z),
                       {mean, 1.0 / (4.0 * width * longest * 0.5 * across * across)}});
  }
  return mixture;
}

TEST_CASE(
    "Long highlights are drawn no worse than by either placement and by lobes in closed form") {
  // A light that no placement is chosen by.
  constexpr int kSize = 32;
  const glm::dvec2 alpha(0.01, 0.2);
  const GaussianConvolution light(synthetic_panorama());
  Progress progress;
  SphereOptions options;
  options.size = kSize;
  options.samples = 512;
  const auto reference =
      render_sphere(synthetic_panorama(), *make_brdf("ward", alpha), options, progress).radiance;
  const auto psnr = [&](const LobeTable& table) {
    return sphere_psnr(render_table(light, table, kSize, 0, progress), reference, kSize);
  };
  for (const int lobes : {8, 16}) {
    Recipe recipe;
    recipe.alpha = alpha;
    recipe.lobes = lobes;
    FitReport report;
    const double best = psnr(fit(recipe, &report));
    recipe.placement = Placement::em;
    const double em = psnr(fit(recipe));
    LobeTable closed(alpha, lobes, {16, 8});
    for (int p = 0; p < 8; ++p) {
      for (int t = 0; t < 16; ++t) {
        closed.set_mixture_at_view(t, p, closed_form(alpha, closed.view(t, p), lobes));
      }
    }
    CAPTURE(lobes);
    CHECK(report.arc_reach > 0.0);
    CHECK(best > em + 1.0);
    CHECK(best > psnr(closed));
  }
}

TEST_CASE(
    "What is not long or has few lobes is EM's to the last bit, and so are independent fits") {
  struct Case {
    glm::dvec2 alpha;
    int lobes;
  };
  for (const Case& of :
       {Case{{0.1, 0.1}, 7}, Case{{0.02, 0.3}, 8}, Case{{0.01, 0.2}, 7}, Case{{0.005, 0.5}, 10}}) {
    for (const FitMethod method : {FitMethod::independent, FitMethod::continuation}) {
      Recipe recipe = long_recipe("ward", Placement::automatic);
      recipe.alpha = of.alpha;
      recipe.lobes = of.lobes;
      recipe.method = method;
      recipe.views.y = of.alpha.x == of.alpha.y ? 1 : 4;
      const auto automatic = fit(recipe).to_rgba16f();
      recipe.placement = Placement::em;
      CHECK(fit(recipe).to_rgba16f() == automatic);
    }
  }
}

TEST_CASE("Arcs have the energy of their views, whatever the model") {
  for (const char* brdf : {"ward", "ward_bounded", "ggx"}) {
    FitReport report;
    const LobeTable table = fit(long_recipe(brdf, Placement::arc), &report);
    const auto model = make_brdf(brdf, table.alpha());
    CHECK(report.arc_reach > 0.0);
    for (int p = 0; p < 4; ++p) {
      for (int t = 0; t < 6; ++t) {
        CAPTURE(brdf);
        CAPTURE(t);
        CAPTURE(p);
        const double albedo = sample_slice(*model, table.view(t, p), 256).albedo;
        const Mixture lobes = table.mixture_at_view(t, p);
        CHECK(total_weight(lobes) == doctest::Approx(albedo).epsilon(0.01));
        for (const Lobe& lobe : lobes) CHECK(lobe.gaussian.mean.z > 0.0);
        CHECK(std::isfinite(report.log_likelihood[static_cast<std::size_t>(p * 6 + t)]));
      }
    }
  }
}

TEST_CASE("Arcs all of whose points would lie below the horizon lose no light") {
  Recipe recipe = long_recipe("ggx", Placement::arc);
  recipe.alpha = {2.0, 0.3};
  recipe.lobes = 2;
  recipe.reach = 12.0;
  const auto model = make_brdf("ggx", recipe.alpha);
  const LobeTable table = fit(recipe);
  const double albedo = sample_slice(*model, table.view(0, 0), 256).albedo;
  CHECK(total_weight(table.mixture_at_view(0, 0)) == doctest::Approx(albedo).epsilon(0.01));
}

TEST_CASE("Arcs do not depend on the threads, and reach as far as they are told") {
  for (const Placement placement : {Placement::automatic, Placement::arc}) {
    Recipe recipe = long_recipe("ggx", placement);
    recipe.lobes = 8;
    recipe.threads = 1;
    const auto one = fit(recipe).to_rgba16f();
    recipe.threads = 3;
    CHECK(fit(recipe).to_rgba16f() == one);
  }
  Recipe recipe = long_recipe("ward", Placement::arc);
  std::vector<double> farthest;
  for (const double reach : {1.2, 2.4}) {
    recipe.reach = reach;
    FitReport report;
    const LobeTable table = fit(recipe, &report);
    CHECK(report.arc_reach == reach);
    farthest.push_back(std::abs(table.entry(0, 0, 0).y));
    CHECK(farthest.back() < reach);
  }
  CHECK(farthest[1] > 1.3 * farthest[0]);
}

TEST_CASE("Arcs have no seam where tables are mirrored, and one pole") {
  const LobeTable table = fit(long_recipe("ward", Placement::arc));
  for (int p = 1; p < 4; ++p) {
    for (int k = 0; k < table.lobes(); ++k) CHECK(table.entry(k, 0, p) == table.entry(k, 0, 0));
  }
  for (const int column : {0, 3}) {
    const int axis = column == 0 ? 1 : 0;
    for (int t = 0; t < 6; ++t) {
      const Mixture lobes = table.mixture_at_view(t, column);
      for (const Lobe& lobe : lobes) {
        const glm::dvec3 image = reflected(lobe.gaussian.mean, axis);
        CHECK(evaluate(lobes, image) ==
              doctest::Approx(evaluate(lobes, lobe.gaussian.mean)).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("Placements that cannot be are refused by a sentence") {
  const auto message = [](const Recipe& recipe) {
    try {
      validate(recipe);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(message(long_recipe("ggx", Placement::arc)).empty());
  Recipe recipe = long_recipe("charlie", Placement::arc);
  recipe.alpha = {0.2, 0.2};
  CHECK(message(recipe) ==
        "placement is \"arc\", but charlie of the widths (0.2, 0.2) has no long highlight.");
  recipe = long_recipe("ward", Placement::arc);
  recipe.method = FitMethod::independent;
  CHECK(message(recipe) == "placement is \"arc\", which goes with method \"continuation\" only.");
  recipe = long_recipe("ward", Placement::arc);
  recipe.refine = true;
  CHECK(message(recipe) == "placement is \"arc\", whose lobes cannot be refined.");
  recipe = long_recipe("ward", Placement::em);
  recipe.reach = 2.0;
  CHECK(message(recipe) == "reach is 2, but placement \"em\" has none.");
  recipe = long_recipe("ward", Placement::automatic);
  recipe.reach = -1.0;
  CHECK(message(recipe) == "reach is -1, but must be between 0.5 and 32, or 0 for the best one.");
  CHECK_THROWS_AS(placement_from_string("line"), std::invalid_argument);
}

}  // namespace
}  // namespace lobelight
