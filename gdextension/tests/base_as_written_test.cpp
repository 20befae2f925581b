#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/as_written.h"

namespace lobelight {

TEST_CASE("a float stands for the decimal number that it was written as") {
  CHECK(as_written(0.1f) == 0.1);
  CHECK(as_written(1e-4f) == 1e-4);
  CHECK(as_written(2.0f) == 2.0);
  CHECK(as_written(-0.35f) == -0.35);
  CHECK(as_written(1.5e30f) == 1.5e30);
  CHECK(as_written(0.0f) == 0.0);
}

TEST_CASE("and rounds to it again") {
  for (float value = 1e-5f; value < 3.0f; value = std::nextafter(value * 1.37f, 9.0f)) {
    CHECK(static_cast<float>(as_written(value)) == value);
  }
}

TEST_CASE("what is not finite stays so") {
  CHECK(std::isnan(as_written(std::numeric_limits<float>::quiet_NaN())));
  CHECK(as_written(-std::numeric_limits<float>::infinity()) ==
        -std::numeric_limits<double>::infinity());
}

}  // namespace lobelight
