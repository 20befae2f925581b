#include "fit/mirror.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lobelight {

Mirror match_images(const Mixture& mixture, int axis) {
  const std::size_t count = mixture.size();
  constexpr int kNone = -1;
  Mirror mirror{axis, std::vector<int>(count, kNone)};
  const auto is_free = [&](std::size_t k) { return mirror.image[k] == kNone; };
  for (;;) {
    double best = std::numeric_limits<double>::infinity();
    std::size_t best_a = count;
    std::size_t best_b = count;
    for (std::size_t a = 0; a < count; ++a) {
      if (!is_free(a)) continue;
      const glm::dvec3 wanted = reflected(mixture[a].gaussian.mean, axis);
      for (std::size_t b = a; b < count; ++b) {
        if (!is_free(b)) continue;
        const glm::dvec3 d = mixture[b].gaussian.mean - wanted;
        const double distance = glm::dot(d, d);
        if (distance < best) {
          best = distance;
          best_a = a;
          best_b = b;
        }
      }
    }
    if (best_a == count) return mirror;
    mirror.image[best_a] = static_cast<int>(best_b);
    mirror.image[best_b] = static_cast<int>(best_a);
  }
}

void symmetrise(Mixture& mixture, const std::vector<Mirror>& mirrors) {
  for (const Mirror& mirror : mirrors) {
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      const auto image = static_cast<std::size_t>(mirror.image[k]);
      if (image < k) continue;  // done with it
      Lobe& own = mixture[k];
      Lobe& other = mixture[image];
      const glm::dvec3 mean = own.gaussian.mean;
      own.weight = other.weight = 0.5 * (own.weight + other.weight);
      own.gaussian.kappa = other.gaussian.kappa = 0.5 * (own.gaussian.kappa + other.gaussian.kappa);
      own.gaussian.mean = glm::normalize(mean + reflected(other.gaussian.mean, mirror.axis));
      if (image != k) {
        other.gaussian.mean = glm::normalize(other.gaussian.mean + reflected(mean, mirror.axis));
      }
    }
  }
}

MovingMirror::MovingMirror(Mirror mirror)
    : axis_(mirror.axis), image_(std::move(mirror.image)), merged_(image_.size(), false) {}

MovingMirror MovingMirror::recognise(const Mixture& mixture, int axis) {
  MovingMirror mirror(match_images(mixture, axis));
  const std::size_t count = mixture.size();
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count && mirror.image_[a] == static_cast<int>(a); ++b) {
      if (mirror.image_[b] != static_cast<int>(b) || mixture[a].weight != mixture[b].weight ||
          mixture[a].gaussian.mean != mixture[b].gaussian.mean ||
          mixture[a].gaussian.kappa != mixture[b].gaussian.kappa) {
        continue;
      }
      mirror.image_[a] = static_cast<int>(b);
      mirror.image_[b] = static_cast<int>(a);
      mirror.merged_[a] = mirror.merged_[b] = true;
    }
  }
  return mirror;
}

void MovingMirror::advance(Mixture& mixture) {
  glm::dvec3 normal(0.0);
  normal[axis_] = 1.0;
  for (std::size_t k = 0; k < image_.size(); ++k) {
    const auto other = static_cast<std::size_t>(image_[k]);
    if (other <= k) continue;
    const SphericalGaussian gaussian = mixture[k].gaussian;
    if (merged_[k]) {
      // Half a standard deviation to either side of where they met; a nearly uniform lobe has none.
      const double width = 1.0 / std::sqrt(std::max(gaussian.kappa, 1.0));
      const glm::dvec3 step = 0.5 * width * glm::cross(normal, gaussian.mean);
      mixture[k].gaussian.mean = glm::normalize(gaussian.mean + step);
      mixture[other].gaussian.mean = glm::normalize(gaussian.mean - step);
      merged_[k] = merged_[other] = false;
      image_[k] = static_cast<int>(k);
      image_[other] = static_cast<int>(other);
    } else {
      const double distance = std::sqrt(gaussian.kappa) * std::abs(gaussian.mean[axis_]);
      merged_[k] = merged_[other] = distance < kMergeDistance;
    }
  }
  symmetrise(mixture, mirrors());
}

std::vector<Mirror> MovingMirror::mirrors() const {
  // The second mirror puts merged lobes on the plane, where the images that the first one makes of
  // them are alike; it finds all others as the first one left them.
  Mirror on_plane{axis_, image_};
  for (std::size_t k = 0; k < image_.size(); ++k) {
    if (merged_[k]) on_plane.image[k] = static_cast<int>(k);
  }
  return {{axis_, image_}, on_plane};
}

}  // namespace lobelight
