#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "brdf/ggx.h"
#include "fit/table_fitter.h"
#include "image/synthetic_panorama.h"
#include "reference/sphere_renderer.h"
#include "reference/table_renderer.h"
#include "tinted_brdf.h"

using namespace lobelight;
using lobelight::testing::Tinted;

namespace {

// ∫ L g by many nodes of equal mass, straight from the panorama.
glm::dvec3 brute_force(const Panorama& panorama, const SphericalGaussian& gaussian) {
  constexpr int kNodes = 1 << 18;
  glm::dvec3 sum(0.0);
  for (int n = 0; n < kNodes; ++n) {
    const double turned = n * 0.61803398874989484820;
    sum += panorama.sample(sample(gaussian, {(n + 0.5) / kNodes, turned - std::floor(turned)}));
  }
  return sum / static_cast<double>(kNodes);
}

}  // namespace

TEST_CASE("the synthetic panorama has the range that it promises") {
  const Panorama panorama = synthetic_panorama();
  std::vector<float> green;
  for (std::size_t n = 1; n < panorama.rgb.size(); n += 3) green.push_back(panorama.rgb[n]);
  CHECK(panorama.rgb.size() == 3u * 256u * 128u);
  std::sort(green.begin(), green.end());
  const double ratio = green.back() / green[green.size() / 2];
  CHECK(ratio > 5e4);
  CHECK(ratio < 7e4);
}

TEST_CASE("lobes of all sharpnesses see the light that brute force finds") {
  const Panorama panorama = synthetic_panorama();
  const GaussianConvolution light(panorama);
  // The wall, the brightest light's rim and centre, near a pole, and the wrap of the columns.
  const glm::dvec2 places[] = {{0.3, 0.55}, {0.89, 0.155}, {0.89, 0.17}, {0.2, 0.01}, {0.0, 0.3}};
  for (const glm::dvec2& place : places) {
    for (const double kappa : {0.5, 5.0, 50.0, 500.0, 3e3, 3e4, 1e6}) {
      const SphericalGaussian gaussian{panorama_direction(place), kappa};
      const double found = light.convolve(gaussian).g;
      const double expected = brute_force(panorama, gaussian).g;
      CAPTURE(place.x);
      CAPTURE(place.y);
      CAPTURE(kappa);
      // At the rim of a light 6 · 10⁴ times its surroundings a tenth of a texel is a few per cent.
      CHECK(found == doctest::Approx(expected).epsilon(0.05));
    }
  }
}

TEST_CASE("a constant panorama shows a table's albedo") {
  Panorama panorama;
  panorama.width = 32;
  panorama.height = 16;
  panorama.rgb.assign(3 * 32 * 16, 2.0f);
  Recipe recipe;
  recipe.lobes = 2;
  recipe.views = {6, 1};
  Progress progress;
  const LobeTable table = fit_table(recipe, progress, nullptr);
  const std::vector<float> picture =
      render_table(GaussianConvolution(panorama), table, 8, 2, progress);
  const auto frame = sphere_frame(5, 2, 8);
  REQUIRE(frame);
  const glm::dvec3 o(frame->tangent.z, frame->bitangent.z, frame->normal.z);
  CHECK(picture[3 * (2 * 8 + 5)] ==
        doctest::Approx(2.0 * total_weight(table.interpolate(o))).epsilon(1e-5));
  CHECK(picture[0] == 0.0f);
  CHECK(picture == render_table(GaussianConvolution(panorama), table, 8, 1, progress));
}

TEST_CASE("more lobes come nearer to the reference") {
  const Panorama panorama = synthetic_panorama();
  const GaussianConvolution light(panorama);
  const auto brdf = make_brdf("ward", {0.15, 0.15});
  SphereOptions options;
  options.size = 16;
  options.samples = 256;
  Progress progress;
  const std::vector<float> reference = render_sphere(panorama, *brdf, options, progress).radiance;
  double before = 0.0;
  for (const int lobes : {1, 3, 8}) {
    Recipe recipe;
    recipe.alpha = {0.15, 0.15};
    recipe.lobes = lobes;
    const LobeTable table = fit_table(*brdf, recipe, progress, nullptr);
    const double psnr = sphere_psnr(render_table(light, table, 16, 0, progress), reference, 16);
    CHECK(psnr > before + 3.0);
    before = psnr;
  }
  CHECK(before > 36.0);
}

TEST_CASE("a coloured table is judged by its colours") {
  const Panorama panorama = synthetic_panorama();
  const GaussianConvolution light(panorama);
  SphereOptions options;
  options.size = 16;
  options.samples = 256;
  Recipe recipe;
  recipe.lobes = 8;
  recipe.views = {8, 1};
  const auto psnr = [&](const Brdf& brdf) {
    Progress progress;
    const LobeTable table = fit_table(brdf, recipe, progress, nullptr);
    const auto reference = render_sphere(panorama, brdf, options, progress).radiance;
    return sphere_psnr(render_table(light, table, 16, 0, progress), reference, 16);
  };
  const glm::dvec2 alpha(0.3);
  const double grey = psnr(Ggx(alpha));
  CHECK(grey > 30.0);
  // Exposure goes by the picture's own median, so that a tint costs next to nothing.
  CHECK(psnr(Tinted(alpha, {0.9, 0.45, 0.1})) > grey - 3.0);
}

TEST_CASE("the error of two pictures is the contract's") {
  const int size = 8;
  const std::vector<float> reference(3 * size * size, 0.5f);
  CHECK(sphere_psnr(reference, reference, size) == std::numeric_limits<double>::infinity());
  // 0.5 is shown as 0.18^(1/2.2), twice as much as 0.36^(1/2.2).
  const std::vector<float> twice(3 * size * size, 1.0f);
  const double step = std::pow(0.36, 1.0 / 2.2) - std::pow(0.18, 1.0 / 2.2);
  CHECK(sphere_psnr(twice, reference, size) == doctest::Approx(-20.0 * std::log10(step)));
  // What is brighter than white is white.
  const std::vector<float> bright(3 * size * size, 1e4f);
  CHECK(sphere_psnr(bright, reference, size) ==
        doctest::Approx(-20.0 * std::log10(1.0 - std::pow(0.18, 1.0 / 2.2))));
  const std::vector<float> black(3 * size * size, 0.0f);
  CHECK_THROWS_AS(sphere_psnr(reference, black, size), std::invalid_argument);
  std::vector<float> broken = reference;
  broken[3 * (4 * size + 4)] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_AS(sphere_psnr(broken, reference, size), std::invalid_argument);
}
