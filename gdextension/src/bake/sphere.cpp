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

SphereImage render_panorama(const SphereRequest& request, const Brdf& brdf, Progress& read,
                            Progress& render, std::size_t& clamped) {
  Panorama panorama = load_panorama(request.environment, "", kMaxPanoramaSide, &read);
  check_memory(request, panorama.width, panorama.height);
  clamped = panorama.sanitise();
  read.set(1.0);
  return render_sphere(panorama, brdf, request.options, render);
}

SphereImage render_room(const SphereRequest& request, const Brdf& brdf, Progress& read,
                        Progress& render, std::size_t& clamped) {
  Room room;
  room.size = request.room->size;
  for (std::size_t w = 0; w < kWalls; ++w) {
    room.walls[w] = load_panorama(request.room->walls[w], "", kMaxTextureSide, &read);
    check_memory(request, room.walls[w].width, room.walls[w].height);
    clamped += room.walls[w].sanitise();
    read.set(static_cast<double>(w + 1) / kWalls);
  }
  return render_sphere(room, request.room->sphere, brdf, request.options, render);
}

}  // namespace

void validate(const SphereRequest& request) {
  validate_brdf(request.brdf, request.alpha);
  validate(request.options);
  if (request.room) {
    Room room;
    room.size = request.room->size;
    validate(room, request.room->sphere);
  }
  check_memory(request);
}

SpherePicture render_picture(const SphereRequest& request, Progress& progress) {
  validate(request);
  const auto start = std::chrono::steady_clock::now();
  Progress read(progress, kReadShare);
  Progress render(progress, 1.0 - kReadShare);
  const std::unique_ptr<Brdf> brdf = make_brdf(request.brdf, request.alpha, &read);
  SpherePicture picture;
  picture.image = request.room ? render_room(request, *brdf, read, render, picture.clamped)
                               : render_panorama(request, *brdf, read, render, picture.clamped);
  picture.brdf = brdf->name();
  picture.alpha = brdf->alpha();
  progress.set(1.0);
  picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

}  // namespace lobelight
