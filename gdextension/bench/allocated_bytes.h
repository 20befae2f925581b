#pragma once

#include <cstddef>

namespace lobelight::bench {

// Counts what operator new hands out in a program that links allocated_bytes.cpp, which replaces
// it. All threads together.
void reset_peak_bytes();   // the peak becomes what is held now
std::size_t held_bytes();  // held now
std::size_t peak_bytes();  // most held since the last reset

}  // namespace lobelight::bench
