#include <doctest/doctest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "allocated_bytes.h"
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
  CHECK(resolve_threads(1000000) == kMaxThreads);
}

TEST_CASE("parallel_for does all the work where threads, or memory for them, cannot be had") {
  bool failed = true;
  for (int n = 0; failed && n < 100; ++n) {
    std::vector<std::atomic<int>> visits(53);
    const std::function<void(std::size_t)> work = [&](std::size_t index) { ++visits[index]; };
    bench::fail_allocation(n);
    parallel_for(visits.size(), 4, work);
    failed = !bench::fail_allocation(-1);
    CAPTURE(n);
    for (const auto& count : visits) CHECK(count == 1);
  }
  // The last round went through without a failure.
  CHECK_FALSE(failed);
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

TEST_CASE("parallel_for hands out nothing once it is cancelled") {
  for (const int threads : {1, 2, 8}) {
    Progress progress;
    std::atomic<int> visits{0};
    const auto work = [&](std::size_t n) {
      ++visits;
      if (n == 3) progress.cancel();
    };
    CHECK_THROWS_AS(parallel_for(1000000, threads, progress, work), Cancelled);
    CHECK(visits < 1000000);
    if (threads == 1) CHECK(visits == 4);
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
  CHECK_THROWS_AS(throw_if_cancelled(&progress), Cancelled);
  CHECK_NOTHROW(throw_if_cancelled(nullptr));
}

TEST_CASE("Progress never falls and never exceeds 1") {
  Progress progress;
  for (const double fraction : {0.5, 0.25, -1.0, std::numeric_limits<double>::quiet_NaN(), 0.0}) {
    progress.set(fraction);
    CHECK(progress.fraction() == 0.5);
  }
  Progress whole;
  whole.set(0.5);
  Progress rest(whole, 0.75);
  rest.set(1.0);
  CHECK(whole.fraction() == 1.0);
}

TEST_CASE("Parts of a progress add up, also parts of parts, and one cancels them all") {
  Progress whole;
  Progress first(whole, 0.25);
  Progress second(whole, 0.75);
  Progress inner(second, 0.5);
  first.set(1.0);
  CHECK(whole.fraction() == 0.25);
  inner.set(0.5);
  CHECK(second.fraction() == 0.25);
  CHECK(whole.fraction() == 0.25 + 0.75 * 0.25);
  second.set(1.0);
  CHECK(whole.fraction() == 1.0);
  CHECK_FALSE(inner.cancelled());
  second.cancel();
  CHECK(inner.cancelled());
  CHECK_FALSE(first.cancelled());
  CHECK_FALSE(whole.cancelled());
  whole.cancel();
  CHECK(first.cancelled());
}

TEST_CASE("Parts that are worked on at the same time lose nothing") {
  Progress whole;
  parallel_for(8, 8, [&](std::size_t) {
    Progress part(whole, 0.125);
    for (int step = 1; step <= 1000; ++step) part.set(step / 1000.0);
  });
  CHECK(whole.fraction() == doctest::Approx(1.0).epsilon(1e-9));
}

}  // namespace
}  // namespace lobelight
