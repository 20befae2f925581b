#include <cstdio>
#include <godot_cpp/subset/interface.hpp>
#include <godot_cpp/variant/string_name.hpp>

namespace godot::subset {

Interface engine;

bool Interface::load(GDExtensionInterfaceGetProcAddress get_proc_address,
                     GDExtensionClassLibraryPtr owner) {
  library = owner;
  bool complete = true;
  // stderr, because the engine's own way to report may be what is missing.
#define GODOT_SUBSET_LOAD(type, name)                                                       \
  name = reinterpret_cast<GDExtensionInterface##type>(get_proc_address(#name));             \
  if (name == nullptr) {                                                                    \
    std::fprintf(stderr, "ERROR: This engine lacks the GDExtension function " #name ".\n"); \
    complete = false;                                                                       \
  }
  GODOT_SUBSET_INTERFACE(GODOT_SUBSET_LOAD)
#undef GODOT_SUBSET_LOAD
  return complete;
}

namespace {

void report_missing(const char* name) {
  engine.print_error_with_message(
      name, "This engine has no function of that name and signature for the extension.", __func__,
      __FILE__, __LINE__, false);
}

}  // namespace

GDExtensionPtrBuiltInMethod find_builtin_method(GDExtensionVariantType type, const char* name,
                                                GDExtensionInt hash) {
  const GDExtensionPtrBuiltInMethod method =
      engine.variant_get_ptr_builtin_method(type, StringName(name)._native_ptr(), hash);
  if (method == nullptr) report_missing(name);
  return method;
}

GDExtensionPtrUtilityFunction find_utility_function(const char* name, GDExtensionInt hash) {
  const GDExtensionPtrUtilityFunction function =
      engine.variant_get_ptr_utility_function(StringName(name)._native_ptr(), hash);
  if (function == nullptr) report_missing(name);
  return function;
}

GDExtensionMethodBindPtr find_method(const char* class_name, const char* name,
                                     GDExtensionInt hash) {
  const GDExtensionMethodBindPtr method = engine.classdb_get_method_bind(
      StringName(class_name)._native_ptr(), StringName(name)._native_ptr(), hash);
  if (method == nullptr) report_missing(name);
  return method;
}

}  // namespace godot::subset
