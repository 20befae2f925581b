// MERL's .binary files. A whole one has 33 MB, so an input is an abridged one: the header, a signed
// 32-bit difference of the file's length from the right one, and doubles, which are stored one
// behind the other from the start of each channel on; everything else is 0.

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "brdf/binary_file.h"
#include "brdf/merl.h"
#include "checks.h"
#include "measured_files.h"

namespace lobelight::fuzz {

const char* const kReader = "merl";

namespace {

constexpr std::size_t kLengthBytes = sizeof(std::int32_t);
constexpr std::size_t kChannelBytes = testing::kMerlBins * sizeof(double);
constexpr std::int64_t kFileBytes =
    static_cast<std::int64_t>(testing::kMerlHeader + 3 * kChannelBytes);

template <typename T>
void append(Bytes& bytes, T value) {
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(&value);
  bytes.insert(bytes.end(), begin, begin + sizeof value);
}

// Makes the file at `path` what the input stands for; one shorter than its header stays as it is.
void expand(const std::string& path, const std::uint8_t* data, std::size_t size) {
  write_scratch(path, data, std::min(size, testing::kMerlHeader));
  if (size < testing::kMerlHeader + kLengthBytes) return;
  std::int32_t difference = 0;
  std::memcpy(&difference, data + testing::kMerlHeader, sizeof difference);
  // Small differences are near misses; large ones would only fill the disk.
  const std::int64_t length = kFileBytes + difference % 64;
  const std::uint8_t* const numbers = data + testing::kMerlHeader + kLengthBytes;
  const std::size_t count = size - testing::kMerlHeader - kLengthBytes;
  std::fstream stream(std::filesystem::u8path(path),
                      std::ios::binary | std::ios::in | std::ios::out);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    stream.seekp(static_cast<std::streamoff>(testing::kMerlHeader + channel * kChannelBytes));
    stream.write(reinterpret_cast<const char*>(numbers), static_cast<std::streamsize>(count));
  }
  stream.close();
  std::filesystem::resize_file(std::filesystem::u8path(path), static_cast<std::uintmax_t>(length));
}

}  // namespace

std::vector<Bytes> seeds() {
  Bytes bytes;
  for (const std::int32_t count : {90, 90, 180, 0}) append(bytes, count);
  // The highlight: half-vectors within a degree of the normal.
  for (int n = 0; n < 400; ++n) append(bytes, n % 7 == 0 ? -1.0 : 1500.0 / (1.0 + n));
  return {bytes};
}

}  // namespace lobelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lobelight;
  static const std::string path = fuzz::scratch_path();
  fuzz::expand(path, data, size);
  try {
    fuzz::accept(*read_merl(path));
  } catch (const MeasuredFileError& error) {
    fuzz::refuse(error.what(), path);
  }
  return 0;
}
