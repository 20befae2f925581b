#include "godot/convert.h"

#include <cstdint>
#include <cstring>
#include <godot_cpp/classes/project_settings.hpp>
#include <stdexcept>

#include "base/as_written.h"
#include "godot/pack.h"

namespace lobelight {

std::string to_std(const godot::String& text) {
  const godot::CharString bytes = text.utf8();
  return std::string(bytes.get_data(), static_cast<std::size_t>(bytes.length()));
}

godot::String to_godot(std::string_view text) {
  return godot::String::utf8(text.data(), static_cast<int>(text.size()));
}

godot::Vector2 to_godot(const glm::dvec2& value) {
  return {static_cast<godot::real_t>(value.x), static_cast<godot::real_t>(value.y)};
}

godot::Vector2i to_godot(const glm::ivec2& value) { return {value.x, value.y}; }

godot::PackedInt32Array to_godot(const std::vector<int>& values) {
  return pack<godot::PackedInt32Array>(values);
}

godot::PackedFloat32Array to_godot(const std::vector<float>& values) {
  return pack<godot::PackedFloat32Array>(values);
}

godot::PackedFloat32Array to_godot(const std::vector<double>& values) {
  return pack<godot::PackedFloat32Array>(values);
}

godot::PackedByteArray to_bytes(const std::vector<std::uint16_t>& halves) {
  const std::size_t size = halves.size() * sizeof(halves[0]);
  godot::PackedByteArray bytes = sized<godot::PackedByteArray>(size);
  if (size > 0) std::memcpy(bytes.ptrw(), halves.data(), size);
  return bytes;
}

glm::dvec2 to_widths(const godot::Vector2& value) {
  return {as_written(static_cast<float>(value.x)), as_written(static_cast<float>(value.y))};
}

glm::dvec3 to_core(const godot::Vector3& value) { return {value.x, value.y, value.z}; }

std::string file_system_path(const godot::String& path) {
  if (to_std(path).empty()) throw std::invalid_argument("The path is empty.");
  return to_std(godot::ProjectSettings::get_singleton()->globalize_path(path));
}

godot::Dictionary error_result(std::string_view message) {
  godot::Dictionary result;
  result["error"] = to_godot(message);
  return result;
}

}  // namespace lobelight
