#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/packed_float32_array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/string.hpp>
#include <godot_cpp/variant/variant.hpp>
#include <godot_cpp/variant/vector2.hpp>
#include <godot_cpp/variant/vector3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lobelight {

// Between the engine's types and the core's. Text is UTF-8 on the core's side. Arrays throw
// std::bad_alloc where the engine has no memory for them.
std::string to_std(const godot::String& text);
godot::String to_godot(std::string_view text);
godot::Vector2 to_godot(const glm::dvec2& value);
godot::Vector2i to_godot(const glm::ivec2& value);
godot::PackedInt32Array to_godot(const std::vector<int>& values);
godot::PackedFloat32Array to_godot(const std::vector<float>& values);
// Rounded to single precision.
godot::PackedFloat32Array to_godot(const std::vector<double>& values);

// Widths that a script passes in single precision, as it wrote them (base/as_written.h).
glm::dvec2 to_widths(const godot::Vector2& value);
glm::dvec3 to_core(const godot::Vector3& value);

godot::PackedByteArray to_bytes(const std::vector<std::uint16_t>& halves);

// The file system's name of a res://, user:// or ordinary path. Throws std::invalid_argument for an
// empty one.
std::string file_system_path(const godot::String& path);

// {"error": message}: what a method gives back that could not do what it was asked to.
godot::Dictionary error_result(std::string_view message);

}  // namespace lobelight
