// Every kind of material, fitted in every way, with any number of threads.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "base/pi.h"
#include "brdf/binary_file.h"
#include "brdf/brdf.h"
#include "brdf/ggx.h"
#include "fit/slice.h"
#include "fit/table_fitter.h"
#include "measured_files.h"
#include "table/half_float.h"

namespace lobelight {
namespace {

using testing::TemporaryFile;

// Red and blue of different widths: no one lobe's colour amounts to it.
testing::Reflectance coloured(const glm::dvec2& alpha) {
  return [alpha, sharp = Ggx(alpha), wide = Ggx(2.0 * alpha)](const glm::dvec3& i,
                                                              const glm::dvec3& o) {
    const double narrow = sharp.evaluate(i, o);
    return glm::dvec3(0.9 * narrow, 0.5 * narrow, 0.8 * wide.evaluate(i, o));
  };
}

const std::vector<char>& coloured_merl() {
  static const std::vector<char> file = testing::merl_file(coloured(glm::dvec2(0.3)));
  return file;
}

std::vector<char> coloured_rgl(double unit = 1.0) {
  testing::RglRecipe made;
  made.alpha = {0.2, 0.4};
  made.reflectance = [unit, at = coloured(made.alpha)](const glm::dvec3& i, const glm::dvec3& o) {
    return unit * at(i, o);
  };
  made.azimuths.clear();
  for (int p = 0; p <= 4; ++p) made.azimuths.push_back(-kPi + p * kPi / 4.0);
  for (int t = 0; t <= 4; ++t) made.elevations.push_back(0.5 * kPi * t / 4.0);
  made.resolution = 16;
  return testing::rgl_file(made);
}

struct Way {
  const char* name;
  FitMethod method;
  bool refine;
};
constexpr Way kWays[] = {{"plain", FitMethod::continuation, false},
                         {"refined", FitMethod::continuation, true},
                         {"independent", FitMethod::independent, false},
                         {"independent, refined", FitMethod::independent, true}};

// What a table stores, and what a view's slice reflects by other nodes than those it was fitted to.
void check_table(const LobeTable& table, const Brdf& brdf) {
  const LobeTable stored =
      LobeTable::from_rgba16f(table.alpha(), table.lobes(), table.views(), table.to_rgba16f());
  for (int p = 0; p < table.views().y; ++p) {
    for (int t = 0; t < table.views().x; ++t) {
      CAPTURE(t);
      CAPTURE(p);
      const Slice slice = sample_slice(brdf, table.view(t, p), 64, 0.5);
      double sum = 0.0;
      for (int k = 0; k < table.lobes(); ++k) {
        const LobeTable::Entry& first = stored.entry(k, t, p);
        const LobeTable::Entry& second = stored.second_entry(k, t, p);
        sum += first.w;
        CHECK(first.w >= 0.0);
        // Tints: red, blue, and what they leave for green.
        for (const double tint : {second.z, second.w, 3.0 - second.z - second.w}) {
          CHECK(tint >= -2e-3);
          CHECK(tint <= 3.0);
        }
      }
      CHECK(sum == doctest::Approx(slice.albedo).epsilon(0.03));
    }
  }
}

TEST_CASE("Tables of all materials, fitted in all ways, do not depend on the threads") {
  const TemporaryFile merl(".binary");
  merl.write(coloured_merl());
  const TemporaryFile rgl(".bsdf");
  rgl.write(coloured_rgl());
  struct Material {
    std::string brdf;
    glm::dvec2 alpha;
    glm::ivec2 views;
  };
  FitOptions options;
  options.nodes_per_axis = 24;
  for (const Material& material :
       {Material{"ward", {0.1, 0.3}, {4, 3}}, Material{"ggx", {0.1, 0.3}, {4, 3}},
        Material{merl.path(), {0.0, 0.0}, {4, 1}}, Material{rgl.path(), {0.0, 0.0}, {4, 3}}}) {
    const auto brdf = make_brdf(material.brdf, material.alpha);
    for (const Way& way : kWays) {
      CAPTURE(material.brdf);
      const std::string name = way.name;
      CAPTURE(name);
      Recipe recipe;
      recipe.lobes = 4;
      recipe.views = material.views;
      recipe.method = way.method;
      recipe.refine = way.refine;
      recipe.threads = 1;
      Progress progress;
      FitReport report;
      const LobeTable one = fit_table(*brdf, recipe, progress, &report, options);
      CHECK(one.has_second_texels() == (material.alpha.x == 0.0));
      CHECK(progress.fraction() == 1.0);
      check_table(one, *brdf);
      for (const int threads : {2, 8}) {
        CAPTURE(threads);
        recipe.threads = threads;
        FitReport again;
        const LobeTable table = fit_table(*brdf, recipe, progress, &again, options);
        CHECK(table.to_rgba16f() == one.to_rgba16f());
        CHECK(again.iterations == report.iterations);
        CHECK(again.log_likelihood == report.log_likelihood);
      }
      if (way.method == FitMethod::independent) continue;
      for (int p = 1; p < one.views().y; ++p) {
        for (int k = 0; k < one.lobes(); ++k) {
          CHECK(one.entry(k, 0, p) == one.entry(k, 0, 0));
          CHECK(one.second_entry(k, 0, p) == one.second_entry(k, 0, 0));
        }
      }
    }
  }
}

// A red lobe that sends light back to where it comes from and a blue mirror image, both so narrow
// that neither's density is a number where the other is.
TEST_CASE("Colours that no lobe shares give finite weights") {
  const TemporaryFile file(".binary");
  file.write(testing::merl_file([](const glm::dvec3& i, const glm::dvec3& o) {
    const auto peak = [&](const glm::dvec3& mean) {
      return 100.0 * std::exp(1000.0 * (glm::dot(i, mean) - 1.0));
    };
    return glm::dvec3(peak(o), 0.0, peak(glm::dvec3(-o.x, -o.y, o.z)));
  }));
  for (const bool refine : {false, true}) {
    Recipe recipe;
    recipe.brdf = file.path();
    recipe.alpha = {0.0, 0.0};
    recipe.lobes = 2;
    recipe.views = {4, 1};
    recipe.refine = refine;
    Progress progress;
    const LobeTable table = fit_table(recipe, progress, nullptr);
    REQUIRE(table.has_second_texels());
    int broken = 0;
    for (const std::uint16_t half : table.to_rgba16f()) {
      broken += std::isfinite(double_from_half(half)) ? 0 : 1;
    }
    CHECK(broken == 0);
    check_table(table, *make_brdf(recipe.brdf, recipe.alpha));
  }
}

// In any unit a file's table is the same but for a factor, as far as half floats go.
TEST_CASE("Numbers of any size are fitted, or refused with a sentence") {
  const auto made = [](double unit) {
    std::vector<char> bytes = coloured_merl();
    for (std::size_t at = testing::kMerlHeader; at < bytes.size(); at += sizeof(double)) {
      double number = 0.0;
      std::memcpy(&number, &bytes[at], sizeof(double));
      number *= unit;
      std::memcpy(&bytes[at], &number, sizeof(double));
    }
    return bytes;
  };
  Recipe recipe;
  recipe.alpha = {0.3, 0.3};
  recipe.lobes = 2;
  recipe.views = {3, 1};
  FitOptions options;
  options.nodes_per_axis = 24;
  const auto fitted = [&](const TemporaryFile& file) {
    recipe.brdf = file.path();
    Progress progress;
    return fit_table(recipe, progress, nullptr, options);
  };
  const TemporaryFile plain(".binary");
  plain.write(made(1.0));
  const LobeTable expected = fitted(plain);
  const TemporaryFile dim(".binary");
  dim.write(made(0x1p-8));
  const LobeTable table = fitted(dim);
  for (int k = 0; k < 2; ++k) {
    CHECK(table.entry(k, 1, 0).w == doctest::Approx(0x1p-8 * expected.entry(k, 1, 0).w));
    CHECK(table.entry(k, 1, 0).z == doctest::Approx(expected.entry(k, 1, 0).z));
  }
  const auto message_of = [&](const TemporaryFile& file) -> std::string {
    try {
      fitted(file);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  for (const double unit : {1e-20, 1e6, 1e37}) {
    CAPTURE(unit);
    const TemporaryFile file(".binary");
    file.write(made(unit));
    const std::string message = message_of(file);
    CAPTURE(message);
    CHECK(message.find(".binary reflects up to ") != std::string::npos);
    CHECK(message.find("not in 1/sr") != std::string::npos);
    CHECK((message.find(" of 3 views") != std::string::npos) == (unit > 1.0));
  }
  recipe.alpha = {0.2, 0.4};
  recipe.views = {3, 2};
  const TemporaryFile rgl(".bsdf");
  rgl.write(coloured_rgl(1e30));
  CHECK(message_of(rgl).find(".bsdf reflects up to ") != std::string::npos);
  recipe.alpha = {0.3, 0.3};
  recipe.views = {3, 1};
  const TemporaryFile beyond(".binary");
  beyond.write(made(1e60));
  CHECK_THROWS_WITH_AS(fitted(beyond), doctest::Contains("too large for a reflectance"),
                       MeasuredFileError);
}

}  // namespace
}  // namespace lobelight
