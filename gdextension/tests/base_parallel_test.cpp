#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"

namespace lobelight {
namespace {

TEST_CASE("parallel_for visits every index once for any number of threads") {
  for (const int threads : {-1, 0, 1, 2, 7, 100}) {
    CAPTURE(threads);
    std::vector<int> visits(53, 0);
    parallel_for(visits.size(), threads, [&](std::size_t n) { ++visits[n]; });
    for (const int count : visits) CHECK(count == 1);
  }
  parallel_for(0, 2, [](std::size_t) { FAIL("there is no index"); });
  CHECK(resolve_threads(0) >= 1);
  CHECK(resolve_threads(3) == 3);
}

TEST_CASE("parallel_for rethrows the first exception and hands out nothing more") {
  for (const int threads : {1, 2}) {
    std::atomic<int> visits{0};
    const auto work = [&](std::size_t n) {
      ++visits;
      if (n == 3) throw std::runtime_error("third");
    };
    CHECK_THROWS_WITH_AS(parallel_for(1000000, threads, work), "third", std::runtime_error);
    CHECK(visits < 1000000);
  }
}

TEST_CASE("Progress is what was set, and cancelling is seen") {
  Progress progress;
  CHECK(progress.fraction() == 0.0);
  progress.set(0.25);
  CHECK(progress.fraction() == 0.25);
  CHECK_NOTHROW(progress.throw_if_cancelled());
  progress.cancel();
  CHECK(progress.cancelled());
  CHECK_THROWS_AS(progress.throw_if_cancelled(), Cancelled);
}

}  // namespace
}  // namespace lobelight
