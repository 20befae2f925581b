#include "bake/lobe_count.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "fit/wide_lobes.h"
#include "image/synthetic_panorama.h"
#include "reference/reduced_panorama.h"
#include "reference/sphere_renderer.h"
#include "reference/table_renderer.h"

namespace lobelight {

namespace {

constexpr int kCounts[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32};

// The PSNR of a reference with itself and another seed is above 54 dB.
constexpr double kMaxTarget = 46.0;

// How much of the progress the references take, and of a trial the pictures of its table.
constexpr double kReferenceShare = 0.3;
constexpr double kPictureShare = 0.1;

struct Scene {
  GaussianConvolution light;
  std::vector<float> reference;
};

Panorama load_environment(const std::string& path, const Progress& progress) {
  Panorama panorama = load_panorama(path, "", kMaxPanoramaSide, &progress);
  panorama.sanitise();
  return reduce_panorama(std::move(panorama), kEnvironmentWidth, kEnvironmentHeight, &progress);
}

Scene make_scene(Panorama panorama, const Brdf& brdf, const SphereOptions& options,
                 Progress& progress) {
  std::vector<float> reference = render_sphere(panorama, brdf, options, progress).radiance;
  return {GaussianConvolution(std::move(panorama), &progress), std::move(reference)};
}

std::vector<Scene> make_scenes(const LobeTarget& target, const Brdf& brdf,
                               const SphereOptions& options, Progress& progress) {
  const double share = 1.0 / static_cast<double>(1 + target.environments.size());
  std::vector<Scene> scenes;
  scenes.reserve(1 + target.environments.size());
  Progress synthetic(progress, share);
  scenes.push_back(make_scene(synthetic_panorama(), brdf, options, synthetic));
  for (const std::string& path : target.environments) {
    progress.throw_if_cancelled();
    Progress part(progress, share);
    scenes.push_back(make_scene(load_environment(path, progress), brdf, options, part));
  }
  return scenes;
}

// The placements that are tried in turn. Lobes by least squares are fitted to the kernels that are
// drawn, but are judged here under exact light, where EM's may be better.
std::vector<Placement> placements_of(const Recipe& recipe, const Brdf& brdf, int lobes) {
  const LobeTable grid(brdf.alpha(), lobes, resolve_views(recipe, brdf.is_isotropic()));
  if (recipe.placement != Placement::automatic || !is_wide(brdf, grid)) return {recipe.placement};
  return {Placement::automatic, Placement::em};
}

// The lowest PSNR of a table's pictures.
double worst_psnr(const LobeTable& table, const std::vector<Scene>& scenes,
                  const SphereOptions& options, Progress& progress) {
  double worst = std::numeric_limits<double>::infinity();
  for (const Scene& scene : scenes) {
    Progress part(progress, 1.0 / static_cast<double>(scenes.size()));
    const std::vector<float> picture =
        render_table(scene.light, table, options.size, options.threads, part);
    worst = std::min(worst, sphere_psnr(picture, scene.reference, options.size));
  }
  return worst;
}

}  // namespace

void validate(const LobeTarget& target) {
  char text[96];
  if (!(target.psnr > 0.0 && target.psnr <= kMaxTarget)) {
    std::snprintf(text, sizeof text, "target is %g, but must be above 0 and at most %g dB.",
                  target.psnr, kMaxTarget);
    throw std::invalid_argument(text);
  }
  if (target.max_lobes < 1 || target.max_lobes > kMaxLobes) {
    std::snprintf(text, sizeof text, "max_lobes is %d, but must be from 1 to %d.", target.max_lobes,
                  kMaxLobes);
    throw std::invalid_argument(text);
  }
}

LobeCount find_lobe_count(const LobeTarget& target, const Recipe& recipe, const Brdf& brdf,
                          Progress& progress, const LobeCountOptions& options) {
  validate(target);
  SphereOptions sphere;
  sphere.size = options.size;
  sphere.samples = options.samples;
  sphere.threads = recipe.threads;
  Progress references(progress, kReferenceShare);
  const std::vector<Scene> scenes = make_scenes(target, brdf, sphere, references);

  // A fit takes about as long as it has lobes.
  int all_lobes = 0;
  for (const int lobes : kCounts) all_lobes += lobes <= target.max_lobes ? lobes : 0;
  std::vector<LobeCountTrial> trials;
  LobeCountTrial best;
  for (const int lobes : kCounts) {
    if (lobes > target.max_lobes) break;
    Progress trial(progress, (1.0 - kReferenceShare) * lobes / all_lobes);
    trials.push_back({lobes, 0.0});
    const std::vector<Placement> placements = placements_of(recipe, brdf, lobes);
    for (const Placement placement : placements) {
      Progress part(trial, 1.0 / static_cast<double>(placements.size()));
      Progress fit(part, 1.0 - kPictureShare);
      Progress pictures(part, kPictureShare);
      Recipe tried = recipe;
      tried.lobes = lobes;
      tried.placement = placement;
      FitReport report;
      LobeTable table = fit_table(brdf, tried, fit, &report, options.fit);
      const double psnr = worst_psnr(table, scenes, sphere, pictures);
      trials.back().psnr = std::max(trials.back().psnr, psnr);
      if (psnr > best.psnr) best = trials.back();
      if (psnr >= target.psnr) {
        progress.set(1.0);
        return {std::move(table), std::move(report), std::move(trials)};
      }
    }
  }
  char text[160];
  std::snprintf(
      text, sizeof text,
      "The target of %.4g dB is out of reach with up to %d lobes; the best are %d with %.1f dB.",
      target.psnr, target.max_lobes, best.lobes, best.psnr);
  throw std::runtime_error(text);
}

}  // namespace lobelight
