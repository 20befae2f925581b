#include "godot/convert.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <godot_cpp/classes/project_settings.hpp>
#include <stdexcept>
#include <type_traits>

namespace lobelight {

namespace {

template <class Packed, class Element>
Packed pack(const std::vector<Element>& values) {
  Packed packed;
  packed.resize(static_cast<std::int64_t>(values.size()));
  auto* target = packed.ptrw();
  using Target = std::remove_pointer_t<decltype(target)>;
  std::transform(values.begin(), values.end(), target,
                 [](Element value) { return static_cast<Target>(value); });
  return packed;
}

}  // namespace

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
  godot::PackedByteArray bytes;
  bytes.resize(static_cast<std::int64_t>(size));
  if (size > 0) std::memcpy(bytes.ptrw(), halves.data(), size);
  return bytes;
}

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
