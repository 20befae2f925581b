#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lobelight {

// All bytes of the regular file at `path` (UTF-8). Throws ImageError.
std::vector<std::uint8_t> read_file(const std::string& path);

// Writes `bytes` to a temporary file beside `path` (UTF-8) and renames it, so that whoever looks
// sees the old file or the whole new one. Throws ImageError; then nothing is left behind.
void write_file_atomically(const std::string& path, const std::vector<char>& bytes);

}  // namespace lobelight
