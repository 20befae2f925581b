#include "brdf/rgl.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/pi.h"
#include "brdf/gridded.h"
#include "brdf/tensor_file.h"

namespace lobelight {

namespace {

// Above this a slice's nodes are taken for those of an anisotropic material.
constexpr std::size_t kIsotropicAzimuths = 2;

double elevation(const glm::dvec3& v) { return std::atan2(std::hypot(v.x, v.y), v.z); }

double azimuth(const glm::dvec3& v) { return std::atan2(v.y, v.x); }

// The place of a direction in the stored squares.
glm::dvec2 to_square(double theta, double phi) {
  const double turns = (phi + kPi) / (2.0 * kPi);
  return {std::sqrt(theta * (2.0 / kPi)), turns - std::floor(turns)};
}

class Rgl final : public MeasuredData {
 public:
  struct Tables {
    ParameterGrid views;  // azimuth, elevation
    GriddedFunction ndf;
    GriddedFunction sigma;
    GriddedDistribution visible_normals;
    GriddedFunction rgb;  // slice · 3 + channel
    bool has_jacobian;
    int repetitions;  // of the nodes' azimuths around the circle: 1, 2 or 4
    std::size_t clamped;
  };

  explicit Rgl(Tables tables) : tables_(std::move(tables)) {}

  glm::dvec3 reflected(const glm::dvec3& i, const glm::dvec3& o) const override;
  bool is_isotropic() const override { return tables_.views.first().size() <= kIsotropicAzimuths; }
  std::size_t clamped() const override { return tables_.clamped; }

 private:
  Tables tables_;
};

glm::dvec3 Rgl::reflected(const glm::dvec3& i_given, const glm::dvec3& o_given) const {
  glm::dvec3 i = i_given;
  glm::dvec3 o = o_given;
  if (tables_.repetitions >= 2) {
    // Half a circle of nodes is that with y < 0, a quarter that with x, y < 0.
    // Zeros become negative too, so that azimuths on the x axis come out as −π or −0.
    const auto negative = [](double value) { return std::signbit(value) ? 1.0 : -1.0; };
    const double y_sign = negative(o.y);
    const double x_sign = tables_.repetitions == 4 ? negative(o.x) : y_sign;
    const glm::dvec3 signs(x_sign, y_sign, 1.0);
    i *= signs;
    o *= signs;
  }
  const glm::dvec3 m = glm::normalize(i + o);
  const double phi_o = azimuth(o);
  const double phi_m = is_isotropic() ? azimuth(m) - phi_o : azimuth(m);
  const glm::dvec2 at_o = to_square(elevation(o), phi_o);
  const glm::dvec2 at_m = to_square(elevation(m), phi_m);

  const Blend blend = tables_.views.locate(phi_o, elevation(o));
  const glm::dvec2 u = tables_.visible_normals.invert(at_m, blend);
  glm::dvec3 value(0.0);
  for (std::size_t n = 0; n < blend.slice.size(); ++n) {
    if (blend.share[n] == 0.0) continue;
    for (int channel = 0; channel < 3; ++channel) {
      const std::size_t slice = 3 * blend.slice[n] + static_cast<std::size_t>(channel);
      value[channel] += blend.share[n] * tables_.rgb.value(u, slice);
    }
  }
  if (tables_.has_jacobian) {
    const double area = 4.0 * tables_.sigma.value(at_o);
    // A direction in which the surface shows no area reflects nothing.
    value *= area > 0.0 ? tables_.ndf.value(at_m) / area : 0.0;
  }
  return value;
}

// A field's numbers, those below 0 or not finite replaced by 0 and counted.
std::vector<float> clean(std::vector<float> values, std::size_t& clamped) {
  for (float& value : values) {
    if (value >= 0.0F && value <= std::numeric_limits<float>::max()) continue;
    value = 0.0F;
    ++clamped;
  }
  return values;
}

// The nodes of an angle; NaN and disorder are refused.
std::vector<double> read_nodes(TensorFile& file, const std::string& name) {
  const std::vector<float> stored = file.floats(name, 1);
  for (std::size_t n = 0; n < stored.size(); ++n) {
    if (!std::isfinite(stored[n]) || (n > 0 && !(stored[n - 1] < stored[n]))) {
      file.fail("its angles \"" + name + "\" do not ascend");
    }
  }
  return {stored.begin(), stored.end()};
}

// Columns and rows of a field's slices, after checking its leading dimensions.
GridSize slice_size(const TensorFile& file, const std::string& name,
                    const std::vector<std::uint64_t>& leading) {
  const std::size_t dimensions = leading.size() + 2;
  const TensorFile::Field& field = file.field(name, TensorFile::Type::float32, dimensions);
  if (!std::equal(leading.begin(), leading.end(), field.shape.begin())) {
    file.fail("its field \"" + name + "\" does not have one slice for each direction");
  }
  const GridSize size{static_cast<std::size_t>(field.shape[dimensions - 1]),
                      static_cast<std::size_t>(field.shape[dimensions - 2])};
  if (size.columns < 2 || size.rows < 2) {
    file.fail("its field \"" + name + "\" has fewer than 2 x 2 values in a slice");
  }
  return size;
}

}  // namespace

std::unique_ptr<MeasuredData> read_rgl(const std::string& path) {
  TensorFile file(path);
  if (!file.has("rgb") && file.has("spectra")) {
    file.fail("holds spectra; Lobelight reads the material's RGB file (NAME_rgb.bsdf)");
  }
  const std::vector<double> theta = read_nodes(file, "theta_i");
  const std::vector<double> phi = read_nodes(file, "phi_i");
  const std::vector<std::uint64_t> one_each{phi.size(), theta.size()};
  const GridSize ndf_size = slice_size(file, "ndf", {});
  const GridSize sigma_size = slice_size(file, "sigma", {});
  const GridSize vndf_size = slice_size(file, "vndf", one_each);
  const GridSize rgb_size = slice_size(file, "rgb", {phi.size(), theta.size(), 3});

  int repetitions = 1;
  if (phi.size() > kIsotropicAzimuths) {
    const double turns = 2.0 * kPi / (phi.back() - phi.front());
    repetitions = static_cast<int>(std::lround(std::min(turns, 100.0)));
    if (repetitions != 1 && repetitions != 2 && repetitions != 4) {
      file.fail("its angles \"phi_i\" cover neither the circle nor its half nor its quarter");
    }
  }

  std::size_t clamped = 0;
  std::vector<float> ndf = clean(file.floats("ndf", 2), clamped);
  std::vector<float> sigma = clean(file.floats("sigma", 2), clamped);
  const std::vector<float> vndf = clean(file.floats("vndf", 4), clamped);
  std::vector<float> rgb = clean(file.floats("rgb", 5), clamped);
  const bool has_jacobian = file.bytes("jacobian", 1).front() != 0;
  const auto is_dark = [](float value) { return !(value > 0.0F); };
  if (std::all_of(rgb.begin(), rgb.end(), is_dark)) file.fail("holds no positive number");

  return std::make_unique<Rgl>(Rgl::Tables{
      ParameterGrid(phi, theta), GriddedFunction(ndf_size, std::move(ndf)),
      GriddedFunction(sigma_size, std::move(sigma)), GriddedDistribution(vndf_size, vndf),
      GriddedFunction(rgb_size, std::move(rgb)), has_jacobian, repetitions, clamped});
}

}  // namespace lobelight
