#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace lobelight::testing {

// A file in the system's folder for such, removed at the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& ending);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  const std::string& path() const { return path_; }
  void write(const std::vector<char>& bytes) const;

 private:
  std::string path_;
};

// A reflectance ρ(i, o) in 1/sr to be written into a file, three channels.
using Reflectance = std::function<glm::dvec3(const glm::dvec3& i, const glm::dvec3& o)>;

// The unit vector of an elevation from the normal and an azimuth, in radians.
glm::dvec3 from_angles(double elevation, double azimuth);

// A MERL file of an isotropic reflectance: every bin holds the value at its middle (in √θ_h), −1
// where one of the directions is not above the horizon.
std::vector<char> merl_file(const Reflectance& reflectance);

constexpr std::size_t kMerlHeader = 12;
constexpr std::size_t kMerlBins = std::size_t{90} * 90 * 180;

// A tensor file, field by field.
class TensorWriter {
 public:
  void add(const std::string& name, std::vector<std::uint64_t> shape, std::vector<float> values);
  void add_bytes(const std::string& name, const std::string& text);
  std::vector<char> file() const;

 private:
  struct Field {
    std::string name;
    std::uint8_t type;
    std::vector<std::uint64_t> shape;
    std::vector<char> data;
  };
  std::vector<Field> fields_;
};

// An RGL file of a reflectance, prepared as the paper does for a surface of GGX normals. Squares
// have `resolution`² values.
struct RglRecipe {
  Reflectance reflectance;
  glm::dvec2 alpha;                   // of the normals
  std::vector<double> azimuths{0.0};  // of o, radians; one: isotropic
  std::vector<double> elevations;
  std::size_t resolution = 32;
};
std::vector<char> rgl_file(const RglRecipe& recipe);

// The smallest whole RGL files, of 1 to 4 kB: an isotropic one, and two whose azimuths go all
// round and over a quadrant. They stand for no surface.
std::vector<std::vector<char>> small_rgl_files();

}  // namespace lobelight::testing
