#pragma once

#include <cstddef>
#include <functional>

#include "base/progress.h"

namespace lobelight {

// More threads than this would only take memory.
constexpr int kMaxThreads = 256;

// Threads that a request for `threads` stands for: the number itself, or every core when it is zero
// or negative. From one to kMaxThreads.
int resolve_threads(int threads);

// Calls work(0) … work(count − 1), each once, on `threads` threads (zero or negative: every core),
// or on as many of them as the system grants. Indices are handed out in order, so which thread runs
// which index varies from run to run: results must depend on the index alone. The first exception
// stops the hand-out and is rethrown here, after every thread has ended.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

// The same; throws Cancelled before any index once `progress` is cancelled.
void parallel_for(std::size_t count, int threads, const Progress& progress,
                  const std::function<void(std::size_t)>& work);

}  // namespace lobelight
