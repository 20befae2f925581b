#include "base/background_work.h"

#include <set>

namespace lobelight {

namespace {

struct Registry {
  std::mutex mutex;
  std::set<BackgroundWork*> works;
};

Registry& registry() {
  static Registry instance;
  return instance;
}

}  // namespace

BackgroundWork::BackgroundWork(std::function<void(Progress&)> work, std::function<void()> done) {
  const std::lock_guard lock(registry().mutex);
  // Before there is a thread: nothing may fail once it runs.
  const auto place = registry().works.insert(this).first;
  try {
    thread_ =
        std::thread([this, work = std::move(work), done = std::move(done)] { run(work, done); });
  } catch (...) {
    registry().works.erase(place);
    throw;
  }
}

BackgroundWork::~BackgroundWork() {
  {
    const std::lock_guard lock(registry().mutex);
    registry().works.erase(this);
  }
  stop();
}

void BackgroundWork::run(const std::function<void(Progress&)>& work,
                         const std::function<void()>& done) {
  try {
    work(progress_);
  } catch (...) {
    failure_ = std::current_exception();
  }
  finished_.store(true, std::memory_order_release);
  if (!abandoned_.load()) done();
}

void BackgroundWork::stop() {
  abandoned_.store(true);
  progress_.cancel();
  wait();
}

void BackgroundWork::wait() {
  const std::lock_guard lock(join_mutex_);
  if (thread_.joinable()) thread_.join();
}

void BackgroundWork::stop_all() {
  const std::lock_guard lock(registry().mutex);
  for (BackgroundWork* work : registry().works) work->stop();
}

}  // namespace lobelight
