#pragma once

#include <cstdint>
#include <functional>
#include <godot_cpp/classes/ref_counted.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <memory>
#include <mutex>
#include <string>

#include "base/background_work.h"
#include "base/progress.h"

namespace lobelight {

// Base of the classes whose work takes seconds: does it on a thread of its own, one at a time.
//
// The worker never touches the object. It leaves what it has made in an Outcome and posts
// _deliver() to the main thread; the object takes the outcome up there, or earlier when a script
// asks for it.
class LobeTask : public godot::RefCounted {
  GDCLASS(LobeTask, godot::RefCounted)

 public:
  // Cancels what is running and waits until it has stopped.
  ~LobeTask() override = default;

  bool start(const godot::Dictionary& request);
  void cancel();
  bool is_running();
  double get_progress();
  godot::String get_error();
  godot::Dictionary get_result();

 protected:
  static void _bind_methods();

  // Makes the result; called on any thread. May throw: Cancelled, or what() is a sentence.
  using Work = std::function<godot::Dictionary(Progress&)>;

  // Reads and checks a request, quickly and without a look at files, on the caller's thread. Throws
  // std::invalid_argument with one sentence.
  virtual Work prepare(const godot::Dictionary& request) const = 0;

  // Does the work on the caller's thread. Gives the result or {"error": sentence}.
  godot::Dictionary run(const godot::Dictionary& request) const;

 private:
  struct Outcome {
    enum class Kind { kFinished, kFailed, kCancelled } kind = Kind::kFinished;
    godot::Dictionary result;
    std::string error;
  };

  // Emits the signal of run number `run` if that has not been done. Bound, so that the worker can
  // post it; its name keeps it out of the class reference.
  void _deliver(std::int64_t run);
  // Emits the signal of an outcome. Nothing of this object may be used after it: what is connected
  // may let go of it.
  void announce(const Outcome& outcome);
  // Takes up the outcome of work that has ended; the second for those who hold the mutex.
  void collect();
  void collect_locked();

  std::mutex mutex_;  // guards everything below
  std::int64_t run_ = 0;
  std::shared_ptr<Outcome> outcome_ = std::make_shared<Outcome>();  // of the last run
  bool undelivered_ = false;
  double last_progress_ = 0.0;  // of the last run, once it has ended
  std::unique_ptr<BackgroundWork> work_;
};

}  // namespace lobelight
