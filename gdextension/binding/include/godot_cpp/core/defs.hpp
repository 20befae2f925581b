#pragma once

#include <cstddef>
#include <cstdint>

// Marks the library's entry point, the one symbol that the engine looks up by name.
#if defined(_WIN32)
#define GDE_EXPORT __declspec(dllexport)
#else
#define GDE_EXPORT __attribute__((visibility("default")))
#endif
