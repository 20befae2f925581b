#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "bake/lobe_count.h"
#include "brdf/ggx.h"
#include "image/exr.h"
#include "image/synthetic_panorama.h"
#include "measured_files.h"
#include "tinted_brdf.h"

namespace lobelight {

namespace {

using testing::TemporaryFile;
using testing::Tinted;

LobeCountOptions coarse() {
  LobeCountOptions options;
  options.size = 10;
  options.samples = 128;
  return options;
}

Recipe small_recipe() {
  Recipe recipe;
  recipe.views = {8, 1};
  return recipe;
}

LobeCount count(const LobeTarget& target, const Brdf& brdf) {
  Progress progress;
  LobeCount found = find_lobe_count(target, small_recipe(), brdf, progress, coarse());
  CHECK(progress.fraction() == 1.0);
  return found;
}

}  // namespace

TEST_CASE("a colour needs as many lobes as grey does") {
  LobeTarget target;
  target.psnr = 30.0;
  const LobeCount grey = count(target, Ggx({0.3, 0.3}));
  const LobeCount tinted = count(target, Tinted({0.3, 0.3}, {0.9, 0.45, 0.1}));
  CHECK(tinted.table.has_second_texels());
  CHECK(tinted.table.lobes() == grey.table.lobes());
  CHECK(tinted.trials.back().psnr > 30.0);
}

TEST_CASE("the count is the first that reaches the target") {
  LobeTarget target;
  target.psnr = 33.0;
  const LobeCount found = count(target, Ggx({0.3, 0.3}));
  REQUIRE(found.trials.size() > 1);
  for (const LobeCountTrial& trial : found.trials) {
    CHECK((trial.psnr >= 33.0) == (&trial == &found.trials.back()));
  }
  CHECK(found.trials.back().lobes == found.table.lobes());
  // It is the table that the recipe gives with this count and placement.
  Recipe recipe = small_recipe();
  recipe.placement = found.report.is_by_squares ? Placement::automatic : Placement::em;
  recipe.lobes = found.table.lobes();
  Progress progress;
  CHECK(fit_table(Ggx({0.3, 0.3}), recipe, progress, nullptr).to_rgba16f() ==
        found.table.to_rgba16f());

  target.psnr = 46.0;
  target.max_lobes = 2;
  try {
    count(target, Ggx({0.3, 0.3}));
    FAIL("two lobes cannot do that");
  } catch (const std::runtime_error& error) {
    CHECK(
        std::string(error.what())
            .find("The target of 46 dB is out of reach with up to 2 lobes; the best are 2 with ") ==
        0);
  }
}

TEST_CASE("a width that may be fitted by least squares takes no more lobes than EM's") {
  // In exact light, EM's are the better ones here.
  LobeTarget target;
  target.psnr = 34.0;
  Recipe recipe = small_recipe();
  recipe.placement = Placement::em;
  Progress progress;
  const LobeCount likely = find_lobe_count(target, recipe, Ggx({0.25, 0.25}), progress, coarse());
  const LobeCount found = count(target, Ggx({0.25, 0.25}));
  CHECK(found.table.lobes() <= likely.table.lobes());
}

TEST_CASE("every environment has to be reached, of any size") {
  // The synthetic panorama again, too large to be looked at as it is, by a factor that cuts texels.
  const Panorama small = synthetic_panorama();
  constexpr int kWidth = 2300;
  constexpr int kHeight = 1150;
  std::vector<float> large;
  large.reserve(3u * kWidth * kHeight);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const glm::dvec3 light =
          small.sample(panorama_direction({(column + 0.5) / kWidth, (row + 0.5) / kHeight}));
      for (int c = 0; c < 3; ++c) large.push_back(static_cast<float>(light[c]));
    }
  }
  const TemporaryFile file(".exr");
  write_exr(file.path(), kWidth, kHeight, {"R", "G", "B"}, large);
  LobeTarget target;
  target.psnr = 5.0;
  target.max_lobes = 1;
  const double alone = count(target, Ggx({0.3, 0.3})).trials.back().psnr;
  target.environments = {file.path()};
  const double with_it = count(target, Ggx({0.3, 0.3})).trials.back().psnr;
  CHECK(with_it <= alone);
  CHECK(with_it == doctest::Approx(alone).epsilon(0.05));
  target.environments = {"no_such_file.exr"};
  CHECK_THROWS_WITH(count(target, Ggx({0.3, 0.3})), "no_such_file.exr: no such file");
}

}  // namespace lobelight
