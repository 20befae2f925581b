// Files of measurements on their way to a table: the reader, MeasuredBrdf, and a small fit.
//
// An input is a byte, whose lowest bits say how many lobes there are, whether the table is refined
// and by which method it is fitted, and a file: RGL's as it is; anything else is a coarse MERL
// file, whose numbers, as many for each channel, stand for as many ranges of bins.

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "brdf/binary_file.h"
#include "brdf/measured.h"
#include "checks.h"
#include "measured_files.h"
#include "table_checks.h"

namespace lobelight::fuzz {

const char* const kReader = "measured";

namespace {

constexpr char kRglMagic[] = "tensor_file";

bool is_rgl(const std::uint8_t* data, std::size_t size) {
  return size >= sizeof kRglMagic && std::memcmp(data, kRglMagic, sizeof kRglMagic) == 0;
}

void write_coarse_merl(const std::string& path, const std::uint8_t* data, std::size_t size) {
  std::vector<double> numbers(std::max<std::size_t>(size / sizeof(double), 1));
  std::memcpy(numbers.data(), data, std::min(size, numbers.size() * sizeof(double)));
  std::ofstream stream(std::filesystem::u8path(path), std::ios::binary | std::ios::trunc);
  constexpr std::int32_t kSizes[] = {90, 90, 180};
  stream.write(reinterpret_cast<const char*>(kSizes), sizeof kSizes);
  std::vector<double> channel(testing::kMerlBins);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t first = c * numbers.size() / 3;
    const std::size_t count = std::max<std::size_t>((c + 1) * numbers.size() / 3 - first, 1);
    for (std::size_t n = 0; n < count; ++n) {
      std::fill(channel.begin() + static_cast<std::ptrdiff_t>(n * channel.size() / count),
                channel.begin() + static_cast<std::ptrdiff_t>((n + 1) * channel.size() / count),
                numbers[std::min(first + n, numbers.size() - 1)]);
    }
    stream.write(reinterpret_cast<const char*>(channel.data()),
                 static_cast<std::streamsize>(channel.size() * sizeof(double)));
  }
}

}  // namespace

std::vector<Bytes> seeds() {
  std::vector<Bytes> files;
  // A highlight, and one whose colour changes.
  for (const double blue : {1.0, 4.0}) {
    Bytes bytes{static_cast<std::uint8_t>(files.size())};
    for (int channel = 0; channel < 3; ++channel) {
      for (int n = 0; n < 90; ++n) {
        const double value = 1500.0 / (1.0 + n * n * (channel == 2 ? blue : 1.0));
        const auto* const begin = reinterpret_cast<const std::uint8_t*>(&value);
        bytes.insert(bytes.end(), begin, begin + sizeof value);
      }
    }
    files.push_back(bytes);
  }
  for (const std::vector<char>& rgl : testing::small_rgl_files()) {
    Bytes bytes{static_cast<std::uint8_t>(files.size())};
    bytes.insert(bytes.end(), rgl.begin(), rgl.end());
    files.push_back(bytes);
  }
  return files;
}

}  // namespace lobelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lobelight;
  static const std::string path = fuzz::scratch_path();
  if (size == 0) return 0;
  const unsigned choice = data[0];
  if (fuzz::is_rgl(data + 1, size - 1)) {
    fuzz::write_scratch(path, data + 1, size - 1);
  } else {
    fuzz::write_coarse_merl(path, data + 1, size - 1);
  }
  std::unique_ptr<MeasuredBrdf> brdf;
  try {
    brdf = std::make_unique<MeasuredBrdf>(read_measured(path), "input");
  } catch (const MeasuredFileError& error) {
    fuzz::refuse(error.what(), path);
    return 0;
  }
  Recipe recipe;
  recipe.lobes = 1 + static_cast<int>(choice & 1U);
  recipe.views = {2, brdf->is_isotropic() ? 1 : 2};
  recipe.refine = (choice & 2U) != 0;
  recipe.method = (choice & 4U) != 0 ? FitMethod::independent : FitMethod::continuation;
  recipe.threads = 1;
  const FitOptions options = fuzz::tiny_fit();
  Progress progress;
  try {
    const LobeTable table = fit_table(*brdf, recipe, progress, nullptr, options);
    ++fuzz::counts.accepted;
    fuzz::accept_table(table, *brdf, recipe, options);
  } catch (const std::invalid_argument& error) {
    fuzz::refuse(error.what(), "");
  }
  return 0;
}
