#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"

namespace lobelight {

struct BrdfSample {
  glm::dvec3 direction;  // incoming light, unit, above the horizon
  double weight;         // ρ(i, o) · i_z / pdf
  double pdf;            // density of `direction` over solid angle, 1/sr
};

// A reflectance in the tangent frame: x = tangent, y = bitangent, z = normal. `i` points to the
// light, `o` to the viewer; both are unit vectors. Fresnel's factor is 1 in the models: whoever
// shades multiplies by it. Every BRDF here is its own mirror image in the planes x = 0 and y = 0.
class Brdf {
 public:
  virtual ~Brdf() = default;

  // ρ(i, o) in 1/sr, without the cosine; 0 where either direction is at or below the horizon.
  virtual double evaluate(const glm::dvec3& i, const glm::dvec3& o) const = 0;

  // A light direction for the viewer at `o`, u uniform in [0, 1)². Nothing where the sample falls
  // below the horizon: such a sample counts, with value 0.
  virtual std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const = 0;

  // Density of sample() at `i` in 1/sr, 0 below the horizon. It integrates to less than 1 by the
  // share of samples that fall below.
  virtual double pdf(const glm::dvec3& i, const glm::dvec3& o) const = 0;

  virtual std::string_view name() const = 0;

  // Widths along x and y.
  glm::dvec2 alpha() const { return alpha_; }

  // Whether only the difference of the azimuths counts.
  virtual bool is_isotropic() const { return alpha_.x == alpha_.y; }

  // The three channels of a coloured reflectance, whose mean evaluate() is; others have none.
  virtual bool is_coloured() const { return false; }
  virtual glm::dvec3 evaluate_rgb(const glm::dvec3& i, const glm::dvec3& o) const {
    return glm::dvec3(evaluate(i, o));
  }

 protected:
  explicit Brdf(const glm::dvec2& alpha) : alpha_(alpha) {}

 private:
  glm::dvec2 alpha_;
};

// Names that make_brdf() knows, in the order in which messages list them.
const std::vector<std::string>& brdf_names();

// Whether the model called `name` is isotropic for any width: its two widths must then be equal,
// and at most 1.
bool is_always_isotropic(std::string_view name);

// Widths that make_brdf() accepts on each axis.
constexpr double kMinAlpha = 1e-4;
constexpr double kMaxAlpha = 2.0;

// Throws std::invalid_argument with a whole sentence for a name that make_brdf() does not know and
// for widths that it refuses; the one place that says which ones are valid. Files are not read.
void validate_brdf(std::string_view name, const glm::dvec2& alpha);

// The model called `name`, or the measurements in the file of that path (is_measured_file()).
// Throws what validate_brdf() does for a name that brdf_names() does not list and for a width that
// is not in [kMinAlpha, kMaxAlpha], and MeasuredFileError. For files, `alpha` may
// be (0, 0): the widths are then estimated; what a file reflects does not depend on them. Files
// take a while to read: throws Cancelled when `progress`, which may be null, is cancelled.
std::unique_ptr<Brdf> make_brdf(std::string_view name, const glm::dvec2& alpha,
                                const Progress* progress = nullptr);

}  // namespace lobelight
