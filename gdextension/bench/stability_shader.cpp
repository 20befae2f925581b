// Single precision: the shader's formulas over the whole range of their input.

#include "stability_shader.h"

#include <algorithm>
#include <cmath>

#include "stability.h"
#include "stability_materials.h"

namespace lobelight::stability {

namespace {

constexpr float kLeastCosine = 0.010471784f;
constexpr float kHalfPi = 1.57079632679489661923f;

// Every texel that a table can hold, decoded for one material and view. Nine numbers: the texel,
// the mean, variance and cosine.
void decode_texels(Record& record, const glm::dvec2& alpha, double elevation, double azimuth) {
  const glm::dvec3 o = view_at(elevation, azimuth);
  const glm::vec3 view = shader_clamp_view(glm::vec3(o));
  std::vector<double> values;
  for (const double x : {-4.0, -1.0, -0.25, 0.0, 0.5, 2.0, 4.0}) {
    for (const double y : {-4.0, -0.5, 0.0, 1.0, 4.0}) {
      for (const double log2_kappa :
           {LobeTable::kMinLog2Kappa, 0.0, 8.0, 16.0, LobeTable::kMaxLog2Kappa}) {
        const glm::vec4 texel(x, y, log2_kappa, 0.125);
        const ShaderLobe lobe = shader_decode_lobe(texel, glm::vec2(alpha), view);
        values.insert(values.end(), {x, y, log2_kappa, lobe.mean.x, lobe.mean.y, lobe.mean.z,
                                     lobe.variance, lobe.cosine, lobe.weight});
      }
    }
  }
  record.set("function", "decode")
      .set("alpha", alpha)
      .set("elevation", elevation)
      .set("azimuth", azimuth)
      .set("o", o)
      .set("values", values);
}

// c of the levels' formula: a third of each kernel's variance.
struct Filter {
  const char* name;
  double c;
  double alike;
};
constexpr Filter kFilters[] = {
    {"box", 1.0 / 12.0, 0.0}, {"binomial", 0.25, 0.0}, {"gaussian", 5.0 / 6.0, 1.0}};

// Five numbers: the variance, the direction, the level.
void levels(Record& record, const Filter& filter, int size) {
  const glm::dvec3 level(0.25 * size * size, filter.c, filter.alike);
  std::vector<double> values;
  for (int power = -40; power <= 40; ++power) {
    const double variance = std::pow(10.0, 0.25 * power);
    for (const glm::dvec3& d :
         {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.6, 0.0, -0.8), glm::normalize(glm::dvec3(1.0))}) {
      const float found =
          shader_level(static_cast<float>(variance), glm::vec3(d), glm::vec3(level));
      values.insert(values.end(), {variance, d.x, d.y, d.z, found});
    }
  }
  record.set("function", "level").set("level", level).set("values", values);
}

// Five numbers: the view, column and row.
void positions(Record& record, const glm::ivec2& grid) {
  const LobeTable table({0.1, 0.2}, 1, grid);
  std::vector<double> values;
  for (const double elevation :
       {0.0, 1e-6, 1e-3, 0.5, 5.0, 30.0, 60.0, 85.0, 89.0, 89.39, 89.4, 89.99, 90.0, 120.0}) {
    for (const double azimuth : {0.0, 1e-6, 0.1, 30.0, 45.0, 89.9, 90.0, 170.0, 200.0, 359.0}) {
      const glm::dvec3 o = view_at(elevation, azimuth);
      const glm::vec2 at = shader_table_position(table, shader_clamp_view(glm::vec3(o)));
      values.insert(values.end(), {o.x, o.y, o.z, at.x, at.y});
    }
  }
  record.set("function", "position")
      .set("views", std::vector<double>{static_cast<double>(grid.x), static_cast<double>(grid.y)})
      .set("values", values);
}

}  // namespace

glm::vec3 shader_clamp_view(const glm::vec3& o) {
  return glm::normalize(glm::vec3(o.x, o.y, std::max(o.z, kLeastCosine)));
}

ShaderLobe shader_decode_lobe(const glm::vec4& texel, const glm::vec2& slope_scale,
                              const glm::vec3& o) {
  const glm::vec3 h =
      glm::normalize(glm::vec3(texel.x * slope_scale.x, texel.y * slope_scale.y, 1.0f));
  const float cosine = std::max(glm::dot(o, h), 1e-4f);
  return {2.0f * cosine * h - o, cosine * std::exp2(-texel.z), cosine, texel.w};
}

glm::vec2 shader_table_position(const LobeTable& table, const glm::vec3& o) {
  // LobeTable.get_lookup() of the run time gives scale and offset; half a texel of them is the
  // texel's centre, which is taken off again here.
  const glm::vec2 last(table.views() - 1);
  const float elevation = std::atan2(glm::length(glm::vec2(o)), o.z);
  const float rest =
      std::max(1.0f - elevation * (1.0f / static_cast<float>(LobeTable::kMaxElevation)), 0.0f);
  const float column = (1.0f - std::sqrt(rest)) * last.x;
  if (table.is_isotropic()) return {column, 0.0f};
  const float azimuth = std::atan2(std::abs(o.y), std::max(std::abs(o.x), 1e-6f));
  return {column, azimuth * (last.y / kHalfPi)};
}

float shader_level(float variance, const glm::vec3& d, const glm::vec3& level) {
  const glm::vec3 components = glm::abs(d);
  const float m = std::max(components.x, std::max(components.y, components.z));
  const float texel = m * m * m;
  const float step = level.y * std::max(texel, level.z);
  const float four_to_the_level = (level.x * variance + step) / (step + texel / 6.0f);
  const float smooth_level = 0.5f * std::log2(std::max(four_to_the_level, 1.0f));
  const float whole = std::floor(smooth_level);
  return whole + (std::exp2(2.0f * (smooth_level - whole)) - 1.0f) / 3.0f;
}

std::vector<Case> shader_cases(bool quick) {
  std::vector<Case> cases;
  std::vector<double> widths{1e-4, 0.01, 0.2, 2.0};
  std::vector<double> elevations{0.0, 60.0, 89.4, 89.99};
  if (!quick) {
    widths = {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 2.0};
    elevations = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 88.0, 89.0, 89.4, 89.99};
  }
  for (const double width : widths) {
    for (const double ratio : {1.0, 1000.0}) {
      const glm::dvec2 alpha(width, std::max(width / ratio, 1e-4));
      if (ratio > 1.0 && width < 0.1) continue;
      for (const double elevation : elevations) {
        const double azimuth = ratio > 1.0 ? 30.0 : 0.0;
        cases.push_back({"shader decode " + short_number(alpha.x) + ',' + short_number(alpha.y) +
                             " view " + short_number(elevation) + ',' + short_number(azimuth),
                         [=](Record& r) { decode_texels(r, alpha, elevation, azimuth); }});
      }
    }
  }
  for (const Filter& filter : kFilters) {
    for (const int size : {16, 128, 512}) {
      cases.push_back({std::string("shader level ") + filter.name + " size " + std::to_string(size),
                       [=](Record& r) { levels(r, filter, size); }});
    }
  }
  for (const glm::ivec2& grid :
       {glm::ivec2(2, 1), glm::ivec2(16, 1), glm::ivec2(16, 8), glm::ivec2(256, 256)}) {
    cases.push_back({"shader position " + std::to_string(grid.x) + "x" + std::to_string(grid.y),
                     [=](Record& r) { positions(r, grid); }});
  }
  return cases;
}

}  // namespace lobelight::stability
