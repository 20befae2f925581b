#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "brdf/binary_file.h"
#include "brdf/measured.h"
#include "measured_files.h"
#include "refusal.h"

// Damaged files of measurements. Whatever is read of them is light; all else is refused by name.

namespace lobelight {
namespace {

using testing::from_angles;
using testing::kMerlBins;
using testing::kMerlHeader;
using testing::TemporaryFile;

// Each byte becomes these of itself: its lowest and highest bits, and all of them.
constexpr char kFlips[] = {'\x01', '\x80', '\xff'};

// Reads the file; whether it was accepted. What is wrong is left in `wrong`.
bool read_damaged(const TemporaryFile& file, std::string& wrong) {
  std::unique_ptr<MeasuredData> data;
  try {
    data = read_measured(file.path());
  } catch (const MeasuredFileError& error) {
    const std::string clause = testing::wrong_in_refusal(error.what(), file.path());
    if (!clause.empty()) wrong = std::string("the message \"") + error.what() + "\" " + clause;
    return false;
  }
  for (const double theta : {0.0, 0.3, 1.2, 1.57}) {
    for (const double phi : {0.0, 2.0}) {
      const glm::dvec3 value = data->reflected(from_angles(theta, phi), from_angles(0.3, 0.0));
      for (int channel = 0; channel < 3; ++channel) {
        if (!std::isfinite(value[channel]) || value[channel] < 0.0) {
          wrong = "accepted, but reflects no light";
        }
      }
    }
  }
  return true;
}

// A file of which bytes are changed in place: to write it anew each time would take long.
class DamagedFile {
 public:
  DamagedFile(const std::string& ending, const std::vector<char>& bytes) : file_(ending) {
    file_.write(bytes);
  }

  // Whether the file as it is now is accepted; what is wrong with that, or with the refusal, is
  // checked.
  bool read() const {
    std::string wrong;
    const bool accepted = read_damaged(file_, wrong);
    CHECK(wrong == "");
    return accepted;
  }

  // How often the file is accepted with one of `count` bytes from `first` on changed.
  std::size_t flip_each(std::size_t first, std::size_t count) const {
    std::size_t accepted = 0;
    for (std::size_t place = first; place < first + count; ++place) {
      const char byte = get(place);
      for (const char flip : kFlips) {
        put(place, static_cast<char>(byte ^ flip));
        CAPTURE(place);
        if (read()) ++accepted;
      }
      put(place, byte);
    }
    return accepted;
  }

  void resize(std::size_t size) const { std::filesystem::resize_file(file_.path(), size); }

  template <typename T>
  void put(std::size_t place, T value) const {
    std::fstream stream(file_.path(), std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(static_cast<std::streamoff>(place));
    stream.write(reinterpret_cast<const char*>(&value), sizeof value);
  }

 private:
  char get(std::size_t place) const {
    std::ifstream stream(file_.path(), std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(place));
    return static_cast<char>(stream.get());
  }

  TemporaryFile file_;
};

TEST_CASE("An RGL file of which any byte is another is read as light or refused by name") {
  for (const std::vector<char>& whole : testing::small_rgl_files()) {
    const DamagedFile file(".bsdf", whole);
    REQUIRE(file.read());
    const std::size_t accepted = file.flip_each(0, whole.size());
    // Both happen: most bytes are numbers, the others are structure.
    CHECK(accepted > 0);
    CHECK(accepted < std::size(kFlips) * whole.size());
  }
}

TEST_CASE("An RGL file that ends anywhere before its end is refused by name") {
  for (const std::vector<char>& whole : testing::small_rgl_files()) {
    const DamagedFile file(".bsdf", whole);
    for (std::size_t length = whole.size(); length-- > 0;) {
      file.resize(length);
      CAPTURE(length);
      // The last field, a byte that no reader needs, may be missing.
      const bool accepted = file.read();
      CHECK((!accepted || length + 1 == whole.size()));
    }
  }
}

// A MERL file has 33 MB: a number at the beginning of each channel and one at its end, 0 else.
class MerlFile : public DamagedFile {
 public:
  MerlFile() : DamagedFile(".binary", {}) {
    resize(kWhole);
    const std::int32_t sizes[] = {90, 90, 180};
    static_assert(sizeof sizes == kMerlHeader);
    for (std::size_t n = 0; n < 3; ++n) {
      put(n * sizeof sizes[n], sizes[n]);
      put(kMerlHeader + n * kChannel, 1500.0);
      put(kMerlHeader + (n + 1) * kChannel - sizeof(double), 0.25);
    }
  }

  static constexpr std::size_t kChannel = kMerlBins * sizeof(double);
  static constexpr std::size_t kWhole = kMerlHeader + 3 * kChannel;
};

TEST_CASE("A MERL file of which a byte is another is read as light or refused by name") {
  const MerlFile file;
  REQUIRE(file.read());
  CHECK(file.flip_each(0, kMerlHeader) == 0);
  // All numbers are alike: the first one of all, and the last.
  CHECK(file.flip_each(kMerlHeader, sizeof(double)) > 0);
  CHECK(file.flip_each(MerlFile::kWhole - sizeof(double), sizeof(double)) > 0);
}

TEST_CASE("A MERL file that ends before its end, or after it, is refused by name") {
  const MerlFile file;
  std::vector<std::size_t> lengths;
  const auto around = [&](std::size_t length) {
    for (std::size_t n = 0; n <= 2 * sizeof(double); ++n) {
      lengths.push_back(length + n - sizeof(double));
    }
  };
  for (std::size_t n = 3; n >= 1; --n) around(kMerlHeader + n * MerlFile::kChannel);
  for (std::size_t length = 0; length <= 2 * kMerlHeader; ++length) lengths.push_back(length);
  std::sort(lengths.rbegin(), lengths.rend());
  for (const std::size_t length : lengths) {
    file.resize(length);
    CAPTURE(length);
    CHECK(file.read() == (length == MerlFile::kWhole));
  }
}

}  // namespace
}  // namespace lobelight
