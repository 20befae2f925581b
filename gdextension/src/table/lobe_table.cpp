#include "table/lobe_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/pi.h"
#include "table/half_float.h"
#include "table/half_vector.h"

namespace lobelight {

namespace {

constexpr double kLargestHalf = LobeTable::kMaxWeight;
constexpr double kHalfPi = 0.5 * kPi;

// cos(LobeTable::kMaxElevation)
constexpr double kLeastCosine = 0.0104717841162458;

double clamp_log2_kappa(double log2_kappa) {
  // A sharpness of 0 has the logarithm −∞, which becomes the bound.
  return std::clamp(log2_kappa, LobeTable::kMinLog2Kappa, LobeTable::kMaxLog2Kappa);
}

Lobe decode(const LobeTable::Entry& entry, const glm::dvec2& alpha, const glm::dvec3& o) {
  const HalfVectorLobe lobe{{entry.x * alpha.x, entry.y * alpha.y}, std::exp2(entry.z)};
  return {entry.w, from_half_vector(lobe, o)};
}

glm::dvec3 decode_channels(const LobeTable::Entry& first, const LobeTable::Entry& second) {
  // Rounding may make green slightly negative.
  return first.w * glm::dvec3(second.z, std::max(0.0, 3.0 - second.z - second.w), second.w);
}

// Grid cell of a real coordinate in [0, count − 1]: its lower node and the way to the next.
struct Cell {
  int first;
  int second;
  double fraction;
};

Cell locate(double coordinate, int count) {
  const double c = std::clamp(coordinate, 0.0, static_cast<double>(count - 1));
  const int first = std::min(static_cast<int>(c), std::max(count - 2, 0));
  return {first, std::min(first + 1, count - 1), c - first};
}

}  // namespace

LobeTable::LobeTable(const glm::dvec2& alpha, int lobes, const glm::ivec2& views)
    : alpha_(alpha), lobes_(lobes), views_(views) {
  if (!(alpha.x > 0.0) || !(alpha.y > 0.0) || !std::isfinite(alpha.x) || !std::isfinite(alpha.y)) {
    throw std::invalid_argument("A lobe table needs positive widths alpha.");
  }
  if (lobes < 1 || views.x < 2 || views.y < 1) {
    throw std::invalid_argument(
        "A lobe table needs at least one lobe, two elevations and one azimuth.");
  }
  entries_.assign(index(lobes_, 0, 0), Entry(0.0));
}

double LobeTable::elevation(double t) const {
  const double rest = 1.0 - t / (views_.x - 1);
  return kMaxElevation * (1.0 - rest * rest);
}

double LobeTable::column(double elevation) const {
  const double rest = std::clamp(1.0 - elevation / kMaxElevation, 0.0, 1.0);
  return (1.0 - std::sqrt(rest)) * (views_.x - 1);
}

glm::dvec3 LobeTable::view(int t, int p) const {
  const double angle = elevation(t);
  const double sine = std::sin(angle);
  // The ends of the quadrant lie exactly in the planes of symmetry.
  if (p == 0) return {sine, 0.0, std::cos(angle)};
  if (p == views_.y - 1) return {0.0, sine, std::cos(angle)};
  const double azimuth = kHalfPi * p / (views_.y - 1);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), std::cos(angle)};
}

Mixture LobeTable::mixture_at_view(int t, int p) const {
  const glm::dvec3 o = view(t, p);
  Mixture mixture;
  mixture.reserve(static_cast<std::size_t>(lobes_));
  for (int k = 0; k < lobes_; ++k) mixture.push_back(decode(entry(k, t, p), alpha_, o));
  return mixture;
}

Mixture LobeTable::smoothed_mixture_at_view(int t, int p) const {
  const glm::dvec3 o = view(t, p);
  Mixture mixture;
  mixture.reserve(static_cast<std::size_t>(lobes_));
  for (int k = 0; k < lobes_; ++k) {
    const Entry neighbours = 0.5 * (entry(k, t - 1, p) + entry(k, t + 1, p));
    mixture.push_back(decode(0.5 * (entry(k, t, p) + neighbours), alpha_, o));
  }
  return mixture;
}

void LobeTable::set_mixture_at_view(int t, int p, const Mixture& mixture) {
  if (mixture.size() != static_cast<std::size_t>(lobes_)) {
    throw std::invalid_argument("A view takes as many lobes as its table has.");
  }
  const glm::dvec3 o = view(t, p);
  for (int k = 0; k < lobes_; ++k) {
    const Lobe& lobe = mixture[static_cast<std::size_t>(k)];
    const HalfVectorLobe h = to_half_vector(lobe.gaussian, o);
    entries_[index(k, t, p)] = {h.slope.x / alpha_.x, h.slope.y / alpha_.y,
                                clamp_log2_kappa(std::log2(h.sharpness)), lobe.weight};
  }
}

LobeTable::View LobeTable::stored_view(int t, int p) const {
  View view;
  for (int k = 0; k < lobes_; ++k) {
    view.entries.push_back(entry(k, t, p));
    if (has_second_texels()) view.second_entries.push_back(second_entry(k, t, p));
  }
  return view;
}

void LobeTable::store_view(int t, int p, const View& view) {
  for (int k = 0; k < lobes_; ++k) {
    const auto lobe = static_cast<std::size_t>(k);
    entries_[index(k, t, p)] = view.entries.at(lobe);
    if (has_second_texels()) second_entries_[index(k, t, p)] = view.second_entries.at(lobe);
  }
}

std::vector<glm::dvec3> LobeTable::channel_weights_at_view(int t, int p) const {
  std::vector<glm::dvec3> weights;
  for (int k = 0; k < lobes_; ++k) {
    weights.push_back(decode_channels(entry(k, t, p), second_entry(k, t, p)));
  }
  return weights;
}

void LobeTable::set_channel_weights_at_view(int t, int p, const std::vector<glm::dvec3>& weights) {
  if (weights.size() != static_cast<std::size_t>(lobes_) || !has_second_texels()) {
    throw std::invalid_argument("A coloured view takes as many lobes as its table has.");
  }
  for (int k = 0; k < lobes_; ++k) {
    const glm::dvec3& rgb = weights[static_cast<std::size_t>(k)];
    const double mean = (rgb.x + rgb.y + rgb.z) / 3.0;
    entries_[index(k, t, p)].w = mean;
    Entry& second = second_entries_[index(k, t, p)];
    // A lobe without weight has any colour; white is the one that interpolates best.
    second.z = mean > 0.0 ? rgb.x / mean : 1.0;
    second.w = mean > 0.0 ? rgb.z / mean : 1.0;
  }
}

struct LobeTable::Place {
  Cell t;
  Cell p;
  glm::dvec2 x_axis;
  glm::dvec2 y_axis;
  glm::dvec3 view;  // in the frame of the entries

  template <typename Read>
  Entry read(const Read& entry_at) const {
    const Entry low = glm::mix(entry_at(t.first, p.first), entry_at(t.second, p.first), t.fraction);
    const Entry high =
        glm::mix(entry_at(t.first, p.second), entry_at(t.second, p.second), t.fraction);
    return glm::mix(low, high, p.fraction);
  }
};

LobeTable::Place LobeTable::locate_view(const glm::dvec3& direction) const {
  const glm::dvec3 o =
      glm::normalize(glm::dvec3(direction.x, direction.y, std::max(direction.z, kLeastCosine)));
  const double sine = std::hypot(o.x, o.y);
  Place place;
  place.t = locate(column(std::atan2(sine, o.z)), views_.x);

  // The frame in which the entries hold: table axes (x, y) = ±(o.x, o.y) as signs, or o's
  // projection.
  place.x_axis = {o.x < 0.0 ? -1.0 : 1.0, 0.0};
  place.y_axis = {0.0, o.y < 0.0 ? -1.0 : 1.0};
  place.p = {0, 0, 0.0};
  if (is_isotropic()) {
    place.x_axis = sine > 0.0 ? glm::dvec2(o.x, o.y) / sine : glm::dvec2(1.0, 0.0);
    place.y_axis = {-place.x_axis.y, place.x_axis.x};
  } else {
    place.p = locate(std::atan2(std::abs(o.y), std::abs(o.x)) / kHalfPi * (views_.y - 1), views_.y);
  }
  place.view = {glm::dot(place.x_axis, glm::dvec2(o)), glm::dot(place.y_axis, glm::dvec2(o)), o.z};
  return place;
}

Mixture LobeTable::interpolate(const glm::dvec3& direction) const {
  const Place place = locate_view(direction);
  Mixture mixture;
  mixture.reserve(static_cast<std::size_t>(lobes_));
  for (int k = 0; k < lobes_; ++k) {
    const Entry read = place.read([&](int t, int p) { return entry(k, t, p); });
    Lobe lobe = decode(read, alpha_, place.view);
    const glm::dvec3 mean = lobe.gaussian.mean;
    lobe.gaussian.mean = glm::dvec3(mean.x * place.x_axis + mean.y * place.y_axis, mean.z);
    mixture.push_back(lobe);
  }
  return mixture;
}

std::vector<glm::dvec3> LobeTable::interpolate_channel_weights(const glm::dvec3& direction) const {
  const Place place = locate_view(direction);
  std::vector<glm::dvec3> weights;
  for (int k = 0; k < lobes_; ++k) {
    weights.push_back(
        decode_channels(place.read([&](int t, int p) { return entry(k, t, p); }),
                        place.read([&](int t, int p) { return second_entry(k, t, p); })));
  }
  return weights;
}

std::vector<std::uint16_t> LobeTable::to_rgba16f() const {
  std::vector<std::uint16_t> texels;
  texels.reserve(4 * (entries_.size() + second_entries_.size()));
  for (const std::vector<Entry>* entries : {&entries_, &second_entries_}) {
    for (const Entry& entry : *entries) {
      for (int channel = 0; channel < 4; ++channel) {
        if (std::isnan(entry[channel])) {
          throw std::logic_error("A lobe table holds something that is not a number.");
        }
        texels.push_back(half_from_double(std::clamp(entry[channel], -kLargestHalf, kLargestHalf)));
      }
    }
  }
  return texels;
}

LobeTable LobeTable::from_rgba16f(const glm::dvec2& alpha, int lobes, const glm::ivec2& views,
                                  const std::vector<std::uint16_t>& texels) {
  LobeTable table(alpha, lobes, views);
  const std::size_t count = table.entries_.size();
  if (texels.size() == 8 * count) table.add_second_texels();
  if (texels.size() != 4 * (count + table.second_entries_.size())) {
    throw std::invalid_argument("The texels do not have the size of the lobe table.");
  }
  for (std::size_t n = 0; n < texels.size(); ++n) {
    const double value = double_from_half(texels[n]);
    if (!std::isfinite(value)) {
      throw std::invalid_argument("The texels of a lobe table must be finite numbers.");
    }
    Entry& entry = n < 4 * count ? table.entries_[n / 4] : table.second_entries_[n / 4 - count];
    entry[static_cast<int>(n % 4)] = value;
  }
  return table;
}

}  // namespace lobelight
