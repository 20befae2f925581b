#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "brdf/brdf.h"
#include "fit/roughness_fitter.h"
#include "fit/slice.h"
#include "fit/table_fitter.h"
#include "table_errors.h"

using namespace lobelight;

namespace {

// Fitted in a fraction of a second.
SetRecipe small_set() {
  SetRecipe set;
  set.brdf = "ggx";
  set.widths = {0.1, 0.1 * std::sqrt(2.0), 0.2};
  set.lobes = 3;
  set.views = {5, 3};
  return set;
}

std::vector<std::uint16_t> fit(const SetRecipe& set) {
  Progress progress;
  return fit_table_set(set, progress);
}

// A table half-way between widths as LobeTableSet makes it: shares of tables by number.
LobeTable interpolated(const SetRecipe& set, const std::vector<std::uint16_t>& texels,
                       const std::vector<std::pair<int, double>>& shares, const glm::dvec2& alpha) {
  const SetLayout layout(set);
  const glm::ivec2 views = layout.views(shares.front().first);
  LobeTable sum(alpha, set.lobes, views);
  for (const auto& [number, share] : shares) {
    const auto first = texels.begin() + static_cast<std::ptrdiff_t>(layout.offset(number));
    const LobeTable table = LobeTable::from_rgba16f(
        alpha, set.lobes, views, {first, first + static_cast<std::ptrdiff_t>(layout.size(number))});
    for (int p = 0; p < views.y; ++p) {
      for (int t = 0; t < views.x; ++t) {
        LobeTable::View view = sum.stored_view(t, p);
        for (std::size_t k = 0; k < view.entries.size(); ++k) {
          view.entries[k] += share * table.entry(static_cast<int>(k), t, p);
        }
        sum.store_view(t, p, view);
      }
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("a layout's tables follow one another without gaps") {
  const SetRecipe set = small_set();
  const SetLayout layout(set);
  CHECK(layout.tables() == 6 + 3);
  std::size_t offset = 0;
  for (int table = 0; table < layout.tables(); ++table) {
    CHECK(layout.offset(table) == offset);
    offset += layout.size(table);
    const glm::ivec2 level = layout.level(table);
    CHECK(level.x >= level.y);
    CHECK(table == (layout.is_isotropic(table) ? layout.isotropic_table(level.x)
                                               : layout.pair_table(level.x, level.y)));
  }
  CHECK(layout.total() == offset);
}

TEST_CASE("a set is the same for any number of threads") {
  SetRecipe set = small_set();
  set.threads = 1;
  const std::vector<std::uint16_t> one = fit(set);
  set.threads = 3;
  CHECK(one == fit(set));
}

TEST_CASE("each table of a set can be fitted again from its neighbours") {
  const SetRecipe set = small_set();
  const SetLayout layout(set);
  const std::vector<std::uint16_t> texels = fit(set);
  Progress progress;
  for (int table = 0; table < layout.tables(); ++table) {
    const auto first = texels.begin() + static_cast<std::ptrdiff_t>(layout.offset(table));
    const std::vector<std::uint16_t> stored(
        first, first + static_cast<std::ptrdiff_t>(layout.size(table)));
    CHECK(stored == refit_table(set, texels, table, progress));
  }
  CHECK_THROWS_AS(refit_table(set, texels, layout.tables(), progress), std::invalid_argument);
  CHECK_THROWS_AS(refit_table(set, {}, 0, progress), std::invalid_argument);
}

TEST_CASE("interpolated tables are nearly as good as fitted ones") {
  SetRecipe set = small_set();
  set.lobes = 4;
  set.views = {8, 4};
  const std::vector<std::uint16_t> texels = fit(set);
  // Half-way between two isotropic widths, between pairs that are equally many levels apart, and
  // between those and pairs that are more. A table whose lobes do not correspond is off by 10 to
  // 30 % more.
  const SetLayout layout(set);
  const auto width = [&](double level) { return 0.1 * std::pow(2.0, 0.5 * level); };
  const std::vector<std::pair<glm::dvec2, std::vector<std::pair<int, double>>>> places = {
      {{0.5, 0.5}, {{layout.isotropic_table(0), 0.5}, {layout.isotropic_table(1), 0.5}}},
      {{1.5, 0.5}, {{layout.pair_table(1, 0), 0.5}, {layout.pair_table(2, 1), 0.5}}},
      {{0.75, 0.25},
       {{layout.pair_table(0, 0), 0.25},
        {layout.pair_table(1, 1), 0.25},
        {layout.pair_table(1, 0), 0.5}}}};
  for (const auto& [levels, shares] : places) {
    const glm::dvec2 alpha(width(levels.x), width(levels.y));
    const LobeTable between = interpolated(set, texels, shares, alpha);
    Recipe recipe;
    recipe.brdf = set.brdf;
    recipe.alpha = alpha;
    recipe.lobes = set.lobes;
    recipe.views = between.views();
    Progress progress;
    const auto brdf = make_brdf(set.brdf, alpha);
    const LobeTable direct = fit_table(recipe, progress, nullptr);
    CHECK(table_errors(between, *brdf).at_views.mean_per_cent() <
          table_errors(direct, *brdf).at_views.mean_per_cent() + 2.0);
  }
}

TEST_CASE("a set's weights add up to the albedo, between widths too") {
  const SetRecipe set = small_set();
  const std::vector<std::uint16_t> texels = fit(set);
  const SetLayout layout(set);
  const glm::dvec2 alpha(0.1 * std::pow(2.0, 0.75), 0.1 * std::pow(2.0, 0.25));
  const LobeTable table = interpolated(
      set, texels, {{layout.pair_table(1, 0), 0.5}, {layout.pair_table(2, 1), 0.5}}, alpha);
  const auto brdf = make_brdf("ggx", alpha);
  for (int t = 0; t < 5; ++t) {
    const double albedo = sample_slice(*brdf, table.view(t, 1)).albedo;
    CHECK(total_weight(table.mixture_at_view(t, 1)) == doctest::Approx(albedo).epsilon(0.02));
  }
}

TEST_CASE("what a set cannot be fitted of is named") {
  const auto message = [](const SetRecipe& set) -> std::string {
    try {
      validate(set);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  SetRecipe set = small_set();
  CHECK(message(set).empty());
  set.widths = {0.1};
  CHECK(message(set) == "widths has 1 numbers, but needs 2 to 64.");
  set.widths = {0.1, 0.3, 0.2};
  CHECK(message(set) == "widths has 0.2 after 0.3, but must rise.");
  set.widths = {0.1, NAN};
  CHECK(message(set).find("must rise") != std::string::npos);
  set.widths = {0.0, 0.1};
  CHECK(message(set).find("alpha is (0, 0)") != std::string::npos);
  set = small_set();
  set.brdf = "copper.binary";
  CHECK(message(set).find("models only") != std::string::npos);
  set = small_set();
  set.views = {16, 0};
  CHECK(message(set).find("1 azimuth.") != std::string::npos);
  set = small_set();
  set.brdf = "charlie";
  CHECK(message(set).find("is isotropic") != std::string::npos);
  set = small_set();
  set.lobes = 33;
  CHECK(message(set).find("lobes is 33") != std::string::npos);
}

TEST_CASE("a set is cancelled between views") {
  Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(fit_table_set(small_set(), progress), Cancelled);
}
