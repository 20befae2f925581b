#include "fit/mirror.h"

#include <cmath>
#include <limits>

namespace lobelight {

std::vector<int> match_images(const Mixture& mixture, glm::dvec3 (*mirrored)(const glm::dvec3&)) {
  const int count = static_cast<int>(mixture.size());
  std::vector<int> image(mixture.size(), -1);
  // The best pairs first, so that a lobe on the plane does not take another's partner.
  for (;;) {
    double best = std::numeric_limits<double>::infinity();
    int best_a = -1;
    int best_b = -1;
    for (int a = 0; a < count; ++a) {
      if (image[static_cast<std::size_t>(a)] >= 0) continue;
      const glm::dvec3 wanted = mirrored(mixture[static_cast<std::size_t>(a)].gaussian.mean);
      for (int b = a; b < count; ++b) {
        if (image[static_cast<std::size_t>(b)] >= 0) continue;
        const glm::dvec3 d = mixture[static_cast<std::size_t>(b)].gaussian.mean - wanted;
        const double distance = glm::dot(d, d);
        if (distance < best) {
          best = distance;
          best_a = a;
          best_b = b;
        }
      }
    }
    if (best_a < 0) return image;
    image[static_cast<std::size_t>(best_a)] = best_b;
    image[static_cast<std::size_t>(best_b)] = best_a;
  }
}

namespace {

void average_with_images(Mixture& mixture, const std::vector<int>& image,
                         glm::dvec3 (*mirrored)(const glm::dvec3&)) {
  if (image.empty()) return;
  const Mixture before = mixture;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const Lobe& other = before[static_cast<std::size_t>(image[k])];
    Lobe& lobe = mixture[k];
    lobe.weight = 0.5 * (lobe.weight + other.weight);
    lobe.gaussian.kappa = 0.5 * (lobe.gaussian.kappa + other.gaussian.kappa);
    lobe.gaussian.mean = glm::normalize(0.5 * (lobe.gaussian.mean + mirrored(other.gaussian.mean)));
  }
}

}  // namespace

void symmetrise(Mixture& mixture, const MirrorPairs& pairs) {
  average_with_images(mixture, pairs.x, mirrored_x);
  average_with_images(mixture, pairs.y, mirrored_y);
}

void split_merged_pairs(Mixture& mixture, std::vector<int>& image, const glm::dvec3& normal,
                        double distance) {
  for (std::size_t k = 0; k < image.size(); ++k) {
    const auto other = static_cast<std::size_t>(image[k]);
    if (other <= k) continue;
    const SphericalGaussian& gaussian = mixture[k].gaussian;
    const double height = glm::dot(gaussian.mean, normal);
    if (!(height * height * gaussian.kappa < distance * distance)) continue;
    const glm::dvec3 middle = glm::normalize(gaussian.mean - height * normal);
    const glm::dvec3 step = 0.5 / std::sqrt(gaussian.kappa) * glm::cross(normal, middle);
    mixture[k].gaussian.mean = glm::normalize(middle + step);
    mixture[other].gaussian.mean = glm::normalize(middle - step);
    image[k] = static_cast<int>(k);
    image[other] = static_cast<int>(other);
  }
}

}  // namespace lobelight
