#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "allocated_bytes.h"
#include "base/background_work.h"

namespace lobelight {

namespace {

const auto nothing = [] {};

// Works until it is told to stop.
void work_for_ever(Progress& progress) {
  for (;;) {
    progress.throw_if_cancelled();
    std::this_thread::yield();
  }
}

}  // namespace

TEST_CASE("work runs on another thread, and its end is told once, after it") {
  std::thread::id worker;
  int calls = 0;
  bool finished_when_told = false;
  BackgroundWork* self = nullptr;
  std::atomic<bool> ready{false};
  BackgroundWork work(
      [&](Progress& progress) {
        while (!ready) std::this_thread::yield();
        worker = std::this_thread::get_id();
        progress.set(0.5);
      },
      [&] {
        ++calls;
        finished_when_told = self->finished();
      });
  self = &work;
  ready = true;
  work.wait();
  const bool on_another_thread =
      worker != std::thread::id() && worker != std::this_thread::get_id();
  CHECK(on_another_thread);
  CHECK(calls == 1);
  CHECK(finished_when_told);
  CHECK(work.finished());
  CHECK(work.failure() == nullptr);
  CHECK(work.progress().fraction() == 0.5);
  work.wait();
}

TEST_CASE("what the work throws is kept") {
  BackgroundWork work([](Progress&) { throw std::runtime_error("no"); }, nothing);
  work.wait();
  CHECK(work.finished());
  REQUIRE(work.failure() != nullptr);
  CHECK_THROWS_AS(std::rethrow_exception(work.failure()), std::runtime_error);
}

TEST_CASE("cancelled work ends with Cancelled, and its end is told") {
  std::atomic<int> calls{0};
  BackgroundWork work(work_for_ever, [&] { ++calls; });
  CHECK_FALSE(work.finished());
  work.progress().cancel();
  work.wait();
  REQUIRE(work.failure() != nullptr);
  CHECK_THROWS_AS(std::rethrow_exception(work.failure()), Cancelled);
  CHECK(calls == 1);
}

TEST_CASE("the destructor ends the work, and nobody is told") {
  std::atomic<int> calls{0};
  std::atomic<bool> ended{false};
  {
    BackgroundWork work(
        [&](Progress& progress) {
          try {
            work_for_ever(progress);
          } catch (...) {
            ended = true;
            throw;
          }
        },
        [&] { ++calls; });
  }
  CHECK(ended);
  CHECK(calls == 0);
}

TEST_CASE("stop_all ends all work there is, and the objects can still be destroyed") {
  std::vector<std::unique_ptr<BackgroundWork>> works;
  for (int i = 0; i < 8; ++i) {
    works.push_back(std::make_unique<BackgroundWork>(work_for_ever, nothing));
  }
  BackgroundWork::stop_all();
  for (const auto& work : works) {
    CHECK(work->finished());
    CHECK(work->progress().cancelled());
  }
  works.clear();
  BackgroundWork::stop_all();
}

TEST_CASE("stop_all does not hurt work that comes after it") {
  BackgroundWork::stop_all();
  std::atomic<bool> done{false};
  BackgroundWork work([](Progress&) {}, [&] { done = true; });
  work.wait();
  CHECK(done);
}

TEST_CASE("work that cannot be begun for want of memory leaves nothing behind") {
  bool failed = true;
  for (int n = 0; failed && n < 100; ++n) {
    const std::function<void(Progress&)> work = work_for_ever;
    const std::function<void()> done = nothing;
    CAPTURE(n);
    std::unique_ptr<BackgroundWork> begun;
    bench::fail_allocation(n);
    try {
      begun = std::make_unique<BackgroundWork>(work, done);
    } catch (const std::bad_alloc&) {
    }
    failed = !bench::fail_allocation(-1);
    CHECK((begun != nullptr) == !failed);
    BackgroundWork::stop_all();
  }
  CHECK_FALSE(failed);
}

}  // namespace lobelight
