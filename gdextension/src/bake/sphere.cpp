#include "bake/sphere.h"

#include <chrono>
#include <memory>

#include "bake/memory.h"
#include "brdf/brdf.h"
#include "brdf/measured.h"
#include "image/panorama.h"

namespace lobelight {

namespace {

constexpr double kReadShare = 0.05;

}  // namespace

void validate(const SphereRequest& request) {
  validate_brdf(request.brdf, request.alpha);
  validate(request.options);
  check_memory(request);
}

SpherePicture render_picture(const SphereRequest& request, Progress& progress) {
  validate(request);
  const auto start = std::chrono::steady_clock::now();
  Progress read(progress, kReadShare);
  Progress render(progress, 1.0 - kReadShare);
  const std::unique_ptr<Brdf> brdf = make_brdf(request.brdf, request.alpha, &read);
  Panorama panorama = load_panorama(request.environment, "", kMaxPanoramaSide, &read);
  check_memory(request, panorama.width, panorama.height);
  const std::size_t clamped = panorama.sanitise();
  read.set(1.0);
  SpherePicture picture;
  picture.image = render_sphere(panorama, *brdf, request.options, render);
  picture.brdf = brdf->name();
  picture.alpha = brdf->alpha();
  picture.clamped = clamped;
  progress.set(1.0);
  picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

}  // namespace lobelight
