// What a bake makes of everything that it can be given, and how soon it stops: materials (models,
// MERL, coloured RGL) × ways (plain, refined, counted, sets) × threads.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "base/pi.h"
#include "brdf/brdf.h"
#include "fit/slice.h"
#include "measured_files.h"
#include "table/half_float.h"
#include "watched_progress.h"

namespace lobelight {
namespace {

using testing::kPrompt;
using testing::TemporaryFile;
using testing::WatchedProgress;

// GGX with a colour in the MERL file; red and blue of different widths in the RGL file, which no
// tint of one lobe amounts to.
glm::dvec3 coloured(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha) {
  const auto sharp = make_brdf("ggx", alpha);
  const auto wide = make_brdf("ggx", 2.0 * alpha);
  return {0.9 * sharp->evaluate(i, o), 0.5 * sharp->evaluate(i, o), 0.8 * wide->evaluate(i, o)};
}

struct Materials {
  TemporaryFile merl{".binary"};
  TemporaryFile rgl{".bsdf"};

  Materials() {
    merl.write(testing::merl_file(
        [](const glm::dvec3& i, const glm::dvec3& o) { return coloured(i, o, glm::dvec2(0.25)); }));
    testing::RglRecipe recipe;
    recipe.alpha = {0.2, 0.35};
    recipe.reflectance = [](const glm::dvec3& i, const glm::dvec3& o) {
      return coloured(i, o, {0.2, 0.35});
    };
    recipe.azimuths.clear();
    for (int p = -2; p <= 2; ++p) recipe.azimuths.push_back(0.5 * kPi * p);
    for (int t = 0; t <= 4; ++t) recipe.elevations.push_back(t * 0.37);
    recipe.resolution = 16;
    rgl.write(testing::rgl_file(recipe));
  }

  std::vector<Recipe> recipes() const {
    std::vector<Recipe> all(3);
    all[0].brdf = "ward_bounded";
    all[0].alpha = {0.1, 0.3};
    all[1].brdf = merl.path();
    all[1].alpha = {0.0, 0.0};
    all[2].brdf = rgl.path();
    all[2].alpha = {0.0, 0.0};
    for (Recipe& recipe : all) {
      recipe.lobes = 3;
      recipe.views = {3, recipe.brdf == merl.path() ? 1 : 3};
    }
    return all;
  }
};

const Materials& materials() {
  static const Materials all;
  return all;
}

// Coarse, so that the whole product takes seconds.
LobeCountOptions coarse() {
  LobeCountOptions options;
  options.size = 6;
  options.samples = 64;
  options.fit.nodes_per_axis = 32;
  return options;
}

enum class Way { plain, refined, counted };

TableRequest request_of(const Recipe& recipe, Way way) {
  TableRequest request{recipe, {}};
  request.recipe.refine = way == Way::refined;
  if (way == Way::counted) {
    // One lobe does not do, and the last that is tried does.
    request.target.emplace();
    request.target->psnr = 0.5;
    request.target->max_lobes = 2;
  }
  return request;
}

void check_texels(const std::vector<std::uint16_t>& texels) {
  int broken = 0;
  for (const std::uint16_t half : texels) broken += std::isfinite(double_from_half(half)) ? 0 : 1;
  CHECK(broken == 0);
}

// What a view reflects is what its lobes weigh; no weight is negative, in any channel.
void check_energy(const LobeTable& stored, const Brdf& brdf, int nodes_per_axis) {
  for (int p = 0; p < stored.views().y; ++p) {
    for (int t = 0; t < stored.views().x; ++t) {
      CAPTURE(t);
      CAPTURE(p);
      const Slice slice = sample_slice(brdf, stored.view(t, p), nodes_per_axis);
      double sum = 0.0;
      for (const glm::dvec3& weight : stored.channel_weights_at_view(t, p)) {
        for (int channel = 0; channel < 3; ++channel) {
          CHECK(weight[channel] >= 0.0);
          sum += weight[channel] / 3.0;
        }
      }
      // Half floats.
      CHECK(sum == doctest::Approx(slice.albedo).epsilon(2e-3));
    }
  }
}

SetRecipe set_recipe() {
  SetRecipe recipe;
  recipe.brdf = "ggx";
  recipe.widths = {0.1, 0.14, 0.2};
  recipe.lobes = 2;
  recipe.views = {3, 2};
  return recipe;
}

}  // namespace

TEST_CASE("Bakes of all materials, in all ways, have the same bytes for any threads") {
  for (const Recipe& recipe : materials().recipes()) {
    const auto brdf = make_brdf(recipe.brdf, recipe.alpha);
    for (const Way way : {Way::plain, Way::refined, Way::counted}) {
      CAPTURE(recipe.brdf);
      CAPTURE(static_cast<int>(way));
      TableRequest request = request_of(recipe, way);
      std::vector<std::uint16_t> bytes;
      // Fits by themselves are looked at in fit_product_test.cpp.
      const std::vector<int> all =
          way == Way::counted ? std::vector<int>{1, 2, 8} : std::vector<int>{2};
      for (const int threads : all) {
        request.recipe.threads = threads;
        Progress progress;
        const BakedTable baked = bake_table(request, progress, coarse());
        CHECK(progress.fraction() == 1.0);
        CHECK(baked.table.has_second_texels() == brdf->is_coloured());
        CHECK(baked.errors.empty() == (way == Way::refined));
        CHECK(baked.predicted_psnr.has_value() == (way == Way::counted));
        CHECK(baked.measurements.has_value() == (recipe.brdf != "ward_bounded"));
        const std::vector<std::uint16_t> own = baked.table.to_rgba16f();
        if (bytes.empty()) {
          bytes = own;
          check_texels(own);
          const LobeTable& table = baked.table;
          check_energy(LobeTable::from_rgba16f(table.alpha(), table.lobes(), table.views(), own),
                       *brdf, coarse().fit.nodes_per_axis);
        }
        CAPTURE(threads);
        CHECK(own == bytes);
      }
    }
  }
}

TEST_CASE("A set has the same bytes for any threads, and the energy of its model") {
  SetRecipe recipe = set_recipe();
  std::vector<std::uint16_t> bytes;
  for (const int threads : {1, 2, 8}) {
    recipe.threads = threads;
    Progress progress;
    const BakedSet baked = bake_set(recipe, progress);
    CHECK(progress.fraction() == 1.0);
    if (bytes.empty()) bytes = baked.texels;
    CAPTURE(threads);
    CHECK(baked.texels == bytes);
  }
  check_texels(bytes);
  const SetLayout layout(recipe);
  for (int table = 0; table < layout.tables(); ++table) {
    const glm::ivec2 level = layout.level(table);
    const glm::dvec2 alpha(recipe.widths[static_cast<std::size_t>(level.x)],
                           recipe.widths[static_cast<std::size_t>(level.y)]);
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(layout.offset(table));
    const auto last = bytes.begin() + static_cast<std::ptrdiff_t>(layout.offset(table + 1));
    check_energy(LobeTable::from_rgba16f(alpha, recipe.lobes, layout.views(table), {first, last}),
                 *make_brdf(recipe.brdf, alpha), FitOptions().nodes_per_axis);
  }
}

namespace {

// Has `work` run to its end, and then be cancelled at times all over it: it must ask whether to go
// on all the time, and stop when it is told to.
template <class Work>
void check_cancelling(const Work& work) {
  WatchedProgress whole;
  work(whole);
  CHECK(whole.longest_gap() < kPrompt);
  REQUIRE(whole.checks() > 10);
  for (const double part : {0.05, 0.5, 0.95}) {
    CAPTURE(part);
    WatchedProgress progress(static_cast<long>(part * static_cast<double>(whole.checks() - 1)));
    CHECK_THROWS_AS(work(progress), Cancelled);
    CHECK(progress.longest_gap() < kPrompt);
  }
}

}  // namespace

TEST_CASE("Bakes of all materials, in all ways, stop soon after they are cancelled") {
  for (const Recipe& recipe : materials().recipes()) {
    for (const Way way : {Way::plain, Way::refined, Way::counted}) {
      CAPTURE(recipe.brdf);
      CAPTURE(static_cast<int>(way));
      TableRequest request = request_of(recipe, way);
      request.recipe.threads = way == Way::counted ? 8 : 2;
      check_cancelling([&](Progress& progress) { bake_table(request, progress, coarse()); });
    }
  }
}

TEST_CASE("The bake of a set stops soon after it is cancelled") {
  SetRecipe recipe = set_recipe();
  for (const int threads : {1, 8}) {
    recipe.threads = threads;
    check_cancelling([&](Progress& progress) { bake_set(recipe, progress); });
  }
}

// Full quality and the most lobes, where single views take longest; ended after a while.
template <class Work>
void check_steps(long checks, double from, const Work& work) {
  WatchedProgress progress(checks, from);
  CHECK_THROWS_AS(work(progress), Cancelled);
  CHECK(progress.longest_gap() < kPrompt);
}

// What is slower than users have it says nothing of them.
TEST_CASE("No step of the largest tables is so long that a cancelled bake would be waited for" *
          doctest::skip(!testing::kOptimised)) {
  for (const Recipe& small : materials().recipes()) {
    const bool is_file = small.brdf != "ward_bounded";
    for (const Way way : {Way::plain, Way::refined, Way::counted}) {
      CAPTURE(small.brdf);
      CAPTURE(static_cast<int>(way));
      TableRequest request = request_of(small, way);
      request.recipe.lobes = kMaxLobes;
      request.recipe.views = {16, small.views.y == 1 ? 1 : 8};
      request.recipe.threads = 2;
      LobeCountOptions options;
      // Where the tables begin.
      double from = is_file ? 0.1 : 0.0;
      if (way == Way::counted) {
        from += is_file ? 0.26 : 0.29;
        request.target->psnr = 46.0;
        request.target->max_lobes = kMaxLobes;
        options.size = 4;
        options.samples = 16;
      }
      check_steps(500, from, [&](Progress& progress) { bake_table(request, progress, options); });
    }
    // References of full quality.
    TableRequest request = request_of(small, Way::counted);
    request.recipe.threads = 2;
    check_steps(2000, 0.0, [&](Progress& progress) { bake_table(request, progress); });
  }
}

TEST_CASE("No step of the largest sets is so long that a cancelled bake would be waited for" *
          doctest::skip(!testing::kOptimised)) {
  SetRecipe recipe;
  recipe.widths = {0.1, 0.2};
  recipe.lobes = kMaxLobes;
  recipe.views = {64, 16};
  recipe.threads = 2;
  check_steps(500, 0.0, [&](Progress& progress) { bake_set(recipe, progress); });
}

}  // namespace lobelight
