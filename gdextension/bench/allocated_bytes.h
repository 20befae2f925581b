#pragma once

#include <cstddef>

namespace lobelight::bench {

// Counts what operator new hands out in a program that links allocated_bytes.cpp, which replaces
// it. All threads together.
void reset_peak_bytes();   // the peak becomes what is held now
std::size_t held_bytes();  // held now
std::size_t peak_bytes();  // most held since the last reset

// Has allocation number `n` of the calling thread from now on, counted from 0, throw
// std::bad_alloc; −1 takes that back. Whether it was still to come.
bool fail_allocation(int n);

}  // namespace lobelight::bench
