#include "stability_byte_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lobelight::stability {

namespace {

// [0, 1] to a byte, and back.
std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

double from_byte(std::uint8_t byte) { return byte / 255.0; }

// Non-negative shares of 1 in units of 1/255 whose sum is 255: rounded down, and the units that
// are left go to those that lost most.
std::vector<std::uint8_t> round_shares(const std::vector<double>& shares) {
  std::vector<std::uint8_t> rounded;
  std::vector<double> lost;
  int left = 255;
  for (const double share : shares) {
    const double whole = std::floor(255.0 * share);
    rounded.push_back(static_cast<std::uint8_t>(whole));
    lost.push_back(255.0 * share - whole);
    left -= static_cast<int>(whole);
  }
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lost[a] > lost[b]; });
  for (std::size_t n = 0; n < order.size() && left > 0; ++n, --left) ++rounded[order[n]];
  return rounded;
}

}  // namespace

ByteTable::ByteTable(const LobeTable& table) : lobes_(table.lobes()), views_(table.views()) {
  least_log2_kappa_ = LobeTable::kMaxLog2Kappa;
  double largest = LobeTable::kMinLog2Kappa;
  for (int p = 0; p < views_.y; ++p) {
    for (int t = 0; t < views_.x; ++t) {
      double albedo = 0.0;
      for (int k = 0; k < lobes_; ++k) {
        least_log2_kappa_ = std::min(least_log2_kappa_, table.entry(k, t, p).z);
        largest = std::max(largest, table.entry(k, t, p).z);
        albedo += table.entry(k, t, p).w;
      }
      albedo_.push_back(albedo);
    }
  }
  log2_kappa_range_ = std::max(largest - least_log2_kappa_, 1e-3);

  for (int p = 0; p < views_.y; ++p) {
    for (int t = 0; t < views_.x; ++t) {
      const double albedo = albedo_[view(t, p)];
      std::vector<double> shares;
      for (int k = 0; k < lobes_; ++k) {
        shares.push_back(albedo > 0.0 ? table.entry(k, t, p).w / albedo : 1.0 / lobes_);
      }
      const std::vector<std::uint8_t> rounded = round_shares(shares);
      for (int k = 0; k < lobes_; ++k) {
        const LobeTable::Entry& e = table.entry(k, t, p);
        bytes_.push_back({to_byte(0.5 + 0.5 * e.x / kLargestSlope),
                          to_byte(0.5 + 0.5 * e.y / kLargestSlope),
                          to_byte((e.z - least_log2_kappa_) / log2_kappa_range_),
                          rounded[static_cast<std::size_t>(k)]});
      }
    }
  }
}

glm::vec4 ByteTable::texel(int lobe, int t, int p) const {
  const std::size_t v = view(t, p);
  const auto& b = bytes_[v * static_cast<std::size_t>(lobes_) + static_cast<std::size_t>(lobe)];
  return {(2.0 * from_byte(b[0]) - 1.0) * kLargestSlope,
          (2.0 * from_byte(b[1]) - 1.0) * kLargestSlope,
          least_log2_kappa_ + from_byte(b[2]) * log2_kappa_range_, from_byte(b[3]) * albedo_[v]};
}

}  // namespace lobelight::stability
