#pragma once

#include <algorithm>
#include <atomic>
#include <ctime>

#include "base/progress.h"

namespace lobelight::testing {

// Seconds of work that the calling thread has done: what others do on the machine does not count.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// What cancel() may take at most, in seconds, and what is asked of work between two checks here. A
// quarter of it is the most there is, so that a busy machine does not matter. What is built for
// sanitizers, or without optimisation, is slower by far.
#ifdef NDEBUG
constexpr bool kOptimised = true;
#else
constexpr bool kOptimised = false;
#endif
constexpr double kPrompt = kOptimised ? 0.2 : 5.0;

// Watches how long the threads that work under it go on without asking whether they should, and
// cancels the work at one of the times that they ask.
class WatchedProgress : public Progress {
 public:
  // Cancels at check number `at`, counted from 0 on once the progress is at `from`; −1: never.
  explicit WatchedProgress(long at = -1, double from = 0.0) : at_(at), from_(from) {
    last() = {this, thread_seconds()};
  }

  bool cancelled() const noexcept override {
    note();
    if (fraction() < from_) return Progress::cancelled();
    if (checks_++ >= at_ && at_ >= 0) return true;
    return Progress::cancelled();
  }

  // How often was asked.
  long checks() const { return checks_; }

  // The longest that a thread worked from one check to the next, from its beginning or until now.
  double longest_gap() const {
    note();
    return longest_;
  }

 private:
  struct Last {
    const void* of = nullptr;
    double seconds = 0.0;
  };
  static Last& last() {
    thread_local Last last;
    return last;
  }

  void note() const noexcept {
    const double now = thread_seconds();
    // A thread that another one started for this work has done nothing else.
    const double before = last().of == this ? last().seconds : 0.0;
    last() = {this, now};
    double longest = longest_;
    while (now - before > longest && !longest_.compare_exchange_weak(longest, now - before)) {
    }
  }

  long at_;
  double from_;
  mutable std::atomic<long> checks_{0};
  mutable std::atomic<double> longest_{0.0};
};

}  // namespace lobelight::testing
