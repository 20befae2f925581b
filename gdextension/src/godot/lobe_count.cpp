#include "godot/lobe_count.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "image/synthetic_panorama.h"
#include "reference/sphere_renderer.h"
#include "reference/table_renderer.h"

namespace lobelight {

namespace {

constexpr int kCounts[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32};

// Of the sphere in pixels, and of the reference's noise: the PSNR of a picture with itself and
// another seed is above 54 dB, which bounds the targets that can be asked for.
constexpr int kSize = 32;
constexpr int kSamples = 1024;
constexpr double kMaxTarget = 46.0;

// How much of the progress the references take.
constexpr double kReferenceShare = 0.3;

struct Scene {
  GaussianConvolution light;
  std::vector<float> reference;
};

}  // namespace

void validate(const LobeCountRequest& request) {
  if (!(request.target > 0.0 && request.target <= kMaxTarget)) {
    char text[96];
    std::snprintf(text, sizeof text, "target is %g, but must be above 0 and at most %g dB.",
                  request.target, kMaxTarget);
    throw std::invalid_argument(text);
  }
  if (request.max_lobes < 1 || request.max_lobes > kMaxLobes) {
    char text[96];
    std::snprintf(text, sizeof text, "max_lobes is %d, but must be from 1 to %d.",
                  request.max_lobes, kMaxLobes);
    throw std::invalid_argument(text);
  }
}

LobeCount find_lobe_count(const LobeCountRequest& request, const Brdf& brdf, Progress& progress) {
  validate(request);
  std::vector<Panorama> panoramas{synthetic_panorama()};
  for (const std::string& path : request.environments) {
    panoramas.push_back(load_panorama(path));
    panoramas.back().sanitise();
  }

  std::vector<Scene> scenes;
  SphereOptions options;
  options.size = kSize;
  options.samples = kSamples;
  options.threads = request.recipe.threads;
  for (std::size_t n = 0; n < panoramas.size(); ++n) {
    Progress own;
    progress.throw_if_cancelled();
    scenes.push_back({GaussianConvolution(panoramas[n]),
                      render_sphere(panoramas[n], brdf, options, own).radiance});
    progress.set(kReferenceShare * static_cast<double>(n + 1) /
                 static_cast<double>(panoramas.size()));
  }

  const auto tried_at_most =
      std::upper_bound(std::begin(kCounts), std::end(kCounts), request.max_lobes) -
      std::begin(kCounts);
  std::vector<LobeCountTrial> trials;
  LobeCountTrial best;
  for (const int lobes : kCounts) {
    if (lobes > request.max_lobes) break;
    Recipe recipe = request.recipe;
    recipe.lobes = lobes;
    progress.throw_if_cancelled();
    Progress own;
    FitReport report;
    LobeTable table = fit_table(brdf, recipe, own, &report);
    double worst = std::numeric_limits<double>::infinity();
    for (const Scene& scene : scenes) {
      const std::vector<float> picture =
          render_table(scene.light, table, kSize, recipe.threads, progress);
      worst = std::min(worst, sphere_psnr(picture, scene.reference, kSize));
    }
    trials.push_back({lobes, worst});
    if (worst > best.psnr) best = trials.back();
    if (worst >= request.target) {
      progress.set(1.0);
      return {std::move(table), std::move(report), std::move(trials)};
    }
    progress.set(kReferenceShare + (1.0 - kReferenceShare) * static_cast<double>(trials.size()) /
                                       static_cast<double>(tried_at_most));
  }
  char text[160];
  std::snprintf(
      text, sizeof text,
      "The target of %.4g dB is out of reach with up to %d lobes; the best are %d with %.1f dB.",
      request.target, request.max_lobes, best.lobes, best.psnr);
  throw std::runtime_error(text);
}

}  // namespace lobelight
