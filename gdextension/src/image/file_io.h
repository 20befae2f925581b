#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"

namespace lobelight {

// All bytes of the regular file at `path` (UTF-8). Throws ImageError, and Cancelled when
// `progress`, which may be null, is cancelled.
std::vector<std::uint8_t> read_file(const std::string& path, const Progress* progress = nullptr);

// Writes `bytes` to a temporary file beside `path` (UTF-8) and renames it, so that whoever looks
// sees the old file or the whole new one. Throws ImageError; then nothing is left behind.
void write_file_atomically(const std::string& path, const std::vector<char>& bytes);

}  // namespace lobelight
