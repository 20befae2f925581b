#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "bake/bake.h"
#include "bake/slice_plot.h"
#include "bake/sphere.h"
#include "base/pi.h"
#include "brdf/brdf.h"
#include "measured_files.h"

namespace lobelight {

TEST_CASE("a slice in the plane of incidence is the reflectance times the cosine") {
  const glm::dvec3 view(-0.6, 0.0, 0.8);
  const glm::dvec2 alpha(0.2, 0.3);
  const auto model = make_brdf("ggx", alpha);
  const std::vector<double> slice = slice_in_plane("ggx", alpha, 5.0 * view, 7);
  REQUIRE(slice.size() == 7);
  for (int n = 0; n < 7; ++n) {
    const double angle = kPi * (n / 6.0 - 0.5);
    // Positive angles are on the view's side.
    const glm::dvec3 i(-std::sin(angle), 0.0, std::cos(angle));
    CHECK(slice[static_cast<std::size_t>(n)] ==
          doctest::Approx(model->evaluate(i, view) * i.z).epsilon(1e-12));
  }
}

TEST_CASE("plots and bakes take the same widths") {
  const auto accepts = [](const auto& call) {
    try {
      call();
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  };
  const glm::dvec3 view(0.3, 0.0, 1.0);
  for (const double width : {0.0, 0.99e-4, 1e-4, 0.1, 2.0, 2.01, std::nan("")}) {
    const glm::dvec2 alpha(width);
    TableRequest request;
    request.recipe.alpha = alpha;
    const bool bakes = accepts([&] { validate(request); });
    CAPTURE(width);
    CHECK(bakes == (width >= kMinAlpha && width <= kMaxAlpha));
    CHECK(accepts([&] { directional_albedo("ward", alpha, view); }) == bakes);
    CHECK(accepts([&] { slice_in_plane("ward", alpha, view, 2); }) == bakes);
    SphereRequest sphere;
    sphere.alpha = alpha;
    CHECK(accepts([&] { validate(sphere); }) == bakes);
  }
}

TEST_CASE("what cannot be plotted is refused in a sentence") {
  const glm::dvec2 alpha(0.1);
  const char* below = "view must point above the horizon: its z must be positive.";
  CHECK_THROWS_WITH_AS(directional_albedo("ward", alpha, {0.0, 1.0, 0.0}), below,
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(slice_in_plane("ward", alpha, {0.0, std::nan(""), 1.0}, 9), below,
                       std::invalid_argument);
  for (const int count : {-1, 0, 1, 100001}) {
    CHECK_THROWS_WITH_AS(slice_in_plane("ward", alpha, {0.0, 0.0, 1.0}, count),
                         "count must be from 2 to 100000.", std::invalid_argument);
  }
}

TEST_CASE("measurements are read anew when their file changes, and once until then") {
  const testing::TemporaryFile file(".bsdf");
  testing::RglRecipe recipe;
  recipe.alpha = {0.3, 0.3};
  recipe.elevations = {0.0, 0.8, 1.5};
  recipe.resolution = 8;
  const auto write = [&](double value) {
    recipe.reflectance = [value](const glm::dvec3&, const glm::dvec3&) {
      return glm::dvec3(value);
    };
    file.write(testing::rgl_file(recipe));
  };
  write(0.1);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const double dark = directional_albedo(file.path(), {0.0, 0.0}, up);
  CHECK(directional_albedo(file.path(), {0.0, 0.0}, up) == dark);
  // File systems' clocks may be as coarse as this.
  std::filesystem::last_write_time(
      file.path(), std::filesystem::last_write_time(file.path()) - std::chrono::seconds(10));
  write(0.2);
  CHECK(directional_albedo(file.path(), {0.0, 0.0}, up) ==
        doctest::Approx(2.0 * dark).epsilon(1e-6));
}

}  // namespace lobelight
