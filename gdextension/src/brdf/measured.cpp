#include "brdf/measured.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/pi.h"
#include "brdf/merl.h"
#include "brdf/rgl.h"
#include "brdf/tensor_file.h"

namespace lobelight {

namespace {

// Views with tables of samples; between them, tables are blended. Half-vectors: √θ and the azimuth,
// finer for anisotropic materials, whose ridges are narrow in azimuth. The number of azimuths is a
// multiple of four plus one, so that both mirrors take nodes to nodes.
constexpr int kElevations = 12;
constexpr int kAzimuths = 5;
constexpr double kLastElevation = 89.4 * kPi / 180.0;
constexpr std::size_t kHalfVectorColumns = 65;
constexpr std::size_t kHalfVectorRows = 65;
constexpr std::size_t kAnisotropicRows = 129;

// Share of the mean density that is added everywhere: what the tables miss is drawn at times.
constexpr double kFloor = 0.02;

constexpr double kColourThreshold = 1e-3;

// Slices whose greatest density is beyond 2^±kMostExponent are scaled.
constexpr int kMostExponent = 64;

bool ends_with(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

double mean(const glm::dvec3& rgb) { return (rgb.x + rgb.y + rgb.z) / 3.0; }

double elevation(const glm::dvec3& v) { return std::atan2(std::hypot(v.x, v.y), v.z); }

// The half-vector at a point of the unit square: θ = x² · 90°, φ = 360° y.
glm::dvec3 half_vector(const glm::dvec2& point) {
  const double theta = 0.5 * kPi * point.x * point.x;
  const double phi = 2.0 * kPi * point.y;
  const double sine = std::sin(theta);
  return {sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)};
}

// Solid angle of the half-vector by area of the square, dω_h = sin θ dθ dφ = 2π² x sin θ dx dy.
double solid_angle(double x) { return 2.0 * kPi * kPi * x * std::sin(0.5 * kPi * x * x); }

// The reflectance times cosine of all mirror images: the first `count` of them are different.
struct MirrorImages {
  std::array<glm::dvec3, 4> value;
  int count;

  glm::dvec3 average() const {
    glm::dvec3 sum(0.0);
    for (int n = 0; n < count; ++n) sum += value[static_cast<std::size_t>(n)];
    return sum / static_cast<double>(count);
  }
};

MirrorImages mirror_images(const MeasuredData& data, const glm::dvec3& i, const glm::dvec3& o) {
  constexpr double kSigns[4][2] = {{1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}, {-1.0, -1.0}};
  // Isotropic data do not tell a reflection in x from one in y.
  MirrorImages images{{}, data.is_isotropic() ? 2 : 4};
  for (int n = 0; n < images.count; ++n) {
    const glm::dvec3 signs(kSigns[n][0], kSigns[n][1], 1.0);
    images.value[static_cast<std::size_t>(n)] = data.reflected(signs * i, signs * o);
  }
  return images;
}

ParameterGrid sample_views(bool isotropic) {
  std::vector<double> azimuths{0.0};
  for (int p = 1; !isotropic && p < kAzimuths; ++p) {
    azimuths.push_back(0.5 * kPi * p / (kAzimuths - 1));
  }
  std::vector<double> elevations;
  for (int t = 0; t < kElevations; ++t) {
    elevations.push_back(kLastElevation * t / (kElevations - 1));
  }
  return {azimuths, elevations};
}

}  // namespace

bool is_measured_file(std::string_view name) {
  return ends_with(name, ".binary") || ends_with(name, ".bsdf") ||
         name.find_first_of("/\\") != std::string_view::npos;
}

std::unique_ptr<MeasuredData> read_measured(const std::string& path) {
  const bool is_rgl = ends_with(path, ".bsdf") || TensorFile::recognises(path);
  return is_rgl ? read_rgl(path) : read_merl(path);
}

glm::dvec2 estimate_widths(const MeasuredData& data, const Progress* progress) {
  // p(s) on rings whose radii grow in equal ratios, so that narrow lobes are met with as many nodes
  // as wide ones. Slopes stay below 1: there the light is at the horizon.
  constexpr int kRings = 400;
  constexpr int kSpokes = 64;
  constexpr double kLeastSlope = 1e-5;
  constexpr double kRadius = 1.5;
  struct Node {
    double x2, y2, mass;  // squared slopes, p(s) times the area element up to a factor
  };
  std::vector<Node> nodes;
  std::vector<double> ring_mean(kRings, 0.0);
  const auto ring_slope = [](int ring) {
    return kLeastSlope * std::pow(1.0 / kLeastSlope, (ring + 0.5) / kRings);
  };
  const glm::dvec3 up(0.0, 0.0, 1.0);
  for (int ring = 0; ring < kRings; ++ring) {
    throw_if_cancelled(progress);
    const double s = ring_slope(ring);
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      // One quadrant stands for its mirror images.
      const double phi = 0.5 * kPi * (spoke + 0.5) / kSpokes;
      const double x = s * std::cos(phi);
      const double y = s * std::sin(phi);
      const glm::dvec3 h = glm::normalize(glm::dvec3(x, y, 1.0));
      const glm::dvec3 i = 2.0 * h.z * h - up;
      const double density = mean(mirror_images(data, i, up).average()) * std::pow(h.z, 4.0);
      nodes.push_back({x * x, y * y, density * s * s});
      ring_mean[static_cast<std::size_t>(ring)] += density / kSpokes;
    }
  }

  const auto peak = std::max_element(ring_mean.begin(), ring_mean.end());
  const auto half =
      std::find_if(peak, ring_mean.end(), [&](double value) { return value < 0.5 * *peak; });
  const auto limit = [](double alpha) { return std::clamp(alpha, kMinAlpha, 1.0); };
  // e^{−s²/α²} = ½ at s = α √ln 2.
  glm::dvec2 alpha(limit(ring_slope(static_cast<int>(half - ring_mean.begin())) / 0.8325546));

  const double tail = std::exp(-kRadius * kRadius);
  const double expected = 0.5 * (1.0 - kRadius * kRadius * tail / (1.0 - tail));
  for (int step = 0; step < 200; ++step) {
    double mass = 0.0;
    glm::dvec2 square(0.0);
    for (const Node& node : nodes) {
      const glm::dvec2 whitened(node.x2 / (alpha.x * alpha.x), node.y2 / (alpha.y * alpha.y));
      if (whitened.x + whitened.y > kRadius * kRadius) continue;
      mass += node.mass;
      square += node.mass * whitened;
    }
    if (!(mass > 0.0)) break;
    if (data.is_isotropic()) square = glm::dvec2(0.5 * (square.x + square.y));
    const glm::dvec2 before = alpha;
    alpha.x = limit(alpha.x * std::sqrt(square.x / mass / expected));
    alpha.y = limit(alpha.y * std::sqrt(square.y / mass / expected));
    if (glm::length((alpha - before) / before) < 1e-6) break;
  }
  return alpha;
}

// Where a view lies among the tabulated ones.
struct MeasuredBrdf::Place {
  Blend blend;
  glm::dvec2 signs{1.0, 1.0};   // mirrors into the first quadrant, anisotropic data
  glm::dvec2 x_axis{1.0, 0.0};  // the tables' x axis, isotropic data
  double first =
      0.0;  // share of samples whose azimuth lies below the view's: u.y counts from there

  glm::dvec3 to_table(const glm::dvec3& v) const {
    return {signs.x * (x_axis.x * v.x + x_axis.y * v.y),
            signs.y * (x_axis.x * v.y - x_axis.y * v.x), v.z};
  }
  glm::dvec3 from_table(const glm::dvec3& v) const {
    const glm::dvec2 w = signs * glm::dvec2(v);
    return {x_axis.x * w.x - x_axis.y * w.y, x_axis.y * w.x + x_axis.x * w.y, v.z};
  }
};

MeasuredBrdf::Place MeasuredBrdf::place_view(const glm::dvec3& o) const {
  Place place;
  if (is_isotropic()) {
    const double sine = std::hypot(o.x, o.y);
    if (sine > 0.0) place.x_axis = glm::dvec2(o) / sine;
    place.blend = views_.locate(0.0, elevation(o));
    return place;
  }
  place.signs = {o.x < 0.0 ? -1.0 : 1.0, o.y < 0.0 ? -1.0 : 1.0};
  const double azimuth = std::atan2(std::abs(o.y), std::abs(o.x));
  place.blend = views_.locate(azimuth, elevation(o));
  // u.y counts azimuths from the view's: u.y → 1 − u.y then mirrors the samples wherever the view
  // lies in a plane of symmetry, as the quadrature of slices wants it.
  place.first = half_vectors_->marginal_cdf(azimuth / (2.0 * kPi), place.blend);
  return place;
}

MeasuredBrdf::MeasuredBrdf(std::unique_ptr<MeasuredData> data, std::string name,
                           const glm::dvec2& alpha, const Progress* progress)
    : Brdf(alpha == glm::dvec2(0.0) ? estimate_widths(*data, progress) : alpha),
      data_(std::move(data)),
      name_(std::move(name)),
      views_(sample_views(data_->is_isotropic())) {
  tabulate_samples(progress);
}

void MeasuredBrdf::tabulate_samples(const Progress* progress) {
  const GridSize size{kHalfVectorColumns, is_isotropic() ? kHalfVectorRows : kAnisotropicRows};
  std::vector<float> values(views_.slices() * size.values());
  struct Sums {
    double light = 0.0, asymmetry = 0.0, colour = 0.0;
  };
  std::vector<Sums> sums(views_.slices());
  const std::size_t elevations = views_.second().size();
  parallel_for(views_.slices(), 0, [&](std::size_t slice) {
    const double azimuth = views_.first()[slice / elevations];
    const double theta = views_.second()[slice % elevations];
    const glm::dvec3 o(std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
                       std::cos(theta));
    // Only the shape of a slice counts; its numbers may be beyond what a float holds.
    std::vector<double> densities(size.values(), 0.0);
    Sums& sum = sums[slice];
    for (std::size_t row = 0; row < size.rows; ++row) {
      throw_if_cancelled(progress);
      for (std::size_t column = 0; column < size.columns; ++column) {
        const glm::dvec2 point(static_cast<double>(column) / static_cast<double>(size.columns - 1),
                               static_cast<double>(row) / static_cast<double>(size.rows - 1));
        const glm::dvec3 h = half_vector(point);
        const double o_dot_h = glm::dot(o, h);
        const glm::dvec3 i = 2.0 * o_dot_h * h - o;
        if (!(o_dot_h > 0.0) || !(i.z > 0.0)) continue;
        const double area = 4.0 * o_dot_h * solid_angle(point.x);
        const MirrorImages images = mirror_images(*data_, i, o);
        const glm::dvec3 rgb = images.average();
        const double value = mean(rgb);
        densities[row * size.columns + column] = value * area;
        sum.light += value * area;
        for (int n = 0; n < images.count; ++n) {
          const double own = mean(images.value[static_cast<std::size_t>(n)]);
          sum.asymmetry += std::abs(own - value) * area / images.count;
        }
        for (int channel = 0; channel < 3; ++channel) {
          sum.colour += std::abs(rgb[channel] - value) * area / 3.0;
        }
      }
    }
    int exponent = 0;
    std::frexp(*std::max_element(densities.begin(), densities.end()), &exponent);
    const int scale = std::abs(exponent) > kMostExponent ? -exponent : 0;
    float* const table = &values[slice * size.values()];
    std::transform(densities.begin(), densities.end(), table, [scale](double density) {
      return static_cast<float>(std::ldexp(density, scale));
    });
    // Views in a plane of symmetry get tables that are symmetric to the last bit. The rows are
    // periodic: the last one is the first.
    const std::size_t turn = size.rows - 1;
    const auto symmetrise = [&](std::size_t around) {
      for (std::size_t row = 0; row <= turn; ++row) {
        const std::size_t image = (2 * around + turn - row) % turn;
        for (std::size_t c = 0; c < size.columns && row < image; ++c) {
          float& a = table[row * size.columns + c];
          float& b = table[image * size.columns + c];
          a = b = 0.5F * (a + b);
        }
      }
      for (std::size_t c = 0; c < size.columns; ++c) table[turn * size.columns + c] = table[c];
    };
    const bool at_pole = slice % elevations == 0;
    if (slice / elevations == 0 || at_pole) symmetrise(0);
    if (!is_isotropic() && (slice / elevations + 1 == views_.first().size() || at_pole)) {
      symmetrise(turn / 4);
    }
    double total = 0.0;
    for (std::size_t n = 0; n < size.values(); ++n) total += static_cast<double>(table[n]);
    const auto floor = static_cast<float>(kFloor * total / static_cast<double>(size.values()));
    for (std::size_t n = 0; n < size.values(); ++n) table[n] += floor;
  });
  half_vectors_ = std::make_unique<GriddedDistribution>(size, values);

  Sums all;
  for (const Sums& sum : sums) {
    all.light += sum.light;
    all.asymmetry += sum.asymmetry;
    all.colour += sum.colour;
  }
  if (!(all.light > 0.0)) return;
  asymmetry_ = all.asymmetry / all.light;
  is_coloured_ = all.colour > kColourThreshold * all.light;
}

glm::dvec3 MeasuredBrdf::evaluate_rgb(const glm::dvec3& i, const glm::dvec3& o) const {
  if (!(i.z > 0.0) || !(o.z > 0.0)) return glm::dvec3(0.0);
  return mirror_images(*data_, i, o).average() / i.z;
}

double MeasuredBrdf::evaluate(const glm::dvec3& i, const glm::dvec3& o) const {
  return mean(evaluate_rgb(i, o));
}

double MeasuredBrdf::pdf_of_half_vector(const glm::dvec2& point, double o_dot_h,
                                        const Place& place) const {
  // p(x, y) / (dω_h/dx dy), times dω_h/dω_i = 1/(4 o·h). Close to the normal both the density and
  // the solid angle vanish.
  const double area = std::max(4.0 * o_dot_h * solid_angle(point.x), 1e-300);
  return half_vectors_->density(point, place.blend) / area;
}

std::optional<BrdfSample> MeasuredBrdf::sample(const glm::dvec3& o, const glm::dvec2& u) const {
  if (!(o.z > 0.0)) return std::nullopt;
  const Place place = place_view(o);
  const double turned = u.y + place.first;
  const glm::dvec2 point = half_vectors_->sample({u.x, turned - std::floor(turned)}, place.blend);
  const glm::dvec3 h = place.from_table(half_vector(point));
  const double o_dot_h = glm::dot(o, h);
  const glm::dvec3 i = glm::normalize(2.0 * o_dot_h * h - o);
  if (!(o_dot_h > 0.0) || !(i.z > 0.0)) return std::nullopt;
  const double pdf = pdf_of_half_vector(point, o_dot_h, place);
  return BrdfSample{i, mean(mirror_images(*data_, i, o).average()) / pdf, pdf};
}

double MeasuredBrdf::pdf(const glm::dvec3& i, const glm::dvec3& o) const {
  if (!(i.z > 0.0) || !(o.z > 0.0)) return 0.0;
  const Place place = place_view(o);
  const glm::dvec3 h = glm::normalize(i + o);
  const glm::dvec3 local = place.to_table(h);
  const double turns = std::atan2(local.y, local.x) / (2.0 * kPi);
  const glm::dvec2 point(std::sqrt(elevation(local) / (0.5 * kPi)), turns - std::floor(turns));
  return pdf_of_half_vector(point, glm::dot(o, h), place);
}

}  // namespace lobelight
