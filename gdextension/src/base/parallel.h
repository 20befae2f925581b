#pragma once

#include <cstddef>
#include <functional>

namespace lobelight {

// Threads that a request for `threads` stands for: the number itself, or every core when it is zero
// or negative. Never less than one.
int resolve_threads(int threads);

// Calls work(0) … work(count − 1), each once, on `threads` threads (zero or negative: every core).
// Indices are handed out in order, so which thread runs which index varies from run to run: results
// must depend on the index alone. The first exception stops the hand-out and is rethrown here,
// after every thread has ended.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace lobelight
