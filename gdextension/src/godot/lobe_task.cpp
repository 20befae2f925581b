#include "godot/lobe_task.h"

#include <new>
#include <stdexcept>
#include <system_error>

#include "godot/convert.h"

using namespace godot;

namespace lobelight {

namespace {

// The sentence for what work or its preparation threw.
std::string sentence(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return "There is not enough memory.";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "Unknown failure.";
  }
}

}  // namespace

void LobeTask::_bind_methods() {
  ClassDB::bind_method(D_METHOD("start", "request"), &LobeTask::start, DEFVAL(Dictionary()));
  ClassDB::bind_method(D_METHOD("cancel"), &LobeTask::cancel);
  ClassDB::bind_method(D_METHOD("is_running"), &LobeTask::is_running);
  ClassDB::bind_method(D_METHOD("get_progress"), &LobeTask::get_progress);
  ClassDB::bind_method(D_METHOD("get_error"), &LobeTask::get_error);
  ClassDB::bind_method(D_METHOD("get_result"), &LobeTask::get_result);
  ClassDB::bind_method(D_METHOD("_deliver", "run"), &LobeTask::_deliver);
  ADD_SIGNAL(MethodInfo("finished", PropertyInfo(Variant::DICTIONARY, "result")));
  ADD_SIGNAL(MethodInfo("failed", PropertyInfo(Variant::STRING, "message")));
  ADD_SIGNAL(MethodInfo("cancelled"));
}

bool LobeTask::start(const Dictionary& request) {
  // Without the lock, under which everybody else would wait for it.
  Work work;
  std::string refusal;
  try {
    work = prepare(request);
  } catch (...) {
    refusal = sentence(std::current_exception());
  }

  bool started = false;
  std::shared_ptr<const Outcome> before;
  {
    const std::lock_guard lock(mutex_);
    collect_locked();
    if (work_) {
      outcome_->error = "The task is running already; cancel it or wait until it has finished.";
      return false;
    }
    // The signal of the run before, if it is still on its way.
    if (undelivered_) before = outcome_;
    undelivered_ = false;
    auto outcome = std::make_shared<Outcome>();
    outcome_ = outcome;
    last_progress_ = 0.0;
    outcome->error = refusal;
    outcome->kind = Outcome::Kind::kFailed;
    if (work) {
      const std::int64_t run = ++run_;
      const Callable deliver(this, "_deliver");
      try {
        work_ = std::make_unique<BackgroundWork>(
            [work, outcome](Progress& progress) { outcome->result = work(progress); },
            [deliver, run] { deliver.call_deferred(run); });
        started = true;
      } catch (const std::system_error&) {
        outcome->error = "The system grants no thread to work on.";
      } catch (...) {
        outcome->error = sentence(std::current_exception());
      }
    }
  }
  if (before) announce(*before);
  return started;
}

void LobeTask::cancel() {
  const std::lock_guard lock(mutex_);
  if (work_) work_->progress().cancel();
}

bool LobeTask::is_running() {
  collect();
  const std::lock_guard lock(mutex_);
  return work_ != nullptr;
}

double LobeTask::get_progress() {
  collect();
  const std::lock_guard lock(mutex_);
  return work_ ? work_->progress().fraction() : last_progress_;
}

String LobeTask::get_error() {
  collect();
  const std::lock_guard lock(mutex_);
  return to_godot(outcome_->error);
}

Dictionary LobeTask::get_result() {
  collect();
  const std::lock_guard lock(mutex_);
  return work_ ? Dictionary() : outcome_->result;
}

Dictionary LobeTask::run(const Dictionary& request) const {
  try {
    Progress progress;
    return prepare(request)(progress);
  } catch (...) {
    return error_result(sentence(std::current_exception()));
  }
}

void LobeTask::collect() {
  const std::lock_guard lock(mutex_);
  collect_locked();
}

void LobeTask::collect_locked() {
  if (!work_ || !work_->finished()) return;
  Progress& progress = work_->progress();
  if (progress.cancelled()) {
    // Also where the work was done just before it could notice.
    outcome_->kind = Outcome::Kind::kCancelled;
    outcome_->result = Dictionary();
    outcome_->error.clear();
    last_progress_ = progress.fraction();
  } else if (work_->failure()) {
    outcome_->kind = Outcome::Kind::kFailed;
    outcome_->result = Dictionary();
    outcome_->error = sentence(work_->failure());
    last_progress_ = progress.fraction();
  } else {
    outcome_->kind = Outcome::Kind::kFinished;
    outcome_->error.clear();
    last_progress_ = 1.0;
  }
  undelivered_ = true;
  // Not to be cut short: the worker may be about to post _deliver().
  work_->wait();
  work_.reset();
}

void LobeTask::_deliver(std::int64_t run) {
  collect();
  std::shared_ptr<const Outcome> outcome;
  {
    const std::lock_guard lock(mutex_);
    if (!undelivered_ || run != run_) return;
    undelivered_ = false;
    outcome = outcome_;
  }
  announce(*outcome);
}

void LobeTask::announce(const Outcome& outcome) {
  switch (outcome.kind) {
    case Outcome::Kind::kFinished:
      emit_signal("finished", outcome.result);
      break;
    case Outcome::Kind::kFailed:
      emit_signal("failed", to_godot(outcome.error));
      break;
    case Outcome::Kind::kCancelled:
      emit_signal("cancelled");
      break;
  }
}

}  // namespace lobelight
