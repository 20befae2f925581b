#include "fit/picture_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/pi.h"
#include "fit/pyramid_kernel.h"
#include "fit/slice.h"
#include "sg/spherical_gaussian.h"

namespace lobelight {

namespace {

constexpr int kTurns = 4;  // of each view against each light
constexpr int kNodesPerAxis = 48;
constexpr double kRotation = 0.5;  // other nodes than those of seed 0

// Points of a Kronecker sequence in several dimensions (Roberts 2018): `dimension` from 0 to 5.
double kronecker(int n, int dimension) {
  // Powers of a number near 1/x, x^7 = x + 1.
  constexpr double kStep = 0.89789110750;
  double step = 1.0;
  for (int i = 0; i <= dimension; ++i) step *= kStep;
  const double turns = 0.5 + n * step;
  return turns - std::floor(turns);
}

glm::dvec3 on_sphere(double u, double v) {
  const double z = 1.0 - 2.0 * u;
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(2.0 * kPi * v), r * std::sin(2.0 * kPi * v), z};
}

// Shoemake 1992, "Uniform random rotations": a unit quaternion from three numbers in [0, 1).
glm::dmat3 rotation(double u, double v, double w) {
  const double a = std::sqrt(1.0 - u);
  const double b = std::sqrt(u);
  const double x = a * std::sin(2.0 * kPi * v);
  const double y = a * std::cos(2.0 * kPi * v);
  const double z = b * std::sin(2.0 * kPi * w);
  const double c = b * std::cos(2.0 * kPi * w);
  return {{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * c), 2.0 * (x * z - y * c)},
          {2.0 * (x * y - z * c), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * c)},
          {2.0 * (x * z + y * c), 2.0 * (y * z - x * c), 1.0 - 2.0 * (x * x + y * y)}};
}

// A lamp or a window: a spherical Gaussian of radiance.
struct Lamp {
  glm::dvec3 direction;
  double variance;
  double flux;
};

enum Light { kLamps, kWindows, kLights };
constexpr int kMostLamps = 62;

std::vector<Lamp> made_up_light(std::size_t light) {
  std::vector<Lamp> lamps;
  // Adds `count` Gaussians. Deviations and radiances begin at the least ones and go up to so many
  // times as much, evenly in the logarithm. The ambient light has a radiance of about 1.
  const auto add = [&](int count, double deviation, double wider, double radiance,
                       double brighter) {
    for (int i = 0; i < count; ++i) {
      const int n = static_cast<int>(lamps.size()) + 1;
      const double own = deviation * std::pow(wider, kronecker(n, 2));
      lamps.push_back({on_sphere(kronecker(n, 0), kronecker(n, 1)), own * own,
                       2.0 * kPi * own * own * radiance * std::pow(brighter, kronecker(n, 3))});
    }
  };
  add(4, 0.7, 1.5, 0.6, 1.0);  // no light is even
  if (light == kLamps) {
    add(10, 0.06, 4.0, 2.0, 20.0);
    add(48, 0.01, 6.0, 3.0, 3000.0);
  } else {
    add(48, 0.012, 8.0, 1.5, 200.0);
  }
  return lamps;
}

constexpr double kAmbient = 0.5;
// A lamp is ignored where its density is below e to the power of minus this, relative to its peak.
constexpr double kDark = 18.0;

// ∫ L g of a planar Gaussian g of this variance; 0 for the light itself.
double light_under(const std::vector<Lamp>& lamps, const glm::dvec3& direction, double variance) {
  double sum = kAmbient;
  for (const Lamp& lamp : lamps) {
    const double kappa = 1.0 / (lamp.variance + variance);
    const glm::dvec3 d = direction - lamp.direction;
    const double exponent = 0.5 * kappa * glm::dot(d, d);
    if (exponent > kDark) continue;
    const double rest = kappa < 9.0 ? 1.0 - std::exp(-2.0 * kappa) : 1.0;
    sum += lamp.flux * kappa / (2.0 * kPi * rest) * std::exp(-exponent);
  }
  return sum;
}

// The light in a table: octahedral (Meyer et al. 2010), bilinear.
class LightMap {
 public:
  static constexpr int kSide = 512;
  // Texels in a block for which the lamps are chosen together; a bound of the chord from the
  // block's middle to any of its texels.
  static constexpr int kSegment = 16;
  static constexpr double kSegmentReach = 0.1;

  LightMap(const std::vector<Lamp>& lamps, int threads, const Progress& progress)
      : texels_(static_cast<std::size_t>(kSide + 1) * (kSide + 1)) {
    parallel_for(kSide + 1, threads, progress, [&](std::size_t row) {
      std::vector<Lamp> near;
      near.reserve(lamps.size());
      for (int column = 0; column <= kSide; ++column) {
        if (column % kSegment == 0) {
          near.clear();
          const glm::dvec3 middle = direction(column + kSegment / 2, static_cast<int>(row));
          for (const Lamp& lamp : lamps) {
            const double reach = kSegmentReach + std::sqrt(2.0 * kDark * lamp.variance);
            const glm::dvec3 d = middle - lamp.direction;
            if (glm::dot(d, d) < reach * reach) near.push_back(lamp);
          }
        }
        texels_[row * (kSide + 1) + static_cast<std::size_t>(column)] =
            static_cast<float>(light_under(near, direction(column, static_cast<int>(row)), 0.0));
      }
    });
  }

  double at(const glm::dvec3& d) const {
    const double scale = 1.0 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    double x = d.x * scale;
    double y = d.y * scale;
    if (d.z < 0.0) {
      const double folded = std::copysign(1.0 - std::abs(y), x);
      y = std::copysign(1.0 - std::abs(x), y);
      x = folded;
    }
    x = std::clamp(0.5 * (x + 1.0) * kSide, 0.0, static_cast<double>(kSide));
    y = std::clamp(0.5 * (y + 1.0) * kSide, 0.0, static_cast<double>(kSide));
    const int column = std::min(static_cast<int>(x), kSide - 1);
    const int row = std::min(static_cast<int>(y), kSide - 1);
    const double fx = x - column;
    const double fy = y - row;
    const float* texel = &texels_[static_cast<std::size_t>(row * (kSide + 1) + column)];
    const double upper =
        (1.0 - fx) * static_cast<double>(texel[0]) + fx * static_cast<double>(texel[1]);
    const double lower = (1.0 - fx) * static_cast<double>(texel[kSide + 1]) +
                         fx * static_cast<double>(texel[kSide + 2]);
    return (1.0 - fy) * upper + fy * lower;
  }

 private:
  // Of a texel; columns beyond the last one are as good for a middle.
  static glm::dvec3 direction(int column, int row) {
    const double x = 2.0 * std::min(column, kSide) / kSide - 1.0;
    const double y = 2.0 * row / kSide - 1.0;
    const double z = 1.0 - std::abs(x) - std::abs(y);
    if (z >= 0.0) return glm::normalize(glm::dvec3(x, y, z));
    return glm::normalize(
        glm::dvec3(std::copysign(1.0 - std::abs(y), x), std::copysign(1.0 - std::abs(x), y), z));
  }

  std::vector<float> texels_;
};

double reflected(const LightMap& light, const Slice& slice, const glm::dmat3& turn) {
  double sum = 0.0;
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    sum += slice.weights[n] * light.at(turn * slice.directions[n]);
  }
  return sum;
}

double drawn(const std::vector<Lamp>& lamps, const Mixture& lobes, const glm::dmat3& turn) {
  constexpr double kWidest = 16.0;
  double sum = 0.0;
  for (const Lobe& lobe : lobes) {
    const PyramidLevels levels = pyramid_levels(1.0 / std::max(lobe.gaussian.kappa, 1.0 / kWidest));
    const glm::dvec3 direction = turn * lobe.gaussian.mean;
    sum +=
        lobe.weight * ((1.0 - levels.coarser_share) * light_under(lamps, direction, levels.finer) +
                       levels.coarser_share * light_under(lamps, direction, 4.0 * levels.finer));
  }
  return sum;
}

double show(double exposed) { return std::pow(std::clamp(exposed, 0.0, 1.0), 1.0 / 2.2); }

}  // namespace

PictureError::PictureError(const Brdf& brdf, const glm::ivec2& views, int threads,
                           Progress& progress)
    : threads_(threads), progress_(progress) {
  const LobeTable grid(brdf.alpha(), 1, views);
  int n = 0;
  for (int p = 0; p < views.y - 1; ++p) {
    for (int t = 0; t < views.x - 1; ++t) {
      const double elevation = grid.elevation(t + 0.5);
      const double azimuth = 0.5 * kPi * (p + 0.5) / (views.y - 1);
      View view;
      view.direction = {std::sin(elevation) * std::cos(azimuth),
                        std::sin(elevation) * std::sin(azimuth), std::cos(elevation)};
      // Of the sphere seen from one side: sin θ cos θ dθ dφ.
      view.share =
          view.direction.z * std::sin(elevation) * (grid.elevation(t + 1.0) - grid.elevation(t));
      view.samples.reserve(kLights * kTurns);
      for (int turn = 0; turn < kLights * kTurns; ++turn) {
        ++n;
        view.samples.push_back({rotation(kronecker(n, 3), kronecker(n, 4), kronecker(n, 5)), 0.0});
      }
      views_.push_back(std::move(view));
    }
  }
  for (std::size_t light = 0; light < kLights; ++light) {
    const LightMap map(made_up_light(light), threads, progress);
    progress.set((static_cast<double>(light) + 0.5) / static_cast<double>(kLights));
    parallel_for(views_.size(), threads, progress, [&](std::size_t i) {
      View& view = views_[i];
      const Slice slice = sample_slice(brdf, view.direction, kNodesPerAxis, kRotation);
      for (std::size_t turn = light * kTurns; turn < (light + 1) * kTurns; ++turn) {
        view.samples[turn].shown = reflected(map, slice, view.samples[turn].turn);
      }
    });
    std::vector<double> radiances;
    radiances.reserve(views_.size() * kTurns);
    for (const View& view : views_) {
      for (std::size_t turn = light * kTurns; turn < (light + 1) * kTurns; ++turn) {
        radiances.push_back(view.samples[turn].shown);
      }
    }
    const auto middle = radiances.begin() + static_cast<std::ptrdiff_t>(radiances.size() / 2);
    std::nth_element(radiances.begin(), middle, radiances.end());
    exposures_[light] = *middle > 0.0 ? 0.18 / *middle : 1.0;
    for (View& view : views_) {
      for (std::size_t turn = light * kTurns; turn < (light + 1) * kTurns; ++turn) {
        view.samples[turn].shown = show(exposures_[light] * view.samples[turn].shown);
      }
    }
    progress.set((static_cast<double>(light) + 1.0) / static_cast<double>(kLights));
  }
}

std::size_t PictureError::memory_bound(const glm::ivec2& views) {
  const auto count = static_cast<std::size_t>(views.x) * static_cast<std::size_t>(views.y);
  constexpr auto kSide = static_cast<std::size_t>(LightMap::kSide + 1);
  return sizeof(float) * kSide * kSide +
         count * (3 * sizeof(View) + kLights * kTurns * (sizeof(Sample) + sizeof(double))) +
         sizeof(Lamp) * 4 * kMostLamps;
}

PictureErrors PictureError::operator()(const LobeTable& table) const {
  const std::array<std::vector<Lamp>, kLights> lamps{made_up_light(kLamps),
                                                     made_up_light(kWindows)};
  std::vector<std::array<double, kLights>> errors(views_.size());
  parallel_for(views_.size(), threads_, progress_, [&](std::size_t i) {
    const Mixture lobes = table.interpolate(views_[i].direction);
    for (std::size_t light = 0; light < kLights; ++light) {
      double sum = 0.0;
      for (std::size_t turn = light * kTurns; turn < (light + 1) * kTurns; ++turn) {
        const Sample& sample = views_[i].samples[turn];
        const double difference =
            show(exposures_[light] * drawn(lamps[light], lobes, sample.turn)) - sample.shown;
        sum += difference * difference;
      }
      errors[i][light] = sum / kTurns;
    }
  });
  PictureErrors mean;
  double shares = 0.0;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    mean.lamps += views_[i].share * errors[i][kLamps];
    mean.windows += views_[i].share * errors[i][kWindows];
    shares += views_[i].share;
  }
  mean.lamps /= shares;
  mean.windows /= shares;
  return mean;
}

}  // namespace lobelight
