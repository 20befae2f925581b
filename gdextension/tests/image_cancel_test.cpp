#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "image/exr.h"
#include "image/panorama.h"
#include "measured_files.h"
#include "watched_progress.h"

namespace lobelight {

namespace {

using testing::kPrompt;
using testing::TemporaryFile;
using testing::WatchedProgress;

void check_reading(const std::string& path, long checks) {
  const auto read = [&](const Progress& progress) {
    return load_panorama(path, "", kMaxPanoramaSide, &progress);
  };
  WatchedProgress whole;
  CHECK(read(whole).rgb == load_panorama(path).rgb);
  CHECK(whole.longest_gap() < kPrompt);
  CHECK(whole.checks() >= checks);
  for (const long at : {0L, whole.checks() / 2, whole.checks() - 1}) {
    CAPTURE(at);
    CHECK_THROWS_AS(read(WatchedProgress(at)), Cancelled);
  }
}

}  // namespace

TEST_CASE("the reading of panoramas can be cancelled") {
  constexpr int kWidth = 1200;
  constexpr int kHeight = 600;
  const TemporaryFile exr(".exr");
  write_exr(exr.path(), kWidth, kHeight, {"R", "G", "B"},
            std::vector<float>(3u * kWidth * kHeight, 0.5f));
  check_reading(exr.path(), 3);

  const TemporaryFile chroma(".exr");
  write_exr(chroma.path(), kWidth, kHeight, {"Y", "RY", "BY"},
            std::vector<float>(3u * kWidth * kHeight, 0.25f));
  check_reading(chroma.path(), kHeight);

  const TemporaryFile hdr(".hdr");
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 600 +X 1200\n";
  std::vector<char> bytes(header.begin(), header.end());
  for (int n = 0; n < kWidth * kHeight; ++n) bytes.insert(bytes.end(), {10, 20, 30, 127});
  hdr.write(bytes);
  check_reading(hdr.path(), kHeight);
}

}  // namespace lobelight
