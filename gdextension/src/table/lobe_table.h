#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/pi.h"
#include "sg/mixture.h"

namespace lobelight {

// The lobes of a BRDF over the view direction. They are stored by half-vector
// (table/half_vector.h): in that form they hardly move with the view, so neighbouring views can be
// interpolated.
//
// Views: elevation from the normal
//   θ_t = (1 − (1 − τ)²) · kMaxElevation,  τ = t / (T − 1),  t = 0 … T − 1,
// denser towards grazing, where slices change faster; azimuth φ_p = p / (P − 1) · 90°,
// p = 0 … P − 1. P = 1 is an isotropic table, its views in the half-plane
// y = 0, x ≥ 0.
class LobeTable {
 public:
  // 89.4°: Ward's albedo diverges at the horizon, so the last view stops short of it.
  static constexpr double kMaxElevation = 89.4 * kPi / 180.0;
  // Range of the stored log2(κ (o·h)).
  static constexpr double kMinLog2Kappa = -10.0;
  static constexpr double kMaxLog2Kappa = 27.0;

  // Range of the weights that texels hold.
  static constexpr double kMinWeight = 0x1p-24;
  static constexpr double kMaxWeight = 65504.0;

  // What a texel holds: the half-vector's slopes divided by alpha, log2(κ (o·h)) and the weight.
  using Entry = glm::dvec4;

  // Coloured tables have a second texel for each lobe: (0, 0, tint_r, tint_b); the first two
  // numbers are not used. If w is the first texel's weight, the weights of red, green and blue are
  // w tint_r, w (3 − tint_r − tint_b) and w tint_b; their mean is w.
  static constexpr Entry kPlain{0.0, 0.0, 1.0, 1.0};  // colourless

  // A table of zeros. `alpha` > 0, `lobes` ≥ 1, `views` = (T ≥ 2, P ≥ 1); throws
  // std::invalid_argument otherwise.
  LobeTable(const glm::dvec2& alpha, int lobes, const glm::ivec2& views);

  const glm::dvec2& alpha() const { return alpha_; }
  int lobes() const { return lobes_; }
  const glm::ivec2& views() const { return views_; }
  bool is_isotropic() const { return views_.y == 1; }

  // The elevation of column t, and its inverse: the real column in [0, T − 1] of an elevation.
  double elevation(double t) const;
  double column(double elevation) const;

  // Unit vector of view (t, p).
  glm::dvec3 view(int t, int p) const;

  const Entry& entry(int lobe, int t, int p) const { return entries_[index(lobe, t, p)]; }

  // Whether lobes have a second texel; add_second_texels() gives plain ones to those that have not.
  bool has_second_texels() const { return !second_entries_.empty(); }
  void add_second_texels() { second_entries_.resize(entries_.size(), kPlain); }
  const Entry& second_entry(int lobe, int t, int p) const {
    return has_second_texels() ? second_entries_[index(lobe, t, p)] : kPlain;
  }

  // The lobes stored for view (t, p), and their storing; `mixture` has lobes() lobes whose means
  // are above the horizon. Lobe k of neighbouring views should be the same lobe.
  Mixture mixture_at_view(int t, int p) const;
  void set_mixture_at_view(int t, int p, const Mixture& mixture);

  // All entries of a view, to be copied to another view unchanged.
  struct View {
    std::vector<Entry> entries;
    std::vector<Entry> second_entries;
  };
  View stored_view(int t, int p) const;
  void store_view(int t, int p, const View& view);

  // The lobes whose entries are a mean over three elevations: view (t, p) with a share of 1/2, the
  // views before and after it with 1/4 each. 0 < t < T − 1.
  Mixture smoothed_mixture_at_view(int t, int p) const;

  // The lobes for any unit vector o, as the shader finds them. Anisotropic tables fold o into the
  // first quadrant of azimuths and mirror the slopes back; isotropic tables are read in the frame
  // whose x axis is o's projection. Entries are interpolated bilinearly. A view beyond the last
  // elevation, or below the horizon, is taken for the view of the last elevation and (almost) the
  // same azimuth.
  Mixture interpolate(const glm::dvec3& direction) const;

  // Reads and stores the lobes' weights in the three channels, at view (t, p). Storing needs a
  // table with second texels, and sets each lobe's weight to the mean of the three.
  std::vector<glm::dvec3> channel_weights_at_view(int t, int p) const;
  void set_channel_weights_at_view(int t, int p, const std::vector<glm::dvec3>& weights);

  // The channels' weights of the lobes that interpolate() gives.
  std::vector<glm::dvec3> interpolate_channel_weights(const glm::dvec3& direction) const;

  // Texture: width T, column t; lobes · P rows of first texels, row k · P + p, and below them as
  // many rows of second texels in tables that have them; four half floats a texel. Throws
  // std::logic_error for NaN: no bake saves such a table.
  int width() const { return views_.x; }
  int height() const { return lobes_ * views_.y * (has_second_texels() ? 2 : 1); }
  std::vector<std::uint16_t> to_rgba16f() const;

  // Inverse of to_rgba16f(), up to its rounding. Throws std::invalid_argument when `texels` does
  // not hold 4 · T · lobes · P finite numbers, or twice as many.
  static LobeTable from_rgba16f(const glm::dvec2& alpha, int lobes, const glm::ivec2& views,
                                const std::vector<std::uint16_t>& texels);

 private:
  // Where a view is read: its cells of the grid, and the frame in which the entries hold.
  struct Place;
  Place locate_view(const glm::dvec3& direction) const;

  std::size_t index(int lobe, int t, int p) const {
    return (static_cast<std::size_t>(lobe) * static_cast<std::size_t>(views_.y) +
            static_cast<std::size_t>(p)) *
               static_cast<std::size_t>(views_.x) +
           static_cast<std::size_t>(t);
  }

  glm::dvec2 alpha_;
  int lobes_;
  glm::ivec2 views_;
  std::vector<Entry> entries_;
  std::vector<Entry> second_entries_;  // as many, or none
};

}  // namespace lobelight
