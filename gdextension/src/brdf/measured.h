#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "brdf/brdf.h"
#include "brdf/gridded.h"
#include "brdf/measured_data.h"

namespace lobelight {

// Whether make_brdf() takes this for the path of a file of measurements: it has a folder, or one of
// the endings .binary (MERL) and .bsdf (RGL).
bool is_measured_file(std::string_view name);

// Reads the file at `path` (UTF-8), which is an RGL file if it begins as one or ends in .bsdf, and
// a MERL file otherwise. Throws MeasuredFileError.
std::unique_ptr<MeasuredData> read_measured(const std::string& path);

// Measurements as a Brdf: a scalar one, the mean of the three channels, with colours beside it.
//
// Tables are mirrored in the planes x = 0 and y = 0, so the reflectance is the mean over the mirror
// images of the measured one (two for isotropic data, four otherwise); asymmetry() tells what that
// took away. Fresnel's factor is in the measurements: shade with a white reflectance at normal
// incidence.
//
// Samples come from half-vectors, tabulated for views of a grid and blended between them as Dupuy
// and Jakob 2018 blend theirs.
class MeasuredBrdf final : public Brdf {
 public:
  // Widths at `alpha` = (0, 0): estimate_widths(). Throws Cancelled when `progress`, which may be
  // null, is cancelled.
  MeasuredBrdf(std::unique_ptr<MeasuredData> data, std::string name,
               const glm::dvec2& alpha = {0.0, 0.0}, const Progress* progress = nullptr);

  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override;
  glm::dvec3 evaluate_rgb(const glm::dvec3& i, const glm::dvec3& o) const override;
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override;
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override;
  std::string_view name() const override { return name_; }
  bool is_isotropic() const override { return data_->is_isotropic(); }
  // False where the channels differ by less than 0.1 % of the reflected light.
  bool is_coloured() const override { return is_coloured_; }

  // Stored numbers that were negative or not finite.
  std::size_t clamped() const { return data_->clamped(); }

  // Mean distance of a mirror image from the mean over all, as a share of the reflected light; mean
  // over the views.
  double asymmetry() const { return asymmetry_; }

 private:
  struct Place;

  Place place_view(const glm::dvec3& o) const;
  double pdf_of_half_vector(const glm::dvec2& point, double o_dot_h, const Place& place) const;
  void tabulate_samples(const Progress* progress);

  std::unique_ptr<MeasuredData> data_;
  std::string name_;
  ParameterGrid views_;  // azimuth and elevation of the tabulated views
  std::unique_ptr<GriddedDistribution> half_vectors_;
  double asymmetry_ = 0.0;
  bool is_coloured_ = false;
};

// The widths of the reflectance's central part at normal incidence, as Ward's and Beckmann's alpha.
//
// With o = n, ρ(i, n) i_z · 4 h_z⁴ is a density p(s) of the half-vector's slopes, up to a factor:
// for microfacets D(h) h_z⁴ times masking. Were p = e^{−(s_x/α_x)² − (s_y/α_y)²}, the mean of
// (s_x/α_x)² over the ellipse of radius R = 1.5 in these units would be
//   m(R) = ½ (1 − R² e^{−R²} / (1 − e^{−R²}))
// and the widths are those for which both means have this value, found by iteration from the
// half-width at half maximum. Tails and diffuse light beyond the ellipse do not count. Isotropic
// data get equal widths; results are in [kMinAlpha, 1].
// Throws Cancelled when `progress`, which may be null, is cancelled.
glm::dvec2 estimate_widths(const MeasuredData& data, const Progress* progress = nullptr);

}  // namespace lobelight
