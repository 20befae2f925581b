#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "base/pi.h"
#include "brdf_oracle.h"
#include "fit/mirror.h"
#include "fit/slice.h"
#include "models.h"
#include "statistics.h"

namespace lobelight {
namespace {

glm::dvec3 view(double elevation_degrees, double azimuth_degrees) {
  const double e = elevation_degrees * kPi / 180.0;
  const double a = azimuth_degrees * kPi / 180.0;
  return {std::sin(e) * std::cos(a), std::sin(e) * std::sin(a), std::cos(e)};
}

TEST_CASE("A slice's albedo agrees with SciPy's quadrature at the default size") {
  for (const auto& [name, alpha_x, alpha_y, elevation, azimuth, albedo] : oracle::kAlbedos) {
    const Slice slice =
        sample_slice(*make_brdf(name, {alpha_x, alpha_y}), view(elevation, azimuth));
    CAPTURE(name);
    CAPTURE(alpha_x);
    CAPTURE(elevation);
    CHECK(slice.albedo == doctest::Approx(albedo).epsilon(2e-3));
    double sum = 0.0;
    for (const double weight : slice.weights) sum += weight;
    CHECK(sum == doctest::Approx(slice.albedo).epsilon(1e-13));
  }
}

TEST_CASE("Slice nodes are above the horizon, weighted, and the same on every call") {
  for (const std::string& name : brdf_names()) {
    const auto brdf = testing::model(name, {0.05, 0.4});
    const Slice slice = sample_slice(*brdf, view(80.0, 33.0), 30, 0.3);
    CHECK(slice.directions.size() == slice.weights.size());
    CHECK(slice.directions.size() > 300);
    CHECK(slice.directions.size() <= 32 * 32);
    for (std::size_t n = 0; n < slice.directions.size(); ++n) {
      CHECK(slice.directions[n].z > 0.0);
      CHECK(std::abs(glm::length(slice.directions[n]) - 1.0) < 1e-14);
      CHECK(slice.weights[n] > 0.0);
    }
    const Slice again = sample_slice(*brdf, view(80.0, 33.0), 30, 0.3);
    CHECK(again.directions == slice.directions);
    CHECK(again.weights == slice.weights);
    CHECK(sample_slice(*brdf, view(80.0, 33.0), 30, 0.4).directions != slice.directions);
  }
}

// Whether every node has a mirror image among the nodes, of the same weight.
bool is_mirror_symmetric(const Slice& slice, int axis) {
  using Node = std::tuple<long, long, long, long>;
  const auto key = [](const glm::dvec3& d, double w) {
    return Node{std::lround(d.x * 1e9), std::lround(d.y * 1e9), std::lround(d.z * 1e9),
                std::lround(w * 1e12)};
  };
  const auto near = [](const Node& a, const Node& b) {
    return std::abs(std::get<0>(a) - std::get<0>(b)) <= 1 &&
           std::abs(std::get<1>(a) - std::get<1>(b)) <= 1 &&
           std::abs(std::get<2>(a) - std::get<2>(b)) <= 1 &&
           std::abs(std::get<3>(a) - std::get<3>(b)) <= 1;
  };
  std::vector<Node> nodes;
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    nodes.push_back(key(slice.directions[n], slice.weights[n]));
  }
  return std::all_of(slice.directions.begin(), slice.directions.end(), [&](const glm::dvec3& d) {
    const auto n = static_cast<std::size_t>(&d - slice.directions.data());
    const Node wanted = key(reflected(d, axis), slice.weights[n]);
    return std::any_of(nodes.begin(), nodes.end(), [&](const Node& b) { return near(wanted, b); });
  });
}

TEST_CASE("Slice nodes have the slice's mirror symmetry") {
  for (const std::string& name : brdf_names()) {
    CAPTURE(name);
    const auto brdf = testing::model(name, {0.1, 0.3});
    const Slice pole = sample_slice(*brdf, {0.0, 0.0, 1.0}, 24);
    CHECK(is_mirror_symmetric(pole, 0));
    CHECK(is_mirror_symmetric(pole, 1));
    const Slice in_xz = sample_slice(*brdf, {0.6, 0.0, 0.8}, 24);
    CHECK_FALSE(is_mirror_symmetric(in_xz, 0));
    CHECK(is_mirror_symmetric(in_xz, 1));
    const Slice in_yz = sample_slice(*brdf, {0.0, 0.6, 0.8}, 24);
    CHECK(is_mirror_symmetric(in_yz, 0));
    CHECK_FALSE(is_mirror_symmetric(in_yz, 1));
  }
}

TEST_CASE("A slice integrates other functions too") {
  // ∫ ρ(i, o) i_z · i_z di against the plain midpoint rule over the hemisphere.
  const auto brdf = make_brdf("ggx", {0.4, 0.6});
  const glm::dvec3 o = view(35.0, 60.0);
  constexpr int kCells = 700;
  double truth = 0.0;
  for (int r = 0; r < kCells; ++r) {
    for (int c = 0; c < kCells; ++c) {
      const double z = (r + 0.5) / kCells;
      const double azimuth = 2.0 * kPi * (c + 0.5) / kCells;
      const double s = std::sqrt(1.0 - z * z);
      truth += brdf->evaluate({s * std::cos(azimuth), s * std::sin(azimuth), z}, o) * z * z;
    }
  }
  truth *= 2.0 * kPi / (kCells * kCells);
  const Slice slice = sample_slice(*brdf, o);
  double own = 0.0;
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    own += slice.weights[n] * slice.directions[n].z;
  }
  CHECK(own == doctest::Approx(truth).epsilon(2e-3));
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_CASE("Nodes that are no numbers are not usable") {
  const glm::dvec3 up(0.0, 0.0, 1.0);
  CHECK(is_usable(up, 1.0));
  CHECK(is_usable(glm::normalize(glm::dvec3(1.0, -2.0, 0.3)), 5e-324));
  for (const double weight : {0.0, -0.0, -1.0, kNan, kInfinity, -kInfinity}) {
    CAPTURE(weight);
    CHECK_FALSE(is_usable(up, weight));
  }
  for (const double component : {kNan, kInfinity, -kInfinity, 1e200, 1e-5, 2.0}) {
    CAPTURE(component);
    CHECK(is_usable({component, 0.0, 1.0}, 1.0) == (component == 1e-5));
    CHECK_FALSE(is_usable({0.0, component, 0.0}, 1.0));
  }
  CHECK_FALSE(is_usable(glm::dvec3(0.0), 1.0));
}

TEST_CASE("What is not usable is left out, and the albedo is that of the rest") {
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 side(1.0, 0.0, 0.0);
  const Slice dirty{
      {up, side, {kNan, 0.0, 1.0}, up, side}, {0.25, kNan, 1.0, kInfinity, 0.5}, kNan};
  CHECK_FALSE(is_usable(dirty));
  const Slice clean = usable_nodes(dirty);
  CHECK(is_usable(clean));
  CHECK(clean.directions == std::vector<glm::dvec3>{up, side});
  CHECK(clean.weights == std::vector<double>{0.25, 0.5});
  CHECK(clean.albedo == 0.75);

  CHECK_FALSE(is_usable(Slice{{up, side}, {1.0}, 1.0}));
  CHECK(usable_nodes(Slice{{up, side}, {1.0}, 1.0}).directions.size() == 1);
  CHECK(usable_nodes(Slice{{up}, {kNan}, kNan}).albedo == 0.0);
  CHECK(is_usable(Slice{}));
  CHECK_THROWS_AS(usable_nodes({{up, side}, {1e308, 1e308}, kInfinity}), std::invalid_argument);
}

// As a file of measured data could be: some samples are not numbers.
class Faulty final : public Brdf {
 public:
  explicit Faulty(BrdfSample fault) : Brdf({0.2, 0.2}), fault_(fault) {}
  double evaluate(const glm::dvec3&, const glm::dvec3&) const override { return 0.0; }
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override {
    if (u.x > 0.5) return fault_;
    return make_brdf("ward", {0.2, 0.2})->sample(o, u);
  }
  double pdf(const glm::dvec3&, const glm::dvec3&) const override { return 0.0; }
  std::string_view name() const override { return "faulty"; }

 private:
  BrdfSample fault_;
};

TEST_CASE("Samples that are no numbers do not reach a slice") {
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 o(0.6, 0.0, 0.8);
  const Slice half = sample_slice(Faulty({up, 0.0, 1.0}), o, 16);
  REQUIRE(half.weights.size() > 50);
  for (const BrdfSample& fault :
       {BrdfSample{up, kNan, 1.0}, BrdfSample{up, kInfinity, 1.0}, BrdfSample{up, -1.0, 1.0},
        BrdfSample{{kNan, 0.0, 1.0}, 1.0, 1.0}, BrdfSample{{0.0, kInfinity, 1.0}, 1.0, 1.0}}) {
    const Slice slice = sample_slice(Faulty(fault), o, 16);
    CHECK(is_usable(slice));
    CHECK(slice.weights == half.weights);
    CHECK(slice.albedo == half.albedo);
  }
}

}  // namespace
}  // namespace lobelight
