#include "measured_files.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/pi.h"
#include "brdf/ggx.h"
#include "statistics.h"

namespace lobelight::testing {

namespace {

template <typename T>
void append(std::vector<char>& bytes, const T* elements, std::size_t count) {
  const char* const begin = reinterpret_cast<const char*>(elements);
  bytes.insert(bytes.end(), begin, begin + count * sizeof(T));
}

template <typename T>
void append(std::vector<char>& bytes, T value) {
  append(bytes, &value, 1);
}

// The normal stored at a point of the unit square.
glm::dvec3 normal_at(const glm::dvec2& point, double azimuth_of_zero) {
  return from_angles(point.x * point.x * 0.5 * kPi, (2.0 * point.y - 1.0) * kPi + azimuth_of_zero);
}

// The unit square's density that stands for the density 1 over solid angle: 2π² x sin θ.
double solid_angle(const glm::dvec2& point) {
  return 2.0 * kPi * kPi * point.x * std::sin(point.x * point.x * 0.5 * kPi);
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& ending)
    : path_((std::filesystem::temp_directory_path() /
             ("lobelight-test-" + std::to_string(std::random_device{}()) + ending))
                .u8string()) {}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(std::filesystem::u8path(path_), ignored);
}

void TemporaryFile::write(const std::vector<char>& bytes) const {
  std::ofstream stream(std::filesystem::u8path(path_), std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

glm::dvec3 from_angles(double elevation, double azimuth) {
  return {std::sin(elevation) * std::cos(azimuth), std::sin(elevation) * std::sin(azimuth),
          std::cos(elevation)};
}

std::vector<char> merl_file(const Reflectance& reflectance) {
  constexpr double kUnit[3] = {1500.0, 1500.0 / 1.15, 1500.0 / 1.66};
  std::vector<double> numbers(3 * kMerlBins);
  std::size_t bin = 0;
  for (int h = 0; h < 90; ++h) {
    const double root = (h + 0.5) / 90.0;
    const double theta_half = root * root * 0.5 * kPi;
    for (int d = 0; d < 90; ++d) {
      const double theta_difference = (d + 0.5) / 90.0 * 0.5 * kPi;
      for (int p = 0; p < 180; ++p, ++bin) {
        // The light in the half-vector's frame, its mirror image at the half-vector, and both
        // turned about y so that the half-vector has the polar angle θ_h in the plane y = 0.
        const double phi_difference = (p + 0.5) / 180.0 * kPi;
        const glm::dvec3 light = from_angles(theta_difference, phi_difference);
        const auto turned = [&](const glm::dvec3& v) {
          const double c = std::cos(theta_half);
          const double s = std::sin(theta_half);
          return glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
        };
        const glm::dvec3 i = turned(light);
        const glm::dvec3 o = turned({-light.x, -light.y, light.z});
        const bool above = i.z > 0.0 && o.z > 0.0;
        const glm::dvec3 value = above ? reflectance(i, o) : glm::dvec3(-1.0);
        for (int channel = 0; channel < 3; ++channel) {
          numbers[static_cast<std::size_t>(channel) * kMerlBins + bin] =
              value[channel] * kUnit[channel];
        }
      }
    }
  }
  std::vector<char> bytes;
  for (const std::int32_t count : {90, 90, 180}) append(bytes, count);
  append(bytes, numbers.data(), numbers.size());
  return bytes;
}

void TensorWriter::add(const std::string& name, std::vector<std::uint64_t> shape,
                       std::vector<float> values) {
  Field field{name, 10, std::move(shape), {}};
  append(field.data, values.data(), values.size());
  fields_.push_back(std::move(field));
}

void TensorWriter::add_bytes(const std::string& name, const std::string& text) {
  fields_.push_back({name, 1, {text.size()}, {text.begin(), text.end()}});
}

std::vector<char> TensorWriter::file() const {
  std::size_t header = 12 + 2 + 4;
  for (const Field& field : fields_) header += 2 + field.name.size() + 11 + 8 * field.shape.size();
  std::vector<char> bytes;
  append(bytes, "tensor_file", 12);
  append(bytes, std::uint8_t{1});
  append(bytes, std::uint8_t{0});
  append(bytes, static_cast<std::uint32_t>(fields_.size()));
  std::uint64_t offset = header;
  for (const Field& field : fields_) {
    append(bytes, static_cast<std::uint16_t>(field.name.size()));
    append(bytes, field.name.data(), field.name.size());
    append(bytes, static_cast<std::uint16_t>(field.shape.size()));
    append(bytes, field.type);
    append(bytes, offset);
    append(bytes, field.shape.data(), field.shape.size());
    offset += field.data.size();
  }
  for (const Field& field : fields_) append(bytes, field.data.data(), field.data.size());
  return bytes;
}

namespace {

// One slice's warp from [0, 1]² to the square of normals, from sums over fine cells: written for
// this file alone, so that the reader's own inversion is tested against another one.
class Warp {
 public:
  Warp(const std::vector<float>& values, std::size_t resolution) : n_(resolution) {
    double mass = 0.0;
    for (std::size_t row = 0; row < n_; ++row) {
      rows_.push_back({&values[row * n_], &values[row * n_] + n_});
    }
    for (std::size_t step = 0; step <= kSteps; ++step) {
      const double y = static_cast<double>(step) / kSteps;
      if (step > 0) mass += line(y - 0.5 / kSteps).back();
      below_.push_back(mass);
    }
  }

  // The points of one row, all with the same u.y.
  std::vector<glm::dvec2> row(double u_y, const std::vector<double>& u_x) const {
    const double y = find(below_, u_y);
    const std::vector<double> sums = line(y);
    std::vector<glm::dvec2> points;
    for (const double u : u_x) points.emplace_back(find(sums, u), y);
    return points;
  }

 private:
  static constexpr std::size_t kSteps = 1024;

  // Sums of the values at height y from x = 0 on.
  std::vector<double> line(double y) const {
    const double at = y * static_cast<double>(n_ - 1);
    const auto row = std::min(static_cast<std::size_t>(at), n_ - 2);
    const double t = at - static_cast<double>(row);
    std::vector<double> sums{0.0};
    for (std::size_t step = 0; step < kSteps; ++step) {
      const double x = (static_cast<double>(step) + 0.5) / kSteps * static_cast<double>(n_ - 1);
      const auto column = std::min(static_cast<std::size_t>(x), n_ - 2);
      const double s = x - static_cast<double>(column);
      const auto along = [&](const std::vector<double>& r) {
        return (1.0 - s) * r[column] + s * r[column + 1];
      };
      sums.push_back(sums.back() + (1.0 - t) * along(rows_[row]) + t * along(rows_[row + 1]));
    }
    return sums;
  }

  // Where in [0, 1] the sums reach the share u of their end.
  static double find(const std::vector<double>& sums, double u) {
    const double wanted = u * sums.back();
    const auto above = std::upper_bound(sums.begin(), sums.end() - 1, wanted);
    const auto second = std::max<std::ptrdiff_t>(1, above - sums.begin());
    const double low = sums[static_cast<std::size_t>(second - 1)];
    const double high = sums[static_cast<std::size_t>(second)];
    const double t = high > low ? (wanted - low) / (high - low) : 0.0;
    return (static_cast<double>(second - 1) + std::clamp(t, 0.0, 1.0)) / kSteps;
  }

  std::size_t n_;
  std::vector<std::vector<double>> rows_;
  std::vector<double> below_;
};

}  // namespace

std::vector<char> rgl_file(const RglRecipe& recipe) {
  const std::size_t n = recipe.resolution;
  const bool isotropic = recipe.azimuths.size() == 1;
  const auto point = [n](std::size_t row, std::size_t column) {
    return glm::dvec2(column, row) / static_cast<double>(n - 1);
  };
  // Two functions of a direction as squares, and what a reader finds for them between the values,
  // so that this interpolation cancels.
  using Square = std::vector<float>;
  const auto square_of = [&](const std::function<double(const glm::dvec3&)>& function) {
    Square values;
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t column = 0; column < n; ++column) {
        // Not quite the horizon, where there is no projected area to divide by.
        const glm::dvec2 at = point(row, column);
        values.push_back(
            static_cast<float>(function(normal_at({std::min(at.x, 0.9999), at.y}, 0.0))));
      }
    }
    return values;
  };
  const auto value_at = [&](const Square& square, const glm::dvec2& at) {
    const glm::dvec2 scaled = at * static_cast<double>(n - 1);
    const auto column = std::min(static_cast<std::size_t>(scaled.x), n - 2);
    const auto row = std::min(static_cast<std::size_t>(scaled.y), n - 2);
    const glm::dvec2 t = scaled - glm::dvec2(column, row);
    const auto d = [&](std::size_t r, std::size_t c) {
      return static_cast<double>(square[r * n + c]);
    };
    return glm::mix(glm::mix(d(row, column), d(row, column + 1), t.x),
                    glm::mix(d(row + 1, column), d(row + 1, column + 1), t.x), t.y);
  };
  const Square ndf =
      square_of([&](const glm::dvec3& m) { return ggx_normal_density(m, recipe.alpha); });
  // σ(o) = ∫ D(m) max(0, m·o) dm = o_z / G1(o)
  const Square sigma =
      square_of([&](const glm::dvec3& o) { return o.z * (1.0 + ggx_lambda(o, recipe.alpha)); });

  std::vector<float> vndf;
  std::vector<float> rgb;
  for (const double azimuth : recipe.azimuths) {
    for (const double elevation : recipe.elevations) {
      const glm::dvec3 o = from_angles(elevation, azimuth);
      const double area =
          value_at(sigma, {std::sqrt(elevation / (0.5 * kPi)), (azimuth + kPi) / (2.0 * kPi)});
      std::vector<float> density;
      for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t column = 0; column < n; ++column) {
          const glm::dvec2 at = point(row, column);
          const glm::dvec3 m = normal_at(at, isotropic ? azimuth : 0.0);
          density.push_back(static_cast<float>(ggx_normal_density(m, recipe.alpha) *
                                               std::max(0.0, glm::dot(m, o)) * solid_angle(at)));
        }
      }
      const Warp warp(density, n);
      vndf.insert(vndf.end(), density.begin(), density.end());
      const std::size_t first = rgb.size();
      rgb.resize(first + 3 * n * n);
      for (std::size_t row = 0; row < n; ++row) {
        std::vector<double> u_x;
        for (std::size_t column = 0; column < n; ++column) u_x.push_back(point(row, column).x);
        const std::vector<glm::dvec2> warped = warp.row(point(row, 0).y, u_x);
        for (std::size_t column = 0; column < n; ++column) {
          const glm::dvec2 at = warped[column];
          const glm::dvec3 m = normal_at(at, isotropic ? azimuth : 0.0);
          const glm::dvec3 i = 2.0 * glm::dot(o, m) * m - o;
          glm::dvec3 value(0.0);
          if (i.z > 0.0 && glm::dot(o, m) > 0.0) {
            value = recipe.reflectance(i, o) * i.z * 4.0 * area / value_at(ndf, at);
          }
          for (std::size_t channel = 0; channel < 3; ++channel) {
            rgb[first + channel * n * n + row * n + column] =
                static_cast<float>(value[static_cast<int>(channel)]);
          }
        }
      }
    }
  }
  const std::vector<float> azimuths(recipe.azimuths.begin(), recipe.azimuths.end());
  const std::vector<float> elevations(recipe.elevations.begin(), recipe.elevations.end());
  TensorWriter writer;
  writer.add_bytes("description", "synthesised");
  writer.add("theta_i", {elevations.size()}, elevations);
  writer.add("phi_i", {azimuths.size()}, azimuths);
  writer.add("sigma", {n, n}, sigma);
  writer.add("ndf", {n, n}, ndf);
  writer.add("vndf", {azimuths.size(), elevations.size(), n, n}, vndf);
  writer.add("rgb", {azimuths.size(), elevations.size(), 3, n, n}, rgb);
  writer.add_bytes("jacobian", std::string(1, '\1'));
  return writer.file();
}

namespace {

std::vector<float> ramp(std::size_t count) {
  std::vector<float> values;
  for (std::size_t n = 0; n < count; ++n) {
    values.push_back(0.125F * static_cast<float>((n * 7 + 3) % 16));
  }
  return values;
}

// Squares of 3 × 4 values and less: mutations meet the structure as often as the numbers.
std::vector<char> small_rgl_file(std::vector<float> azimuths) {
  const std::uint64_t p = azimuths.size();
  TensorWriter writer;
  writer.add_bytes("description", "fuzz");
  writer.add("theta_i", {2}, {0.0F, 1.5F});
  writer.add("phi_i", {p}, std::move(azimuths));
  writer.add("sigma", {3, 4}, ramp(12));
  writer.add("ndf", {4, 3}, ramp(12));
  writer.add("vndf", {p, 2, 3, 3}, ramp(p * 18));
  writer.add("rgb", {p, 2, 3, 2, 2}, ramp(p * 24));
  writer.add_bytes("jacobian", std::string(1, '\1'));
  return writer.file();
}

}  // namespace

std::vector<std::vector<char>> small_rgl_files() {
  const auto pi = static_cast<float>(kPi);
  return {small_rgl_file({0.0F}), small_rgl_file({-pi, -0.5F * pi, 0.0F, 0.5F * pi, pi}),
          small_rgl_file({-pi, -0.75F * pi, -0.5F * pi})};
}

}  // namespace lobelight::testing
