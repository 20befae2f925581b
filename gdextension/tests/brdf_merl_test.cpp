#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "brdf/binary_file.h"
#include "brdf/merl.h"
#include "measured_files.h"
#include "statistics.h"

namespace lobelight {
namespace {

using testing::from_angles;
using testing::kMerlBins;
using testing::kMerlHeader;
using testing::TemporaryFile;

// Smooth, isotropic and reciprocal, but not the same on the two sides of the plane of incidence:
// then a wrong sign or quadrant of any angle shows.
glm::dvec3 smooth(const glm::dvec3& i, const glm::dvec3& o) {
  const glm::dvec3 h = glm::normalize(i + o);
  const double across = (i.x * o.y - i.y * o.x) * (i.z - o.z);
  return glm::dvec3(1.0, 0.5, 0.25) * std::exp(-(1.0 - h.z) / 0.1) +
         glm::dvec3(0.1, 0.2, 0.3) * (2.0 + across) * glm::dot(i, h);
}

const std::vector<char>& smooth_file() {
  static const std::vector<char> bytes = testing::merl_file(smooth);
  return bytes;
}

void put(std::vector<char>& bytes, std::size_t number, double value) {
  std::memcpy(&bytes[kMerlHeader + number * sizeof value], &value, sizeof value);
}

TEST_CASE("A MERL file gives back what it was made of") {
  const TemporaryFile file(".binary");
  file.write(smooth_file());
  const auto data = read_merl(file.path());
  CHECK(data->is_isotropic());
  CHECK(data->clamped() > 0);
  CHECK(data->clamped() < 3 * kMerlBins);
  testing::Uniform uniform(1);
  double worst = 0.0;
  for (int n = 0; n < 5000; ++n) {
    const glm::dvec3 i = uniform.direction_above();
    const glm::dvec3 o = uniform.direction_above();
    // Close to the horizon bins hold nothing, and their neighbours stand for them.
    if (i.z < 0.05 || o.z < 0.05) continue;
    const glm::dvec3 expected = smooth(i, o) * i.z;
    const glm::dvec3 found = data->reflected(i, o);
    for (int channel = 0; channel < 3; ++channel) {
      worst = std::max(worst, std::abs(found[channel] / expected[channel] - 1.0));
    }
  }
  CHECK(worst < 0.01);

  // At the peak, and with one direction in each other's place.
  const glm::dvec3 up(0.0, 0.0, 1.0);
  CHECK(glm::length(data->reflected(up, up) - smooth(up, up)) < 2e-3);
  const glm::dvec3 a = from_angles(0.6, 0.3);
  const glm::dvec3 b = from_angles(0.7, 3.0);
  CHECK(data->reflected(a, b).x / a.z == doctest::Approx(data->reflected(b, a).x / b.z));
}

TEST_CASE("Numbers that a MERL file does not have take no part in the interpolation") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<char> bytes = testing::merl_file([](auto&&...) { return glm::dvec3(0.5); });
  const TemporaryFile file(".binary");
  file.write(bytes);
  const std::size_t below = read_merl(file.path())->clamped();
  // θ_h in bin 10, θ_d in bin 20: far from the horizon whatever φ_d is.
  const std::size_t row = (10 * 90 + 20) * 180;
  std::size_t put_in = 0;
  for (std::size_t p = 0; p < 180; p += 2) {
    for (std::size_t channel = 0; channel < 3; ++channel, ++put_in) {
      const double bad[] = {kNan, kInfinity, -kInfinity, -1.0, 1e300};
      put(bytes, channel * kMerlBins + row + p, bad[put_in % 5]);
    }
  }
  file.write(bytes);
  const auto data = read_merl(file.path());
  CHECK(data->clamped() == below + put_in);
  testing::Uniform uniform(2);
  for (int n = 0; n < 20000; ++n) {
    const glm::dvec3 i = uniform.direction_above();
    const glm::dvec3 o = uniform.direction_above();
    const glm::dvec3 value = data->reflected(i, o) / i.z;
    if (i.z < 0.05 || o.z < 0.05) continue;
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(value[channel] == doctest::Approx(0.5).epsilon(1e-6));
    }
  }
}

TEST_CASE("A file that is not MERL's is refused by name and reason") {
  const TemporaryFile file(".binary");
  const auto refused = [&](const std::vector<char>& bytes, const std::string& reason) {
    file.write(bytes);
    CHECK_THROWS_WITH_AS(read_merl(file.path()), (file.path() + ": " + reason).c_str(),
                         MeasuredFileError);
  };
  refused({}, "ends before the end of a MERL file's header");
  refused({'a', 'b', 'c'}, "ends before the end of a MERL file's header");

  std::vector<char> sizes(64, 0);
  const std::int32_t huge[] = {2147483647, 2147483647, 2147483647};
  std::memcpy(sizes.data(), huge, sizeof huge);
  refused(sizes,
          "is not a MERL file: its sizes are (2147483647, 2147483647, 2147483647), not (90, 90, "
          "180)");
  const std::int32_t other[] = {90, -90, 360};
  std::memcpy(sizes.data(), other, sizeof other);
  refused(sizes, "is not a MERL file: its sizes are (90, -90, 360), not (90, 90, 180)");

  const std::int32_t right[] = {90, 90, 180};
  std::memcpy(sizes.data(), right, sizeof right);
  refused(sizes, "is not a whole MERL file: it has 64 bytes instead of 34992012");
  std::vector<char> dark(kMerlHeader + 3 * kMerlBins * sizeof(double), 0);
  std::memcpy(dark.data(), right, sizeof right);
  refused(dark, "holds no positive number");
  dark.push_back(0);
  refused(dark, "is not a whole MERL file: it has 34992013 bytes instead of 34992012");

  CHECK_THROWS_WITH_AS(read_merl("/nowhere/at/all.binary"), "/nowhere/at/all.binary: no such file",
                       MeasuredFileError);
  const std::string folder = file.path().substr(0, file.path().find_last_of('/'));
  CHECK_THROWS_WITH_AS(read_merl(folder), (folder + ": is a folder, not a file").c_str(),
                       MeasuredFileError);
}

}  // namespace
}  // namespace lobelight
