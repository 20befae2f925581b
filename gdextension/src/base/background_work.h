#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "base/progress.h"

namespace lobelight {

// One piece of work on a thread of its own.
class BackgroundWork {
 public:
  // Runs `work` on a new thread and then, still on it, `done`; `work` may throw. Throws
  // std::system_error where no thread can be had.
  BackgroundWork(std::function<void(Progress&)> work, std::function<void()> done);
  // Cancels, and waits for the thread; `done` may no longer be called.
  ~BackgroundWork();

  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  Progress& progress() { return progress_; }
  // Whether `work` has ended.
  bool finished() const { return finished_.load(std::memory_order_acquire); }
  // Waits until `done` has returned too.
  void wait();
  // What `work` threw, null for nothing. Only when finished().
  std::exception_ptr failure() const { return failure_; }

  // Ends all work there is, as the destructor does. Before the library's code goes away no thread
  // may be left in it.
  static void stop_all();

 private:
  void run(const std::function<void(Progress&)>& work, const std::function<void()>& done);
  void stop();

  Progress progress_;
  std::exception_ptr failure_;
  std::atomic<bool> finished_{false};
  std::atomic<bool> abandoned_{false};
  std::mutex join_mutex_;
  std::thread thread_;
};

}  // namespace lobelight
