#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/pi.h"
#include "statistics.h"
#include "table/lobe_table.h"

namespace lobelight {
namespace {

glm::dvec3 direction(double elevation, double azimuth) {
  return {std::sin(elevation) * std::cos(azimuth), std::sin(elevation) * std::sin(azimuth),
          std::cos(elevation)};
}

// A table of arbitrary lobes.
LobeTable arbitrary_table(const glm::ivec2& views, int lobes = 3) {
  LobeTable table({0.1, views.y == 1 ? 0.1 : 0.3}, lobes, views);
  testing::Uniform uniform(7);
  for (int p = 0; p < views.y; ++p) {
    for (int t = 0; t < views.x; ++t) {
      Mixture mixture;
      for (int k = 0; k < lobes; ++k) {
        mixture.push_back({uniform.next(), {uniform.direction_above(), 500.0 * uniform.next()}});
      }
      table.set_mixture_at_view(t, p, mixture);
    }
  }
  return table;
}

void check_same(const Mixture& a, const Mixture& b, double tolerance) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    CHECK(a[k].weight == doctest::Approx(b[k].weight).epsilon(tolerance));
    CHECK(a[k].gaussian.kappa == doctest::Approx(b[k].gaussian.kappa).epsilon(tolerance));
    CHECK(glm::length(a[k].gaussian.mean - b[k].gaussian.mean) < tolerance);
  }
}

TEST_CASE("Views run from the normal to 89.4 degrees and over one quadrant") {
  const LobeTable table({0.1, 0.2}, 2, {5, 3});
  for (int p = 0; p < 3; ++p) {
    for (int t = 0; t < 5; ++t) {
      const double rest = 1.0 - t / 4.0;  // what is left to grazing, in columns; squared in angle
      const double elevation = 89.4 * kPi / 180.0 * (1.0 - rest * rest);
      const glm::dvec3 wanted = direction(elevation, 0.5 * kPi * p / 2.0);
      CHECK(table.elevation(t) == doctest::Approx(elevation));
      CHECK(table.column(elevation) == doctest::Approx(t));
      CHECK(glm::length(table.view(t, p) - wanted) < 1e-15);
    }
  }
  // Exactly in the planes of symmetry, because slices are sampled symmetrically only there.
  CHECK(table.view(3, 0).y == 0.0);
  CHECK(table.view(3, 2).x == 0.0);
  CHECK(LobeTable({0.1, 0.1}, 2, {5, 1}).view(3, 0).y == 0.0);
}

TEST_CASE("A view's lobes come back from the table, and from interpolation at the view") {
  for (const glm::ivec2& views : {glm::ivec2(6, 1), glm::ivec2(5, 4)}) {
    LobeTable table = arbitrary_table(views);
    testing::Uniform uniform(9);
    for (int p = 0; p < views.y; ++p) {
      for (int t = 0; t < views.x; ++t) {
        Mixture mixture;
        for (int k = 0; k < table.lobes(); ++k) {
          mixture.push_back({uniform.next(), {uniform.direction_above(), 90.0 * uniform.next()}});
        }
        table.set_mixture_at_view(t, p, mixture);
        check_same(table.mixture_at_view(t, p), mixture, 1e-6);
        // At the pole every azimuth is the same direction: only the first one is found by it.
        if (t > 0 || p == 0) check_same(table.interpolate(table.view(t, p)), mixture, 1e-6);
      }
    }
  }
}

TEST_CASE("Between views the entries are interpolated bilinearly") {
  const LobeTable table = arbitrary_table({5, 4});
  const double t = 2.3;
  const double p = 1.6;
  const glm::dvec3 o = direction(table.elevation(t), 0.5 * kPi * p / 3.0);
  const Mixture mixture = table.interpolate(o);
  for (int k = 0; k < table.lobes(); ++k) {
    const LobeTable::Entry wanted =
        0.7 * 0.4 * table.entry(k, 2, 1) + 0.3 * 0.4 * table.entry(k, 3, 1) +
        0.7 * 0.6 * table.entry(k, 2, 2) + 0.3 * 0.6 * table.entry(k, 3, 2);
    const Lobe& lobe = mixture[static_cast<std::size_t>(k)];
    CHECK(lobe.weight == doctest::Approx(wanted.w));
    // The contract's decoding: h = normalize(slopes, 1), i = 2 (o·h) h − o, κ = 2^z / (o·h).
    const glm::dvec3 h =
        glm::normalize(glm::dvec3(wanted.x * table.alpha().x, wanted.y * table.alpha().y, 1.0));
    const double o_dot_h = glm::dot(o, h);
    CHECK(glm::length(lobe.gaussian.mean - (2.0 * o_dot_h * h - o)) < 1e-12);
    CHECK(lobe.gaussian.kappa == doctest::Approx(std::exp2(wanted.z) / o_dot_h));
  }
}

TEST_CASE("Anisotropic tables are mirrored into the other quadrants") {
  const LobeTable table = arbitrary_table({5, 4});
  testing::Uniform uniform(3);
  for (int n = 0; n < 100; ++n) {
    const glm::dvec3 o = glm::abs(uniform.direction_above());
    const Mixture first = table.interpolate(o);
    for (const glm::dvec3& s :
         {glm::dvec3(-1, 1, 1), glm::dvec3(1, -1, 1), glm::dvec3(-1, -1, 1)}) {
      Mixture mirrored = table.interpolate(s * o);
      for (Lobe& lobe : mirrored) lobe.gaussian.mean *= s;
      check_same(mirrored, first, 1e-12);
    }
  }
}

TEST_CASE("Isotropic tables turn with the view") {
  const LobeTable table = arbitrary_table({6, 1});
  testing::Uniform uniform(4);
  for (int n = 0; n < 100; ++n) {
    const double elevation = 1.5 * uniform.next();
    const double azimuth = 2.0 * kPi * uniform.next();
    const Mixture in_plane = table.interpolate(direction(elevation, 0.0));
    Mixture turned = table.interpolate(direction(elevation, azimuth));
    for (Lobe& lobe : turned) {
      const glm::dvec3 m = lobe.gaussian.mean;
      lobe.gaussian.mean = {m.x * std::cos(azimuth) + m.y * std::sin(azimuth),
                            m.y * std::cos(azimuth) - m.x * std::sin(azimuth), m.z};
    }
    check_same(turned, in_plane, 1e-9);
  }
}

TEST_CASE("Views beyond the grid are clamped") {
  const LobeTable table = arbitrary_table({6, 4});
  const Mixture last = table.mixture_at_view(5, 0);
  const Mixture beyond = table.interpolate(direction(89.9 * kPi / 180.0, 0.0));
  const Mixture below = table.interpolate(direction(2.5, 0.3));
  for (std::size_t k = 0; k < last.size(); ++k) {
    CHECK(beyond[k].weight == doctest::Approx(last[k].weight));
    CHECK(std::isfinite(below[k].gaussian.kappa));
    CHECK(below[k].gaussian.kappa >= 0.0);
    CHECK(glm::length(below[k].gaussian.mean) == doctest::Approx(1.0));
  }
}

TEST_CASE("Views below the last elevation are that view, as the shader has them") {
  for (const glm::ivec2& views : {glm::ivec2(5, 1), glm::ivec2(5, 4)}) {
    const LobeTable table = arbitrary_table(views);
    for (const double azimuth : {0.0, 0.4, 2.0, -1.2}) {
      const Mixture last = table.interpolate(direction(LobeTable::kMaxElevation, azimuth));
      for (const double degrees : {89.7, 90.0, 100.0, 150.0}) {
        const glm::dvec3 below = direction(degrees * kPi / 180.0, azimuth);
        const glm::dvec3 lifted =
            glm::normalize(glm::dvec3(below.x, below.y, std::cos(LobeTable::kMaxElevation)));
        CAPTURE(degrees);
        check_same(table.interpolate(below), table.interpolate(lifted), 1e-5);
        if (degrees <= 90.0) check_same(table.interpolate(below), last, 2e-2);
      }
    }
    for (const Lobe& lobe : table.interpolate({0.0, 0.0, -1.0})) {
      CHECK(std::isfinite(lobe.gaussian.kappa));
      CHECK(glm::length(lobe.gaussian.mean) == doctest::Approx(1.0));
    }
  }
}

TEST_CASE("Sharpness is clamped to what is stored") {
  LobeTable table({0.1, 0.1}, 3, {2, 1});
  const glm::dvec3 up(0.0, 0.0, 1.0);
  table.set_mixture_at_view(0, 0, {{0.1, {up, 0.0}}, {0.1, {up, 1e30}}, {0.1, {up, 64.0}}});
  CHECK(table.entry(0, 0, 0).z == LobeTable::kMinLog2Kappa);
  CHECK(table.entry(1, 0, 0).z == LobeTable::kMaxLog2Kappa);
  CHECK(table.entry(2, 0, 0).z == 6.0);
}

TEST_CASE("Slopes beyond the half floats' range are stored as its end") {
  LobeTable table({1e-4, 0.1}, 1, {2, 1});
  table.set_mixture_at_view(1, 0, {{0.1, {glm::normalize(glm::dvec3(1.0, 0.0, 1e-3)), 1.0}}});
  CHECK(table.entry(0, 1, 0).x > 65504.0);
  CHECK(table.to_rgba16f()[4] == 0x7bff);
}

TEST_CASE("The texture has the contract's layout and comes back within half precision") {
  const LobeTable table = arbitrary_table({5, 4});
  CHECK(table.width() == 5);
  CHECK(table.height() == 12);
  const std::vector<std::uint16_t> texels = table.to_rgba16f();
  REQUIRE(texels.size() == 4 * 5 * 12);
  const LobeTable back = LobeTable::from_rgba16f(table.alpha(), 3, table.views(), texels);
  for (int k = 0; k < 3; ++k) {
    for (int p = 0; p < 4; ++p) {
      for (int t = 0; t < 5; ++t) {
        for (int c = 0; c < 4; ++c) {
          const double wanted = table.entry(k, t, p)[c];
          CHECK(back.entry(k, t, p)[c] == doctest::Approx(wanted).epsilon(0x1p-11));
          // Row k · P + p, column t.
          CHECK(texels[static_cast<std::size_t>(4 * ((k * 4 + p) * 5 + t) + c)] ==
                back.to_rgba16f()[static_cast<std::size_t>(4 * ((k * 4 + p) * 5 + t) + c)]);
        }
      }
    }
  }
  CHECK(back.to_rgba16f() == texels);
  // 1.0 as weight of lobe 2 in view (3, 1): row 2 · 4 + 1, column 3, last channel.
  LobeTable marked({0.1, 0.3}, 3, {5, 4});
  const glm::dvec3 up(0.0, 0.0, 1.0);
  marked.set_mixture_at_view(3, 1, {{0.0, {up, 1.0}}, {0.0, {up, 1.0}}, {1.0, {up, 1.0}}});
  CHECK(marked.to_rgba16f()[4 * (9 * 5 + 3) + 3] == 0x3c00);
}

TEST_CASE("Impossible tables are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(LobeTable({0.0, 0.1}, 1, {2, 1}), std::invalid_argument);
  CHECK_THROWS_AS(LobeTable({0.1, nan}, 1, {2, 1}), std::invalid_argument);
  CHECK_THROWS_AS(LobeTable({0.1, 0.1}, 0, {2, 1}), std::invalid_argument);
  CHECK_THROWS_AS(LobeTable({0.1, 0.1}, 1, {1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(LobeTable({0.1, 0.1}, 1, {2, 0}), std::invalid_argument);
  LobeTable table({0.1, 0.1}, 2, {2, 1});
  CHECK_THROWS_AS(table.set_mixture_at_view(0, 0, Mixture(3)), std::invalid_argument);
  LobeTable broken = table;
  broken.set_mixture_at_view(0, 0, {{nan, {}}, {1.0, {}}});
  CHECK_THROWS_AS(broken.to_rgba16f(), std::logic_error);
  std::vector<std::uint16_t> texels(4 * 2 * 2, 0);
  CHECK_NOTHROW(LobeTable::from_rgba16f({0.1, 0.1}, 2, {2, 1}, texels));
  texels.back() = 0x7c00;
  CHECK_THROWS_AS(LobeTable::from_rgba16f({0.1, 0.1}, 2, {2, 1}, texels), std::invalid_argument);
  texels.pop_back();
  CHECK_THROWS_AS(LobeTable::from_rgba16f({0.1, 0.1}, 2, {2, 1}, texels), std::invalid_argument);
}

TEST_CASE("Lobes keep their channels' weights, in texels too") {
  LobeTable table({0.1, 0.2}, 2, {3, 2});
  CHECK_FALSE(table.has_second_texels());
  CHECK(table.height() == 4);
  CHECK_THROWS_AS(table.set_channel_weights_at_view(0, 0, {{1, 2, 3}, {4, 5, 6}}),
                  std::invalid_argument);
  table.add_second_texels();
  CHECK(table.height() == 8);
  testing::Uniform uniform(5);
  for (int p = 0; p < 2; ++p) {
    for (int t = 0; t < 3; ++t) {
      const glm::dvec3 o = table.view(t, p);
      table.set_mixture_at_view(t, p, {{0.5, {{0, 0, 1}, 50.0}}, {0.25, {{0, 0, 1}, 20.0}}});
      const std::vector<glm::dvec3> weights = {{uniform.next(), uniform.next(), uniform.next()},
                                               {0.0, 0.0, uniform.next()}};
      table.set_channel_weights_at_view(t, p, weights);
      table.add_second_texels();  // changes nothing where there are some
      std::vector<std::vector<glm::dvec3>> readings = {table.channel_weights_at_view(t, p)};
      // At the pole all azimuths are one view, read in column 0.
      if (t > 0 || p == 0) readings.push_back(table.interpolate_channel_weights(o));
      for (const auto& found : readings) {
        for (std::size_t k = 0; k < 2; ++k) {
          for (int channel = 0; channel < 3; ++channel) {
            CHECK(found[k][channel] == doctest::Approx(weights[k][channel]));
          }
          const double mean = (weights[k].x + weights[k].y + weights[k].z) / 3.0;
          CHECK(table.mixture_at_view(t, p)[k].weight == doctest::Approx(mean));
        }
      }
    }
  }
  const auto texels = table.to_rgba16f();
  CHECK(texels.size() == 4u * 3u * 8u);
  const LobeTable back = LobeTable::from_rgba16f({0.1, 0.2}, 2, {3, 2}, texels);
  CHECK(back.has_second_texels());
  CHECK(back.to_rgba16f() == texels);
  // Between views the mean of the channels stays the lobe's weight.
  const glm::dvec3 o = glm::normalize(glm::dvec3(0.3, -0.2, 0.6));
  const auto weights = back.interpolate_channel_weights(o);
  const Mixture mixture = back.interpolate(o);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK((weights[k].x + weights[k].y + weights[k].z) / 3.0 ==
          doctest::Approx(mixture[k].weight).epsilon(2e-3));
  }
}

TEST_CASE("A table without second texels is colourless") {
  LobeTable table({0.1, 0.1}, 1, {2, 1});
  table.set_mixture_at_view(1, 0, {{0.7, {{0, 0, 1}, 50.0}}});
  CHECK(table.channel_weights_at_view(1, 0).front() == glm::dvec3(0.7));
  CHECK(table.second_entry(0, 1, 0) == LobeTable::kPlain);
}

}  // namespace
}  // namespace lobelight
