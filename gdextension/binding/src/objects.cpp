// Calls of the engine's own classes.
#include <godot_cpp/classes/project_settings.hpp>
#include <godot_cpp/variant/utility_functions.hpp>
#include <vector>

namespace godot {

using subset::engine;

namespace {

std::vector<GDExtensionConstVariantPtr> pointers_to(const Variant* values, std::size_t count) {
  std::vector<GDExtensionConstVariantPtr> pointers;
  for (std::size_t i = 0; i < count; ++i) pointers.push_back(values[i]._native_ptr());
  return pointers;
}

}  // namespace

void Object::emit_signal_with(const Variant* arguments, std::size_t count) {
  Variant result;
  GDExtensionCallError error{};
  engine.object_method_bind_call(engine.object_emit_signal, _owner,
                                 pointers_to(arguments, count).data(),
                                 static_cast<GDExtensionInt>(count), result._native_ptr(), &error);
}

ProjectSettings* ProjectSettings::get_singleton() {
  static ProjectSettings settings(
      engine.global_get_singleton(StringName("ProjectSettings")._native_ptr()));
  return &settings;
}

String ProjectSettings::globalize_path(const String& path) const {
  String result;
  const GDExtensionConstTypePtr arguments[] = {path._native_ptr()};
  engine.object_method_bind_ptrcall(engine.project_settings_globalize_path, _owner, arguments,
                                    result._native_ptr());
  return result;
}

void UtilityFunctions::push_error_with(const Variant* arguments, std::size_t count) {
  engine.push_error(nullptr, pointers_to(arguments, count).data(), static_cast<int>(count));
}

}  // namespace godot
