#pragma once

#include <cstdint>

namespace lobelight::fuzz {

// How many basic blocks of the code under test have run so far: that code is compiled with
// -fsanitize-coverage=trace-pc, and each block begins with a call of coverage.cpp's function.
std::uint64_t blocks_reached();

}  // namespace lobelight::fuzz
