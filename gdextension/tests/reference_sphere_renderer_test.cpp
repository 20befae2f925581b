#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <stdexcept>

#include "reference/sphere_renderer.h"

namespace lobelight {
namespace {

// Sky, ground, clutter, lamps and a sun of 6e4 times the median.
Panorama harsh_panorama() {
  const int width = 256;
  const int height = 128;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform;
  Panorama panorama{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const float base = (i / width < height / 2 ? 0.3f : 0.1f) * (0.3f + 2.0f * uniform(random));
    panorama.rgb.insert(panorama.rgb.end(), {base, 0.9f * base, 0.7f * base});
  }
  const auto light = [&](int column, int row, int size, float value) {
    for (int y = row; y < row + size; ++y) {
      for (int x = column; x < column + size; ++x) {
        for (int c = 0; c < 3; ++c) {
          panorama.rgb[static_cast<std::size_t>(3 * (y * width + x) + c)] = value;
        }
      }
    }
  };
  for (int lamp = 0; lamp < 12; ++lamp) {
    light(static_cast<int>(random() % 250), 10 + static_cast<int>(random() % 80), 3,
          5.0f + 40.0f * uniform(random));
  }
  light(150, 30, 1, 6e4f * 0.2f);
  return panorama;
}

// PSNR between two pictures as the contract of ./dev compare has it.
double psnr(const SphereImage& image, const SphereImage& reference) {
  std::vector<std::size_t> pixels;
  std::vector<double> brightness;
  for (int row = 0; row < reference.size; ++row) {
    for (int column = 0; column < reference.size; ++column) {
      const double x = (2.0 * column + 1.0) / reference.size - 1.0;
      const double y = 1.0 - (2.0 * row + 1.0) / reference.size;
      if (x * x + y * y >= 0.9995) continue;
      const std::size_t pixel = static_cast<std::size_t>(row * reference.size + column);
      pixels.push_back(pixel);
      const float* rgb = &reference.radiance[3 * pixel];
      brightness.push_back((rgb[0] + rgb[1] + rgb[2]) / 3.0);
    }
  }
  std::nth_element(brightness.begin(), brightness.begin() + brightness.size() / 2,
                   brightness.end());
  const double exposure = 0.18 / brightness[brightness.size() / 2];
  const auto encoded = [&](float value) {
    return std::pow(std::clamp(value * exposure, 0.0, 1.0), 1.0 / 2.2);
  };
  double sum = 0.0;
  for (const std::size_t pixel : pixels) {
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
      const double difference = encoded(image.radiance[c]) - encoded(reference.radiance[c]);
      sum += difference * difference;
    }
  }
  return -10.0 * std::log10(sum / (3.0 * static_cast<double>(pixels.size())));
}

SphereImage render(const Panorama& panorama, const char* name, const glm::dvec2& alpha,
                   const SphereOptions& options) {
  Progress progress;
  return render_sphere(panorama, *make_brdf(name, alpha), options, progress);
}

TEST_CASE("sphere_frame: the picture's geometry") {
  const auto frame = sphere_frame(2, 1, 4);  // x = y = 1/4
  REQUIRE(frame);
  CHECK(glm::length(frame->normal - glm::dvec3(0.25, 0.25, std::sqrt(0.875))) < 1e-15);
  CHECK(!sphere_frame(0, 0, 4));
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      const auto f = sphere_frame(column, row, 9);
      if (!f) continue;
      CHECK(glm::length(glm::cross(f->tangent, f->bitangent) - f->normal) < 1e-12);
      CHECK(std::abs(glm::dot(f->tangent, f->normal)) < 1e-12);
      CHECK(glm::length(f->tangent) == doctest::Approx(1.0).epsilon(1e-12));
      // (0, 1, 0) × n is horizontal; the top row has y > 0.
      CHECK(f->tangent.y == 0.0);
      CHECK((f->normal.y > 0.0) == (row < 4));
    }
  }
}

TEST_CASE("render_sphere: a narrow lobe mirrors the panorama, the right way round") {
  // Radiance 2 + d at direction d, smooth enough for bilinear interpolation.
  const int width = 256;
  const int height = 128;
  Panorama panorama{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 d = panorama_direction({(column + 0.5) / width, (row + 0.5) / height});
      for (int c = 0; c < 3; ++c) panorama.rgb.push_back(static_cast<float>(2.0 + d[c]));
    }
  }
  SphereOptions options;
  options.size = 16;
  options.samples = 1024;
  const SphereImage image = render(panorama, "ggx", {1e-3, 1e-3}, options);
  for (int row = 0; row < options.size; ++row) {
    for (int column = 0; column < options.size; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(3 * (row * options.size + column));
      const auto frame = sphere_frame(column, row, options.size);
      if (!frame) {
        for (std::size_t c = 0; c < 3; ++c) CHECK(image.radiance[pixel + c] == 0.0f);
        continue;
      }
      const glm::dvec3 n = frame->normal;
      const glm::dvec3 mirror = 2.0 * n.z * n - glm::dvec3(0, 0, 1);
      for (std::size_t c = 0; c < 3; ++c) {
        CHECK(image.radiance[pixel + c] ==
              doctest::Approx(2.0 + mirror[static_cast<int>(c)]).epsilon(1e-2).scale(0));
      }
    }
  }
}

TEST_CASE("render_sphere: agrees with itself at doubled sampling, other noise, by 55 dB") {
  const Panorama panorama = harsh_panorama();
  struct Material {
    const char* name;
    glm::dvec2 alpha;
  };
  for (const Material& material :
       {Material{"ward", {0.1, 0.1}}, Material{"ward", {0.05, 0.2}}, Material{"ward", {0.01, 0.01}},
        Material{"ward", {0.01, 0.2}}, Material{"ggx", {0.1, 0.1}}}) {
    SphereOptions options;
    options.size = 12;
    const SphereImage once = render(panorama, material.name, material.alpha, options);
    options.samples *= 2;
    options.seed = 1;
    const SphereImage twice = render(panorama, material.name, material.alpha, options);
    INFO(material.name, " ", material.alpha.x, " ", material.alpha.y);
    CHECK(psnr(once, twice) >= 55.0);
  }
}

TEST_CASE("render_sphere: the picture does not depend on the threads, the noise on the seed") {
  const Panorama panorama = harsh_panorama();
  SphereOptions options;
  options.size = 10;
  options.samples = 64;
  options.threads = 1;
  const SphereImage one = render(panorama, "ward", {0.05, 0.2}, options);
  for (const int threads : {2, 5, 0}) {
    options.threads = threads;
    const SphereImage other = render(panorama, "ward", {0.05, 0.2}, options);
    CHECK(other.radiance == one.radiance);
    CHECK(other.standard_error == one.standard_error);
  }
  options.seed = 1;
  CHECK(render(panorama, "ward", {0.05, 0.2}, options).radiance != one.radiance);
}

TEST_CASE("render_sphere: progress reaches 1, and a cancelled one ends with Cancelled") {
  const Panorama panorama{2, 1, std::vector<float>(6, 1.0f)};
  const auto brdf = make_brdf("ward", {0.1, 0.1});
  SphereOptions options;
  options.size = 4;
  options.samples = 16;
  Progress progress;
  render_sphere(panorama, *brdf, options, progress);
  CHECK(progress.fraction() == 1.0);
  progress.cancel();
  CHECK_THROWS_AS(render_sphere(panorama, *brdf, options, progress), Cancelled);
}

TEST_CASE("render_sphere: options out of range are named") {
  const auto refuse = [](const SphereOptions& options, const std::string& message) {
    CHECK_THROWS_WITH_AS(validate(options), message.c_str(), std::invalid_argument);
  };
  SphereOptions options;
  CHECK_NOTHROW(validate(options));
  options.size = 0;
  refuse(options, "size must be 1 to 8192, not 0.");
  options = {};
  options.samples = 1;
  refuse(options, "samples must be 16 to 16777216, not 1.");
}

}  // namespace
}  // namespace lobelight
