#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>

#include "base/pi.h"
#include "brdf/binary_file.h"
#include "brdf/ggx.h"
#include "brdf/rgl.h"
#include "measured_files.h"
#include "rgl_oracle.h"
#include "statistics.h"

namespace lobelight {
namespace {

using testing::from_angles;
using testing::TemporaryFile;
using testing::TensorWriter;

double radians(double degrees) { return degrees * kPi / 180.0; }

// The generator of tools/oracles/rgl_oracle.py.
std::vector<float> numbers(std::size_t count, std::uint32_t seed) {
  std::uint32_t state = seed;
  std::vector<float> values(count);
  for (float& value : values) {
    state = state * 1664525u + 1013904223u;
    value = static_cast<float>((state >> 16) + 1) / 65536.0F;
  }
  return values;
}

std::vector<float> in_radians(const std::vector<double>& degrees) {
  std::vector<float> values;
  for (const double angle : degrees) values.push_back(static_cast<float>(radians(angle)));
  return values;
}

struct Nodes {
  std::vector<double> phi;
  std::vector<double> theta;
};

// The files of tools/oracles/rgl_oracle.py, with a hook that may spoil a field.
using Spoil = std::function<void(const std::string& name, std::vector<std::uint64_t>& shape,
                                 std::vector<float>& values)>;
std::vector<char> arbitrary_file(const Nodes& nodes, const Spoil& spoil = nullptr) {
  const std::uint64_t p = nodes.phi.size();
  const std::uint64_t t = nodes.theta.size();
  TensorWriter writer;
  const auto add = [&](const std::string& name, std::vector<std::uint64_t> shape,
                       std::vector<float> values) {
    if (spoil) spoil(name, shape, values);
    if (!shape.empty()) writer.add(name, std::move(shape), std::move(values));
  };
  writer.add_bytes("description", "arbitrary");
  add("theta_i", {t}, in_radians(nodes.theta));
  add("phi_i", {p}, in_radians(nodes.phi));
  add("sigma", {3, 4}, numbers(12, 1));
  add("ndf", {5, 6}, numbers(30, 2));
  add("vndf", {p, t, 6, 5}, numbers(p * t * 30, 3));
  add("rgb", {p, t, 3, 4, 4}, numbers(p * t * 48, 5));
  writer.add_bytes("jacobian", std::string(1, '\1'));
  return writer.file();
}

const Nodes kSmall{{0.0}, {0.0, 30.0, 60.0, 90.0}};

TEST_CASE("RGL files mean what Mitsuba's reader takes them to mean") {
  const std::map<std::string, Nodes> files = {
      {"isotropic", kSmall},
      {"circle", {{-180.0, -90.0, 0.0, 90.0, 180.0}, {0.0, 45.0, 80.0}}},
      {"half", {{-180.0, -120.0, -60.0, 0.0}, {10.0, 40.0, 85.0}}},
      {"quarter", {{-180.0, -150.0, -90.0}, {0.0, 45.0, 90.0}}},
  };
  const TemporaryFile file(".bsdf");
  for (const auto& row : oracle::kReflectances) {
    CAPTURE(row.file);
    CAPTURE(row.o_elevation);
    file.write(arbitrary_file(files.at(row.file)));
    const auto data = read_rgl(file.path());
    CHECK(data->clamped() == 0);
    CHECK(data->is_isotropic() == (std::string(row.file) == "isotropic"));
    const glm::dvec3 value =
        data->reflected(from_angles(radians(row.i_elevation), radians(row.i_azimuth)),
                        from_angles(radians(row.o_elevation), radians(row.o_azimuth)));
    for (int channel = 0; channel < 3; ++channel) {
      // Mitsuba computes in single precision.
      CHECK(value[channel] == doctest::Approx(row.channels[channel]).epsilon(2e-5));
    }
  }
}

TEST_CASE("An RGL file of GGX gives GGX back") {
  const glm::dvec2 alpha(0.3, 0.3);
  const Ggx ggx(alpha);
  testing::RglRecipe recipe;
  recipe.reflectance = [&](const glm::dvec3& i, const glm::dvec3& o) {
    return glm::dvec3(1.0, 0.5, 0.25) * ggx.evaluate(i, o);
  };
  recipe.alpha = alpha;
  for (int t = 0; t < 10; ++t) recipe.elevations.push_back(0.5 * kPi * t / 9.0);
  recipe.resolution = 48;
  const TemporaryFile file(".bsdf");
  file.write(testing::rgl_file(recipe));
  const auto data = read_rgl(file.path());
  CHECK(data->is_isotropic());

  // Relative errors where GGX reflects to, at stored views, where they are those of the squares'
  // interpolation alone, and half-way between them.
  for (const double between : {0.0, 0.5}) {
    testing::Uniform uniform(1);
    double sum = 0.0;
    double worst = 0.0;
    int count = 0;
    for (int n = 0; n < 3000; ++n) {
      const glm::dvec3 o = from_angles(0.5 * kPi * (n % 7 + between) / 9.0, 6.0 * uniform.next());
      const auto drawn = ggx.sample(o, uniform.next2());
      if (!drawn || drawn->direction.z < 0.1) continue;
      const glm::dvec3 i = drawn->direction;
      const glm::dvec3 expected = recipe.reflectance(i, o) * i.z;
      const double error = glm::length(data->reflected(i, o) - expected) / glm::length(expected);
      sum += error;
      worst = std::max(worst, error);
      ++count;
    }
    CAPTURE(between);
    CAPTURE(sum / count);
    CAPTURE(worst);
    CHECK(sum / count < (between == 0.0 ? 0.004 : 0.02));
    CHECK(worst < 0.15);
  }
}

TEST_CASE("Bad numbers in an RGL file count as 0 and are counted") {
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(), -1.0F};
  std::size_t put_in = 0;
  const TemporaryFile file(".bsdf");
  file.write(arbitrary_file(kSmall, [&](const std::string& name, auto&, std::vector<float>& v) {
    if (name == "theta_i" || name == "phi_i") return;
    for (std::size_t n = 0; n < v.size(); n += 5) v[n] = bad[put_in++ % 3];
  }));
  const auto data = read_rgl(file.path());
  CHECK(data->clamped() == put_in);
  testing::Uniform uniform(2);
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 value = data->reflected(uniform.direction_above(), uniform.direction_above());
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(std::isfinite(value[channel]));
      CHECK(value[channel] >= 0.0);
    }
  }
}

TEST_CASE("A file that is not an RGL file is refused by name and reason") {
  const TemporaryFile file(".bsdf");
  const auto refused = [&](const std::vector<char>& bytes, const std::string& reason) {
    file.write(bytes);
    CHECK_THROWS_WITH_AS(read_rgl(file.path()), (file.path() + ": " + reason).c_str(),
                         MeasuredFileError);
  };
  refused({}, "ends before the end of a tensor file's header");
  refused(std::vector<char>(100, 'x'), "is not a tensor file");

  file.write({'x'});
  std::filesystem::resize_file(file.path(), std::uintmax_t{5} << 30);  // sparse
  CHECK_THROWS_WITH_AS(read_rgl(file.path()), (file.path() + ": is larger than 2 GiB").c_str(),
                       MeasuredFileError);

  const std::vector<char> good = arbitrary_file(kSmall);
  std::vector<char> bytes = good;
  bytes[12] = 2;
  refused(bytes, "is a tensor file of version 2.0, but only 1.0 is known");
  bytes = good;
  bytes[17] = '\x7f';
  refused(bytes, "claims to have 2130706440 fields");

  // Cut off anywhere.
  for (std::size_t size = 1; size < good.size(); size += size < 700 ? 7 : 97) {
    file.write({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)});
    CHECK_THROWS_AS(read_rgl(file.path()), MeasuredFileError);
  }

  const auto spoilt = [&](const std::string& field, auto change) {
    return arbitrary_file(kSmall, [&](const std::string& name, std::vector<std::uint64_t>& shape,
                                      std::vector<float>& values) {
      if (name == field) change(shape, values);
    });
  };
  const auto shaped = [&](const std::string& field, const std::vector<std::uint64_t>& wanted) {
    return spoilt(field, [&](auto& shape, auto&) { shape = wanted; });
  };
  refused(shaped("rgb", {}), "has no field \"rgb\"");
  refused(shaped("vndf", {1, 4, 30}), "its field \"vndf\" is not float32 with 4 dimensions");
  refused(shaped("vndf", {2, 4, 6, 5}),
          "its field \"vndf\" does not have one slice for each direction");
  refused(shaped("ndf", {30, 1}), "its field \"ndf\" has fewer than 2 x 2 values in a slice");
  refused(shaped("rgb", {1, 4, 3, std::uint64_t{1} << 40, std::uint64_t{1} << 40}),
          "its field \"rgb\" claims to be larger than the file");
  refused(shaped("ndf", {std::uint64_t{1} << 63, 4}),
          "its field \"ndf\" claims to be larger than the file");
  refused(shaped("theta_i", {0}), "its field \"theta_i\" is empty");
  refused(spoilt("theta_i", [](auto&, auto& values) { values[1] = values[0]; }),
          "its angles \"theta_i\" do not ascend");
  refused(spoilt("phi_i", [](auto&, auto& values) { values[0] = std::nanf(""); }),
          "its angles \"phi_i\" do not ascend");
  refused(spoilt("rgb", [](auto&, auto& values) { std::fill(values.begin(), values.end(), -1.F); }),
          "holds no positive number");
  refused(arbitrary_file({{-60.0, 0.0, 60.0}, {0.0, 80.0}}),
          "its angles \"phi_i\" cover neither the circle nor its half nor its quarter");
}

TEST_CASE("A file of spectra says which file to take instead") {
  TensorWriter writer;
  writer.add("spectra", {1}, {1.0F});
  const TemporaryFile file(".bsdf");
  file.write(writer.file());
  CHECK_THROWS_WITH_AS(
      read_rgl(file.path()),
      (file.path() + ": holds spectra; Lobelight reads the material's RGB file (NAME_rgb.bsdf)")
          .c_str(),
      MeasuredFileError);
}

}  // namespace
}  // namespace lobelight
