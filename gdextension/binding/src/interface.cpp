#include <cstdio>
#include <godot_cpp/subset/interface.hpp>
#include <godot_cpp/variant/string.hpp>
#include <godot_cpp/variant/string_name.hpp>
#include <string>

namespace godot::subset {

Interface engine;

namespace {

// Always false.
bool report(const std::string& what) {
  const std::string sentence =
      "The extension cannot be used with this engine, which lacks " + what + ".";
  if (engine.print_error_with_message == nullptr) {
    std::fprintf(stderr, "ERROR: %s\n", sentence.c_str());
    return false;
  }
  engine.print_error_with_message("The extension is refused.", sentence.c_str(), __func__, __FILE__,
                                  __LINE__, true);
  return false;
}

bool report_method(const std::string& name, GDExtensionInt hash) {
  return report(name + "() with the signature hash " + std::to_string(hash));
}

std::string type_name(GDExtensionVariantType type) {
  String name;
  engine.variant_get_type_name(type, name._native_ptr());
  return name.utf8().get_data();
}

}  // namespace

bool Interface::load(GDExtensionInterfaceGetProcAddress get_proc_address,
                     GDExtensionClassLibraryPtr owner) {
  library = owner;
  // In this order: each needs what is before it.
  return load_functions(get_proc_address) && load_types() && load_methods();
}

bool Interface::load_functions(GDExtensionInterfaceGetProcAddress get_proc_address) {
  bool complete = true;
#define GODOT_SUBSET_LOAD(type, name)                                           \
  name = reinterpret_cast<GDExtensionInterface##type>(get_proc_address(#name)); \
  if (name == nullptr) complete = report("the GDExtension function " #name);
  GODOT_SUBSET_INTERFACE(GODOT_SUBSET_LOAD)
#undef GODOT_SUBSET_LOAD
  return complete;
}

bool Interface::load_types() {
  bool complete = true;
  // The engine's order for every one of these types: 0 is the default constructor, 1 the copy.
#define GODOT_SUBSET_LOAD(enumerator, name)                                                     \
  {                                                                                             \
    constexpr GDExtensionVariantType TYPE = GDEXTENSION_VARIANT_TYPE_##enumerator;              \
    TypeFunctions& type = types[TYPE];                                                          \
    type.construct = variant_get_ptr_constructor(TYPE, 0);                                      \
    type.construct_copy = variant_get_ptr_constructor(TYPE, 1);                                 \
    type.destroy = variant_get_ptr_destructor(TYPE);                                            \
    if (type.construct == nullptr || type.construct_copy == nullptr || type.destroy == nullptr) \
      complete = report("the constructors of " #name);                                          \
  }
  GODOT_SUBSET_OPAQUE_TYPES(GODOT_SUBSET_LOAD)
#undef GODOT_SUBSET_LOAD
#define GODOT_SUBSET_LOAD(enumerator, name)                                        \
  {                                                                                \
    constexpr GDExtensionVariantType TYPE = GDEXTENSION_VARIANT_TYPE_##enumerator; \
    TypeFunctions& type = types[TYPE];                                             \
    type.to_variant = get_variant_from_type_constructor(TYPE);                     \
    type.from_variant = get_variant_to_type_constructor(TYPE);                     \
    if (type.to_variant == nullptr || type.from_variant == nullptr)                \
      complete = report("the conversions of " #name);                              \
  }
  GODOT_SUBSET_VARIANT_TYPES(GODOT_SUBSET_LOAD)
#undef GODOT_SUBSET_LOAD
  // The engine's third constructor of a Callable: (Object, StringName).
  callable_of_method = variant_get_ptr_constructor(GDEXTENSION_VARIANT_TYPE_CALLABLE, 2);
  if (callable_of_method == nullptr) complete = report("Callable(object, method)");
  return complete;
}

bool Interface::load_methods() {
  bool complete = true;
#define GODOT_SUBSET_LOAD(member, type, name, hash)                               \
  member = variant_get_ptr_builtin_method(GDEXTENSION_VARIANT_TYPE_##type,        \
                                          StringName(#name)._native_ptr(), hash); \
  if (member == nullptr)                                                          \
    complete = report_method(type_name(GDEXTENSION_VARIANT_TYPE_##type) + "." #name, hash);
  GODOT_SUBSET_BUILTIN_METHODS(GODOT_SUBSET_LOAD)
#undef GODOT_SUBSET_LOAD
#define GODOT_SUBSET_LOAD(name, hash)                                             \
  name = variant_get_ptr_utility_function(StringName(#name)._native_ptr(), hash); \
  if (name == nullptr) complete = report_method(#name, hash);
  GODOT_SUBSET_UTILITY_FUNCTIONS(GODOT_SUBSET_LOAD)
#undef GODOT_SUBSET_LOAD
#define GODOT_SUBSET_LOAD(member, class_name, name, hash)                  \
  member = classdb_get_method_bind(StringName(#class_name)._native_ptr(),  \
                                   StringName(#name)._native_ptr(), hash); \
  if (member == nullptr) complete = report_method(#class_name "." #name, hash);
  GODOT_SUBSET_CLASS_METHODS(GODOT_SUBSET_LOAD)
#undef GODOT_SUBSET_LOAD
  return complete;
}

}  // namespace godot::subset
