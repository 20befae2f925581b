#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "sg/mixture.h"

namespace lobelight {

// The lobes of a BRDF over the view direction, stored by half-vector: in these coordinates lobes
// hardly move with the view, so neighbouring views can be interpolated.
//
// Views: elevation θ_t = t / (T − 1) · kMaxElevation from the normal, t = 0 … T − 1; azimuth
// φ_p = p / (P − 1) · 90°, p = 0 … P − 1. P = 1 is an isotropic table, its views in the half-plane
// y = 0, x ≥ 0.
class LobeTable {
 public:
  // 89.4°: Ward's albedo diverges at the horizon, so the last view stops short of it.
  static constexpr double kMaxElevation = 89.4 * 3.14159265358979323846 / 180.0;
  // Range of the stored log2(κ (o·h)).
  static constexpr double kMinLog2Kappa = -10.0;
  static constexpr double kMaxLog2Kappa = 27.0;

  // What a texel holds: the half-vector's slopes divided by alpha, log2(κ (o·h)) and the weight.
  using Entry = glm::dvec4;

  // A table of zeros. `alpha` > 0, `lobes` ≥ 1, `views` = (T ≥ 2, P ≥ 1); throws
  // std::invalid_argument otherwise.
  LobeTable(const glm::dvec2& alpha, int lobes, const glm::ivec2& views);

  const glm::dvec2& alpha() const { return alpha_; }
  int lobes() const { return lobes_; }
  const glm::ivec2& views() const { return views_; }
  bool is_isotropic() const { return views_.y == 1; }

  // Unit vector of view (t, p).
  glm::dvec3 view(int t, int p) const;

  const Entry& entry(int lobe, int t, int p) const { return entries_[index(lobe, t, p)]; }

  // The lobes stored for view (t, p), and their storing; `mixture` has lobes() lobes whose means
  // are above the horizon. Lobe k of neighbouring views should be the same lobe.
  Mixture mixture_at_view(int t, int p) const;
  void set_mixture_at_view(int t, int p, const Mixture& mixture);

  // The lobes for any unit vector o, as the shader finds them: anisotropic tables fold o into the
  // first quadrant of azimuth and mirror the slopes back, isotropic ones are read in the frame
  // whose x axis is o's projection; entries are interpolated bilinearly. A view beyond the last
  // elevation, or below the horizon, is the view of the last elevation and (almost) its azimuth.
  Mixture interpolate(const glm::dvec3& direction) const;

  // Texture: width T, height lobes · P, row k · P + p, column t; four half floats a texel.
  int width() const { return views_.x; }
  int height() const { return lobes_ * views_.y; }
  std::vector<std::uint16_t> to_rgba16f() const;

  // Inverse of to_rgba16f(), up to its rounding. Throws std::invalid_argument when `texels` does
  // not hold 4 · T · lobes · P finite numbers.
  static LobeTable from_rgba16f(const glm::dvec2& alpha, int lobes, const glm::ivec2& views,
                                const std::vector<std::uint16_t>& texels);

 private:
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
};

}  // namespace lobelight
