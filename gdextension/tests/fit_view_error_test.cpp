#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "brdf/brdf.h"
#include "fit/em.h"
#include "fit/initial_guess.h"
#include "fit/view_error.h"

namespace lobelight {
namespace {

const glm::dvec3 kView(0.6, 0.0, 0.8);

TEST_CASE("The error of a view is small for its fit, and 2 for lobes elsewhere or none") {
  const auto brdf = make_brdf("ggx", {0.1, 0.1});
  const Slice slice = sample_slice(*brdf, kView);
  const Mixture fit = run_em(slice, initial_guess(slice, 8)).mixture;
  CHECK(l1_error(*brdf, kView, fit) < 0.06);
  CHECK(l1_error(*brdf, kView, {{1.0, {{0.0, 1.0, 0.0}, 1e4}}}) == doctest::Approx(2.0));
  CHECK(l1_error(*brdf, kView, {{0.0, {{0.0, 0.0, 1.0}, 10.0}}}) == 2.0);
}

TEST_CASE("Lobes that are no numbers are no good fit") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto brdf = make_brdf("ggx", {0.1, 0.1});
  const glm::dvec3 mean(-0.6, 0.0, 0.8);
  for (const Lobe& bad :
       {Lobe{nan, {mean, 10.0}}, Lobe{0.5, {mean, nan}}, Lobe{0.5, {glm::dvec3(nan), 10.0}}}) {
    CHECK(std::isnan(l1_error(*brdf, kView, {bad, {0.5, {mean, 100.0}}})));
  }
}

}  // namespace
}  // namespace lobelight
