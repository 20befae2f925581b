// Renders reference pictures without Godot, for cross-checks and timing.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "image/exr.h"
#include "image/panorama.h"
#include "reference/integrator.h"
#include "reference/sphere_renderer.h"
#include "reference/surface_renderer.h"

namespace {

constexpr const char* kUsage =
    "usage: lobelight_reference --env FILE --brdf NAME --alpha AX,AY [--size N] [--samples N]\n"
    "         [--seed N] [--threads N] [--normals N.exr --tangents T.exr --view X,Y,Z]\n"
    "         (--out X.exr | --pixels C,R,C,R,…)\n"
    "  --out      writes radiance (R, G, B) and its standard error (error.R, …) as floats\n"
    "  --pixels   prints one line a pixel of the sphere: column row radiance(3) standard-error(3)\n"
    "  --normals  a surface instead of the sphere: x, y and z in R, G and B, 0 where there is "
    "none;\n"
    "             without shadows, and seen from the direction --view in every pixel\n";

using Options = std::map<std::string, std::string>;

Options parse(int count, char** arguments) {
  Options options = {{"size", "256"}, {"samples", ""}, {"seed", "0"}, {"threads", "0"}};
  for (int i = 1; i < count; i += 2) {
    const std::string name = arguments[i];
    if (name.rfind("--", 0) != 0 || i + 1 == count) throw std::invalid_argument(kUsage);
    options[name.substr(2)] = arguments[i + 1];
  }
  for (const char* needed : {"env", "brdf", "alpha"}) {
    if (options.count(needed) == 0) throw std::invalid_argument(kUsage);
  }
  const auto surface = options.count("normals") + options.count("tangents") + options.count("view");
  if (surface != 0 && surface != 3) throw std::invalid_argument(kUsage);
  return options;
}

std::vector<double> numbers(const std::string& list) {
  std::vector<double> values;
  std::stringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) values.push_back(std::stod(item));
  return values;
}

void write_picture(const lobelight::SurfaceImage& image, const std::string& path) {
  std::vector<float> pixels;
  pixels.reserve(2 * image.radiance.size());
  for (std::size_t i = 0; i < image.radiance.size(); i += 3) {
    pixels.insert(pixels.end(), &image.radiance[i], &image.radiance[i] + 3);
    pixels.insert(pixels.end(), &image.standard_error[i], &image.standard_error[i] + 3);
  }
  lobelight::write_exr(path, image.width, image.height,
                       {"R", "G", "B", "error.R", "error.G", "error.B"}, pixels);
}

glm::dvec3 vector_at(const lobelight::Panorama& picture, int column, int row) {
  const float* rgb = &picture.rgb[static_cast<std::size_t>(3 * (row * picture.width + column))];
  return {rgb[0], rgb[1], rgb[2]};
}

// A surface given by pictures of its normals and tangents.
lobelight::SurfaceImage render_pictures(const lobelight::Panorama& panorama,
                                        const lobelight::Brdf& brdf, const Options& given,
                                        const lobelight::SphereOptions& options,
                                        lobelight::Progress& progress) {
  const lobelight::Panorama normals = lobelight::load_panorama(given.at("normals"));
  const lobelight::Panorama tangents = lobelight::load_panorama(given.at("tangents"));
  if (tangents.width != normals.width || tangents.height != normals.height) {
    throw std::invalid_argument("The pictures of normals and tangents differ in size.");
  }
  const std::vector<double> view = numbers(given.at("view"));
  if (view.size() != 3) throw std::invalid_argument("--view needs three numbers: X,Y,Z.");
  const auto surface = [&](int column, int row) {
    return lobelight::frame_about(vector_at(normals, column, row),
                                  vector_at(tangents, column, row));
  };
  return lobelight::render_surface(
      panorama, brdf, glm::normalize(glm::dvec3(view[0], view[1], view[2])), surface,
      {normals.width, normals.height, options.samples, options.seed, options.threads}, progress);
}

lobelight::SurfaceImage render(const lobelight::Panorama& panorama, const lobelight::Brdf& brdf,
                               const Options& given, const lobelight::SphereOptions& options) {
  lobelight::Progress progress;
  if (given.count("normals") != 0) {
    return render_pictures(panorama, brdf, given, options, progress);
  }
  lobelight::SphereImage sphere = lobelight::render_sphere(panorama, brdf, options, progress);
  return {sphere.size, sphere.size, std::move(sphere.radiance), std::move(sphere.standard_error)};
}

void print_pixels(const lobelight::Panorama& panorama, const lobelight::Brdf& brdf,
                  const lobelight::SphereOptions& options, const std::vector<double>& pixels) {
  const lobelight::Integrator integrator(panorama, brdf, options.samples);
  for (std::size_t i = 0; i + 1 < pixels.size(); i += 2) {
    const int column = static_cast<int>(pixels[i]);
    const int row = static_cast<int>(pixels[i + 1]);
    const auto frame = lobelight::sphere_frame(column, row, options.size);
    if (!frame) throw std::invalid_argument("A pixel lies beside the sphere.");
    const auto estimate = integrator.integrate({0.0, 0.0, 1.0}, *frame, options.seed + i);
    std::printf("%d %d", column, row);
    for (int c = 0; c < 3; ++c) std::printf(" %.9g", estimate.radiance[c]);
    for (int c = 0; c < 3; ++c) std::printf(" %.3g", estimate.standard_error[c]);
    std::printf("\n");
  }
}

int run(int count, char** arguments) {
  const Options given = parse(count, arguments);
  const std::vector<double> alpha = numbers(given.at("alpha"));
  if (alpha.size() != 2) throw std::invalid_argument("--alpha needs two numbers: AX,AY.");
  lobelight::SphereOptions options;
  options.size = std::stoi(given.at("size"));
  if (!given.at("samples").empty()) options.samples = std::stoi(given.at("samples"));
  options.seed = std::stoull(given.at("seed"));
  options.threads = std::stoi(given.at("threads"));
  lobelight::validate(options);

  const auto brdf = lobelight::make_brdf(given.at("brdf"), {alpha[0], alpha[1]});
  lobelight::Panorama panorama = lobelight::load_panorama(given.at("env"));
  panorama.sanitise();
  if (given.count("pixels") != 0) {
    print_pixels(panorama, *brdf, options, numbers(given.at("pixels")));
    return EXIT_SUCCESS;
  }
  if (given.count("out") == 0) throw std::invalid_argument(kUsage);
  const auto start = std::chrono::steady_clock::now();
  const lobelight::SurfaceImage image = render(panorama, *brdf, given, options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  write_picture(image, given.at("out"));
  std::printf("%s: %d samples, %.1f s\n", given.at("out").c_str(), options.samples,
              seconds.count());
  return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
