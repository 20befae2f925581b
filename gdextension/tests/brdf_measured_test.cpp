#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "base/pi.h"
#include "brdf/binary_file.h"
#include "brdf/ggx.h"
#include "brdf/measured.h"
#include "brdf/ward.h"
#include "fit/slice.h"
#include "measured_files.h"
#include "statistics.h"

namespace lobelight {
namespace {

using testing::from_angles;
using testing::TemporaryFile;

// Measurements without a file and without errors.
class Exact final : public MeasuredData {
 public:
  Exact(testing::Reflectance reflectance, bool isotropic)
      : reflectance_(std::move(reflectance)), isotropic_(isotropic) {}
  glm::dvec3 reflected(const glm::dvec3& i, const glm::dvec3& o) const override {
    return reflectance_(i, o) * i.z;
  }
  bool is_isotropic() const override { return isotropic_; }
  std::size_t clamped() const override { return 0; }

 private:
  testing::Reflectance reflectance_;
  bool isotropic_;
};

std::unique_ptr<MeasuredData> exact(const Brdf& brdf, const glm::dvec3& colour = glm::dvec3(1.0)) {
  return std::make_unique<Exact>(
      [&brdf, colour](const glm::dvec3& i, const glm::dvec3& o) {
        return colour * brdf.evaluate(i, o);
      },
      brdf.is_isotropic());
}

const glm::dvec3 kViews[] = {from_angles(0.0, 0.0), from_angles(0.8, 0.5), from_angles(1.3, 2.0),
                             from_angles(1.5, -2.5)};

TEST_CASE("The width of Ward's lobe is found, and GGX's is in proportion to its own") {
  for (const double alpha : {0.005, 0.02, 0.1, 0.2}) {
    CAPTURE(alpha);
    const glm::dvec2 ward = estimate_widths(*exact(Ward({alpha, alpha})));
    CHECK(ward.x == doctest::Approx(alpha).epsilon(0.03));
    CHECK(ward.y == ward.x);
    const glm::dvec2 ggx = estimate_widths(*exact(Ggx({alpha, alpha})));
    CHECK(ggx.x / alpha > 0.8);
    CHECK(ggx.x / alpha < 1.2);
    const glm::dvec2 both = estimate_widths(*exact(Ward({alpha, 4.0 * alpha})));
    CHECK(both.x == doctest::Approx(alpha).epsilon(0.05));
    CHECK(both.y == doctest::Approx(4.0 * alpha).epsilon(alpha > 0.1 ? 0.3 : 0.1));
  }
  // A diffuse reflectance has no centre; its width is bounded all the same.
  const Exact diffuse([](auto&&...) { return glm::dvec3(1.0 / kPi); }, true);
  CHECK(estimate_widths(diffuse).x > 0.3);
  CHECK(estimate_widths(diffuse).x <= 1.0);
}

TEST_CASE("A sample of measurements agrees with evaluate() and pdf()") {
  const Ggx round({0.1, 0.1});
  const Ggx brushed({0.1, 0.4});
  for (const Brdf* model : {static_cast<const Brdf*>(&round), static_cast<const Brdf*>(&brushed)}) {
    const MeasuredBrdf brdf(exact(*model), "exact");
    testing::Uniform uniform(1);
    int refused = 0;
    for (int n = 0; n < 3000; ++n) {
      const glm::dvec3 o = uniform.direction_above();
      const auto s = brdf.sample(o, uniform.next2());
      if (!s) {
        ++refused;
        continue;
      }
      CHECK(s->direction.z > 0.0);
      CHECK(s->pdf > 0.0);
      CHECK(brdf.pdf(s->direction, o) == doctest::Approx(s->pdf).epsilon(1e-6));
      const double expected = model->evaluate(s->direction, o);
      CHECK(brdf.evaluate(s->direction, o) == doctest::Approx(expected).epsilon(1e-9));
      CHECK(s->weight == doctest::Approx(expected * s->direction.z / s->pdf).epsilon(1e-6));
    }
    CHECK(refused < 300);
  }
}

TEST_CASE("Samples of measurements are distributed as pdf() says") {
  const Ggx round({0.3, 0.3});
  const Ggx brushed({0.25, 0.6});
  const double threshold = testing::significance(8);
  testing::SphereTest test;
  test.samples = 100000;
  test.subdivisions = 16;
  test.lowest_z = 0.0;
  for (const Brdf* model : {static_cast<const Brdf*>(&round), static_cast<const Brdf*>(&brushed)}) {
    const MeasuredBrdf brdf(exact(*model), "exact");
    for (const glm::dvec3& o : kViews) {
      CAPTURE(o.z);
      ++test.seed;
      const double p =
          testing::sampler_p_value([&](const glm::dvec3& i) { return brdf.pdf(i, o); },
                                   [&](const glm::dvec2& u) -> std::optional<glm::dvec3> {
                                     const auto s = brdf.sample(o, u);
                                     if (!s) return std::nullopt;
                                     return s->direction;
                                   },
                                   test);
      CHECK(p > threshold);
    }
  }
}

TEST_CASE("Slices of measurements have the model's albedo, between the tabulated views too") {
  for (const glm::dvec2& alpha : {glm::dvec2(0.02, 0.02), glm::dvec2(0.3, 0.3),
                                  glm::dvec2(0.05, 0.2), glm::dvec2(0.01, 0.2)}) {
    const Ggx model(alpha);
    const MeasuredBrdf brdf(exact(model), "exact");
    for (const glm::dvec3& o : kViews) {
      CAPTURE(alpha.x);
      CAPTURE(alpha.y);
      CAPTURE(o.z);
      CHECK(sample_slice(brdf, o).albedo ==
            doctest::Approx(sample_slice(model, o).albedo).epsilon(0.01));
    }
  }
}

TEST_CASE("Mirror images are averaged, and what that takes away is told") {
  const Ggx model({0.2, 0.4});
  // A fifth more on one side of the plane y = 0 than on the other.
  const auto uneven = [&](const glm::dvec3& i, const glm::dvec3& o) {
    const double factor = 1.0 + (i.y + o.y > 0.0 ? 0.1 : -0.1);
    return glm::dvec3(factor * model.evaluate(i, o));
  };
  const MeasuredBrdf brdf(std::make_unique<Exact>(uneven, false), "uneven");
  CHECK(brdf.asymmetry() == doctest::Approx(0.1).epsilon(0.02));
  testing::Uniform uniform(2);
  for (int n = 0; n < 500; ++n) {
    const glm::dvec3 i = uniform.direction_above();
    const glm::dvec3 o = uniform.direction_above();
    CHECK(brdf.evaluate(i, o) == doctest::Approx(model.evaluate(i, o)).epsilon(1e-9));
  }
  CHECK(MeasuredBrdf(exact(model), "even").asymmetry() < 1e-12);
  CHECK_FALSE(brdf.is_isotropic());
  CHECK_FALSE(brdf.is_coloured());
}

TEST_CASE("The scalar reflectance is the mean of the channels") {
  const Ggx model({0.2, 0.2});
  const MeasuredBrdf brdf(exact(model, {0.9, 0.6, 0.3}), "copper");
  CHECK(brdf.is_coloured());
  CHECK(brdf.is_isotropic());
  CHECK(brdf.name() == "copper");
  const glm::dvec3 i = from_angles(0.6, 2.9);
  const glm::dvec3 o = from_angles(0.5, 0.0);
  CHECK(brdf.evaluate(i, o) == doctest::Approx(0.6 * model.evaluate(i, o)));
  CHECK(brdf.evaluate_rgb(i, o).x == doctest::Approx(0.9 * model.evaluate(i, o)));
  CHECK(brdf.evaluate_rgb(i, {1.0, 0.0, 0.0}) == glm::dvec3(0.0));
}

// Mean relative error of a file's reflectance where the model reflects to.
double mean_error(const Brdf& file, const Brdf& model, double greatest_elevation) {
  testing::Uniform uniform(3);
  double sum = 0.0;
  int count = 0;
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 o =
        from_angles(greatest_elevation * uniform.next(), 2.0 * kPi * uniform.next());
    const auto s = model.sample(o, uniform.next2());
    if (!s || s->direction.z < 0.1) continue;
    const double expected = model.evaluate(s->direction, o);
    sum += std::abs(file.evaluate(s->direction, o) - expected) / expected;
    ++count;
  }
  return sum / count;
}

TEST_CASE("make_brdf reads files of both formats") {
  SUBCASE("MERL") {
    const Ggx model({0.15, 0.15});
    const TemporaryFile file(".binary");
    file.write(testing::merl_file([&](const glm::dvec3& i, const glm::dvec3& o) {
      return glm::dvec3(model.evaluate(i, o));
    }));
    const auto brdf = make_brdf(file.path(), {0.0, 0.0});
    CHECK(brdf->is_isotropic());
    CHECK(brdf->name() == file.path().substr(file.path().find_last_of('/') + 1));
    CHECK(mean_error(*brdf, model, 1.4) < 0.01);
    for (const double theta : {0.0, 0.7, 1.3}) {
      const glm::dvec3 o = from_angles(theta, 1.0);
      CHECK(sample_slice(*brdf, o).albedo ==
            doctest::Approx(sample_slice(model, o).albedo).epsilon(0.01));
    }
    CHECK(make_brdf(file.path(), {0.3, 0.3})->alpha() == glm::dvec2(0.3, 0.3));
    CHECK_THROWS_AS(make_brdf(file.path(), {-1.0, 0.0}), std::invalid_argument);
  }
  SUBCASE("RGL, anisotropic, half a circle of azimuths") {
    const glm::dvec2 alpha(0.2, 0.4);
    const Ggx model(alpha);
    testing::RglRecipe recipe;
    recipe.reflectance = [&](const glm::dvec3& i, const glm::dvec3& o) {
      return glm::dvec3(model.evaluate(i, o));
    };
    recipe.alpha = alpha;
    recipe.azimuths.clear();
    for (int p = 0; p <= 8; ++p) recipe.azimuths.push_back(-kPi + p * kPi / 8.0);
    for (int t = 0; t <= 8; ++t) recipe.elevations.push_back(0.5 * kPi * t / 8.0);
    recipe.resolution = 24;
    const TemporaryFile file(".bsdf");
    file.write(testing::rgl_file(recipe));
    const auto brdf = make_brdf(file.path(), {0.0, 0.0});
    CHECK_FALSE(brdf->is_isotropic());
    CHECK(dynamic_cast<const MeasuredBrdf&>(*brdf).asymmetry() < 0.04);
    CHECK(mean_error(*brdf, model, 1.2) < 0.05);
    for (const glm::dvec3& o : {kViews[0], kViews[1], kViews[2]}) {
      CHECK(sample_slice(*brdf, o).albedo ==
            doctest::Approx(sample_slice(model, o).albedo).epsilon(0.03));
    }
  }
}

TEST_CASE("Paths are told from names") {
  CHECK(is_measured_file("gold.binary"));
  CHECK(is_measured_file("folder/file"));
  CHECK(is_measured_file("brushed_rgb.bsdf"));
  CHECK_FALSE(is_measured_file("ward"));
  CHECK_FALSE(is_measured_file("phong"));
  CHECK_FALSE(is_measured_file(""));
  CHECK_THROWS_WITH_AS(make_brdf("nowhere.bsdf", {0.0, 0.0}), "nowhere.bsdf: no such file",
                       MeasuredFileError);
  const TemporaryFile file(".binary");
  file.write({'t', 'e', 'x', 't', ',', ' ', 'n', 'o', 't', ' ', 'M', 'E', 'R', 'L'});
  CHECK_THROWS_WITH_AS(make_brdf(file.path(), {0.0, 0.0}),
                       (file.path() + ": is not a MERL file: its sizes are (1954047348, 1869488172"
                                      ", 1162682484), not (90, 90, 180)")
                           .c_str(),
                       MeasuredFileError);
}

}  // namespace
}  // namespace lobelight
