#pragma once

#include <glm/glm.hpp>

#include "table/lobe_table.h"

// The formulas of addons/lobelight/runtime/shaders in single precision, word for word: what a
// shader makes of a table, without a shader.

namespace lobelight::stability {

// lobe_table.gdshaderinc
struct ShaderLobe {
  glm::vec3 mean;
  float variance;
  float cosine;
  float weight;
};
glm::vec3 shader_clamp_view(const glm::vec3& o);
ShaderLobe shader_decode_lobe(const glm::vec4& texel, const glm::vec2& slope_scale,
                              const glm::vec3& o);

// Column and row of the view `o` in the table's grid, lobelight_table_position() in texels.
glm::vec2 shader_table_position(const LobeTable& table, const glm::vec3& o);

// The lobe of any unit vector `view` in tangent space, specular.gdshaderinc's way: clamp, fold,
// bilinear look-up (`texel` reads the table's texels), decode; the mean in tangent space.
template <typename Texel>
ShaderLobe shader_lobe_at(const LobeTable& table, const glm::vec3& view, int lobe, Texel texel);

// environment.gdshaderinc: the pyramid's level for a variance about the unit direction d; `level`
// is (S²/4, c, 1 where levels blur alike in all directions, otherwise 0).
float shader_level(float variance, const glm::vec3& d, const glm::vec3& level);

template <typename Texel>
ShaderLobe shader_lobe_at(const LobeTable& table, const glm::vec3& view, int lobe, Texel texel) {
  glm::vec3 x_axis(view.x < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f);
  glm::vec3 y_axis(0.0f, view.y < 0.0f ? -1.0f : 1.0f, 0.0f);
  glm::vec3 o = glm::vec3(view.x * x_axis.x, view.y * y_axis.y, view.z);
  if (table.is_isotropic()) {
    const glm::vec2 across(view.x, view.y);
    const float sine = glm::length(across);
    x_axis = sine > 1e-5f ? glm::vec3(across / sine, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
    y_axis = glm::vec3(-x_axis.y, x_axis.x, 0.0f);
    o = glm::vec3(sine, 0.0f, view.z);
  }
  o = shader_clamp_view(o);
  const glm::vec2 at =
      glm::clamp(shader_table_position(table, o), glm::vec2(0.0f), glm::vec2(table.views() - 1));
  const glm::ivec2 low = glm::min(glm::ivec2(at), table.views() - 1);
  const glm::ivec2 high = glm::min(low + 1, table.views() - 1);
  const glm::vec2 way = at - glm::vec2(low);
  const glm::vec4 first = glm::mix(texel(lobe, low.x, low.y), texel(lobe, high.x, low.y), way.x);
  const glm::vec4 second = glm::mix(texel(lobe, low.x, high.y), texel(lobe, high.x, high.y), way.x);
  ShaderLobe found =
      shader_decode_lobe(glm::mix(first, second, way.y), glm::vec2(table.alpha()), o);
  found.mean = found.mean.x * x_axis + found.mean.y * y_axis + glm::vec3(0.0f, 0.0f, found.mean.z);
  return found;
}

}  // namespace lobelight::stability
