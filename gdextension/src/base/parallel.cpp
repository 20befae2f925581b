#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lobelight {

int resolve_threads(int threads) {
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(threads, 1, kMaxThreads);
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const std::size_t workers = std::min(count, static_cast<std::size_t>(resolve_threads(threads)));
  std::atomic<std::size_t> next{0};
  std::mutex failure_mutex;
  std::exception_ptr failure;

  const auto run = [&] {
    for (std::size_t index = next++; index < count; index = next++) {
      try {
        work(index);
      } catch (...) {
        next = count;
        const std::lock_guard<std::mutex> lock(failure_mutex);
        if (!failure) failure = std::current_exception();
      }
    }
  };

  std::vector<std::thread> pool;
  try {
    // First, so that no thread is lost where the list of them cannot grow.
    pool.reserve(workers);
    for (std::size_t i = 1; i < workers; ++i) pool.emplace_back(run);
  } catch (const std::exception&) {
    // The system refuses more threads, or memory for them: those that started do all the work.
  }
  run();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

void parallel_for(std::size_t count, int threads, const Progress& progress,
                  const std::function<void(std::size_t)>& work) {
  parallel_for(count, threads, [&](std::size_t index) {
    progress.throw_if_cancelled();
    work(index);
  });
}

}  // namespace lobelight
