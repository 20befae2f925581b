#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace lobelight {

// Radiance from a direction and the density with which it is drawn.
struct EnvironmentSample {
  glm::dvec3 direction;
  glm::dvec3 radiance;
  double pdf;  // Per steradian.
};

// How much each cluster of a light counts at one surface point.
struct ClusterChoice {
  std::vector<double> cumulative;  // Probabilities of the clusters: clusters + 1 values, 0 to 1.
  std::vector<double> scale;       // Probability of each over its share of the light.

  bool empty() const { return scale.empty(); }
};

// What arrives at points of surfaces from all around, with densities over directions for importance
// sampling. Threads share it.
class IncomingLight {
 public:
  // What a surface makes of light from a unit vector in world space: at least 0.
  using Reflectance = std::function<double(const glm::dvec3& direction)>;

  virtual ~IncomingLight() = default;

  // The product of light and reflectance at a point, as far as clusters resolve it. Empty where it
  // is 0.
  virtual ClusterChoice choose(const glm::dvec3& point, const Reflectance& reflectance) const = 0;

  // Draws a direction; u in [0, 1)². The choice must not be empty, and that of the same point.
  virtual EnvironmentSample sample(const ClusterChoice& choice, const glm::dvec3& point,
                                   const glm::dvec2& u) const = 0;

  // Radiance and density (0 if the choice is empty) at a unit vector.
  virtual EnvironmentSample at(const ClusterChoice& choice, const glm::dvec3& point,
                               const glm::dvec3& direction) const = 0;
};

// A choice in proportion to `importance` (one value ≥ 0 each) times the clusters' shares of the
// light. Empty when all products are 0.
ClusterChoice choose_in_proportion(const std::vector<double>& importance,
                                   const std::vector<double>& shares);

// The density 1 − |x| on [−1, 1], which is that of a bilinear texel along an axis; u in [0, 1).
double sample_tent(double u);

}  // namespace lobelight
