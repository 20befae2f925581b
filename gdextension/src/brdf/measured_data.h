#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace lobelight {

// What a file of measurements says, before anything is made of it. Directions as in Brdf; the three
// channels are linear RGB.
class MeasuredData {
 public:
  virtual ~MeasuredData() = default;

  // ρ(i, o) i_z, 1/sr, finite and ≥ 0; `i` and `o` above the horizon.
  virtual glm::dvec3 reflected(const glm::dvec3& i, const glm::dvec3& o) const = 0;

  // Whether only the difference of the two azimuths counts.
  virtual bool is_isotropic() const = 0;

  // Stored numbers that were negative or not finite and are left out (MERL) or count as 0 (RGL).
  virtual std::size_t clamped() const = 0;
};

}  // namespace lobelight
