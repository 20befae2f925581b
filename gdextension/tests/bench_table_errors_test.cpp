#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "table_errors.h"

namespace lobelight {
namespace {

TEST_CASE("An error that is no number is the worst of all") {
  Errors errors;
  errors.add(0.1);
  errors.add(0.05);
  CHECK(errors.worst_per_cent() == doctest::Approx(10.0));
  CHECK(errors.mean_per_cent() == doctest::Approx(7.5));
  errors.add(std::numeric_limits<double>::quiet_NaN());
  errors.add(0.2);
  CHECK(std::isnan(errors.worst_per_cent()));
  CHECK(std::isnan(errors.mean_per_cent()));
}

}  // namespace
}  // namespace lobelight
