#pragma once

#include <atomic>
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
  // `fraction` in [0, 1].
  void set(double fraction) noexcept { fraction_.store(fraction, std::memory_order_relaxed); }
  double fraction() const noexcept { return fraction_.load(std::memory_order_relaxed); }

  // Asks the worker to stop; it answers with Cancelled at its next check.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }
  void throw_if_cancelled() const {
    if (cancelled()) throw Cancelled();
  }

 private:
  std::atomic<double> fraction_{0.0};
  std::atomic<bool> cancelled_{false};
};

}  // namespace lobelight
