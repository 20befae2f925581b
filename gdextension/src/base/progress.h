#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>

namespace lobelight {

// Thrown by work that was asked to stop.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

// Shared between a worker and whoever watches it: the worker reports how far it is, the watcher may
// ask it to stop. Every member may be called from any thread.
class Progress {
 public:
  Progress() = default;
  // A part of `whole`, which must outlive it: all of the part is `share` of the whole, and who
  // cancels the whole cancels the part. Parts may be worked on at the same time.
  Progress(Progress& whole, double share) : whole_(&whole), share_(share) {}
  virtual ~Progress() = default;

  // `fraction` in [0, 1]. What is done stays done: less than before counts for nothing.
  void set(double fraction) noexcept {
    double before = fraction_.load(std::memory_order_relaxed);
    do {
      if (!(fraction > before)) return;
    } while (!fraction_.compare_exchange_weak(before, fraction, std::memory_order_relaxed));
    if (whole_) whole_->add(share_ * (fraction - before));
  }
  double fraction() const noexcept {
    return std::min(1.0, fraction_.load(std::memory_order_relaxed));
  }

  // Asks the worker to stop; it answers with Cancelled at its next check. Checks are never more
  // than a few hundredths of a second apart.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  // Virtual for tests, which watch how often work asks.
  virtual bool cancelled() const noexcept {
    return cancelled_.load(std::memory_order_relaxed) || (whole_ && whole_->cancelled());
  }
  void throw_if_cancelled() const {
    if (cancelled()) throw Cancelled();
  }

 private:
  void add(double part) noexcept {
    double before = fraction_.load(std::memory_order_relaxed);
    while (!fraction_.compare_exchange_weak(before, before + part, std::memory_order_relaxed)) {
    }
    if (whole_) whole_->add(share_ * part);
  }

  Progress* whole_ = nullptr;
  double share_ = 0.0;
  std::atomic<double> fraction_{0.0};
  std::atomic<bool> cancelled_{false};
};

// For work that may be given no progress.
inline void throw_if_cancelled(const Progress* progress) {
  if (progress) progress->throw_if_cancelled();
}

// The same, but at every 65536th index only, for loops over texels.
inline void throw_if_cancelled(const Progress* progress, std::size_t index) {
  if (index % 65536 == 0) throw_if_cancelled(progress);
}

}  // namespace lobelight
