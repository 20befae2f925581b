#include "brdf/merl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "base/pi.h"
#include "brdf/binary_file.h"

namespace lobelight {

namespace {

constexpr int kThetaHalf = 90;
constexpr int kThetaDifference = 90;
constexpr int kPhiDifference = 180;
constexpr std::size_t kBins = std::size_t{kThetaHalf} * kThetaDifference * kPhiDifference;
constexpr std::uint64_t kHeaderBytes = 3 * sizeof(std::int32_t);
constexpr std::uint64_t kFileBytes = kHeaderBytes + 3 * kBins * sizeof(double);

// The units of the stored numbers, channel by channel.
constexpr std::array<double, 3> kScale{1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};

constexpr float kMissing = -1.0F;

// The two bins whose middles enclose a coordinate that counts bins from the edge of the first one.
struct Bins {
  int first;
  int second;
  double fraction;
};

Bins enclosing(double coordinate, int count) {
  const double c = std::clamp(coordinate - 0.5, 0.0, count - 1.0);
  const int first = std::min(static_cast<int>(c), count - 2);
  return {first, first + 1, c - first};
}

Bins enclosing_periodic(double coordinate, int count) {
  const double c = coordinate - 0.5;
  const int floor = static_cast<int>(std::floor(c));
  return {(floor + count) % count, (floor + 1) % count, c - floor};
}

class Merl final : public MeasuredData {
 public:
  Merl(std::vector<float> values, std::size_t clamped)
      : values_(std::move(values)), clamped_(clamped) {}

  glm::dvec3 reflected(const glm::dvec3& i, const glm::dvec3& o) const override;
  bool is_isotropic() const override { return true; }
  std::size_t clamped() const override { return clamped_; }

 private:
  std::vector<float> values_;  // channel, θ_h, θ_d, φ_d; 1/sr; kMissing where nothing is known
  std::size_t clamped_;
};

// S. Rusinkiewicz 1998, "A new change of variables for efficient BRDF representation": the
// half-vector's polar angle, and `i` in the frame whose z axis is the half-vector.
glm::dvec3 Merl::reflected(const glm::dvec3& i, const glm::dvec3& o) const {
  const glm::dvec3 sum = i + o;
  const double across = std::hypot(sum.x, sum.y);
  const double theta_half = std::atan2(across, sum.z);
  // i and o enclose 2 θ_d, so |i − o| = 2 sin θ_d and |i + o| = 2 cos θ_d.
  const double theta_difference = std::atan2(glm::length(i - o), glm::length(sum));
  const glm::dvec2 along = across > 0.0 ? glm::dvec2(sum) / across : glm::dvec2(1.0, 0.0);
  const double x =
      std::cos(theta_half) * glm::dot(along, glm::dvec2(i)) - std::sin(theta_half) * i.z;
  const double y = along.x * i.y - along.y * i.x;
  double phi_difference = std::atan2(y, x);
  if (phi_difference < 0.0) phi_difference += kPi;

  const Bins h = enclosing(std::sqrt(theta_half / (0.5 * kPi)) * kThetaHalf, kThetaHalf);
  const Bins d = enclosing(theta_difference / (0.5 * kPi) * kThetaDifference, kThetaDifference);
  const Bins p = enclosing_periodic(phi_difference / kPi * kPhiDifference, kPhiDifference);

  glm::dvec3 weighted(0.0);
  glm::dvec3 weight(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const bool far_h = (corner & 1) != 0;
    const bool far_d = (corner & 2) != 0;
    const bool far_p = (corner & 4) != 0;
    const double w = (far_h ? h.fraction : 1.0 - h.fraction) *
                     (far_d ? d.fraction : 1.0 - d.fraction) *
                     (far_p ? p.fraction : 1.0 - p.fraction);
    const int row = (far_h ? h.second : h.first) * kThetaDifference + (far_d ? d.second : d.first);
    const auto bin = static_cast<std::size_t>(row) * kPhiDifference +
                     static_cast<std::size_t>(far_p ? p.second : p.first);
    for (int channel = 0; channel < 3; ++channel) {
      const float value = values_[static_cast<std::size_t>(channel) * kBins + bin];
      if (value < 0.0F) continue;
      weighted[channel] += w * static_cast<double>(value);
      weight[channel] += w;
    }
  }
  glm::dvec3 result(0.0);
  for (int channel = 0; channel < 3; ++channel) {
    if (weight[channel] > 0.0) result[channel] = weighted[channel] / weight[channel] * i.z;
  }
  return result;
}

}  // namespace

std::unique_ptr<MeasuredData> read_merl(const std::string& path) {
  BinaryFile file(path);
  std::array<std::int32_t, 3> counts{};
  file.read(0, counts.data(), counts.size(), "a MERL file's header");
  if (counts[0] != kThetaHalf || counts[1] != kThetaDifference || counts[2] != kPhiDifference) {
    std::ostringstream reason;
    reason << "is not a MERL file: its sizes are (" << counts[0] << ", " << counts[1] << ", "
           << counts[2] << "), not (90, 90, 180)";
    file.fail(reason.str());
  }
  if (file.size() != kFileBytes) {
    std::ostringstream reason;
    reason << "is not a whole MERL file: it has " << file.size() << " bytes instead of "
           << kFileBytes;
    file.fail(reason.str());
  }

  std::vector<float> values(3 * kBins);
  std::vector<double> stored(kBins);
  std::size_t clamped = 0;
  std::size_t too_large = 0;
  bool dark = true;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    file.read(kHeaderBytes + channel * kBins * sizeof(double), stored.data(), kBins, "its numbers");
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      const double value = stored[bin] * kScale[channel];
      // Negated comparisons would let NaN through.
      const bool good = value >= 0.0 && value <= std::numeric_limits<float>::max();
      values[channel * kBins + bin] = good ? static_cast<float>(value) : kMissing;
      if (!good) ++clamped;
      if (!good && value > 0.0 && std::isfinite(value)) ++too_large;
      if (good && value > 0.0) dark = false;
    }
  }
  if (dark && too_large > 0) {
    file.fail("has " + std::to_string(too_large) +
              " numbers that are too large for a reflectance, and no other positive one");
  }
  if (dark) file.fail("holds no positive number");
  return std::make_unique<Merl>(std::move(values), clamped);
}

}  // namespace lobelight
