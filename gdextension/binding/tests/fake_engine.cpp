#include "fake_engine.h"

#include <cstring>

namespace fake_engine {

namespace {

// A StringName here is the pointer that it was made from; the tests' names are literals.
std::string text(GDExtensionConstStringNamePtr name) {
  const char* characters = nullptr;
  std::memcpy(&characters, name, sizeof characters);
  return characters == nullptr ? "" : characters;
}

void make_name(GDExtensionUninitializedStringNamePtr name, const char* characters) {
  std::memcpy(name, &characters, sizeof characters);
}

bool has(const std::string& what) {
  if (missing.count(what) != 0) return false;
  found.insert(what);
  return true;
}

std::string signed_name(const std::string& name, GDExtensionInt hash) {
  return name + "() with the signature hash " + std::to_string(hash);
}

const char* type_name(GDExtensionVariantType type) {
  static const std::map<GDExtensionVariantType, const char*> names = {
      {GDEXTENSION_VARIANT_TYPE_BOOL, "bool"},
      {GDEXTENSION_VARIANT_TYPE_INT, "int"},
      {GDEXTENSION_VARIANT_TYPE_FLOAT, "float"},
      {GDEXTENSION_VARIANT_TYPE_STRING, "String"},
      {GDEXTENSION_VARIANT_TYPE_VECTOR2, "Vector2"},
      {GDEXTENSION_VARIANT_TYPE_VECTOR2I, "Vector2i"},
      {GDEXTENSION_VARIANT_TYPE_VECTOR3, "Vector3"},
      {GDEXTENSION_VARIANT_TYPE_STRING_NAME, "StringName"},
      {GDEXTENSION_VARIANT_TYPE_CALLABLE, "Callable"},
      {GDEXTENSION_VARIANT_TYPE_DICTIONARY, "Dictionary"},
      {GDEXTENSION_VARIANT_TYPE_ARRAY, "Array"},
      {GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY, "PackedByteArray"},
      {GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY, "PackedInt32Array"},
      {GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY, "PackedFloat32Array"},
  };
  return names.at(type);
}

// Variants: the type's number, then 8 bytes of the value.
struct FakeVariant {
  std::int64_t type;
  std::int64_t value;
  std::int64_t unused;
};

FakeVariant& variant(const void* pointer) {
  return *static_cast<FakeVariant*>(const_cast<void*>(pointer));
}

void construct(GDExtensionUninitializedTypePtr, const GDExtensionConstTypePtr*) {}
void destroy(GDExtensionTypePtr) {}
void call_builtin(GDExtensionTypePtr, const GDExtensionConstTypePtr*, GDExtensionTypePtr, int) {}
void call_utility(GDExtensionTypePtr, const GDExtensionConstTypePtr*, int) {}

void int_to_variant(GDExtensionUninitializedVariantPtr to, GDExtensionTypePtr from) {
  variant(to) = {GDEXTENSION_VARIANT_TYPE_INT, *static_cast<std::int64_t*>(from), 0};
}
void variant_to_int(GDExtensionUninitializedTypePtr to, GDExtensionVariantPtr from) {
  *static_cast<std::int64_t*>(to) = variant(from).value;
}

GDExtensionPtrConstructor constructor(GDExtensionVariantType type, std::int32_t index) {
  const bool special = index > 1;  // 0 is the default constructor, 1 the copy
  return has(special ? "Callable(object, method)"
                     : std::string("constructors of ") + type_name(type))
             ? construct
             : nullptr;
}
GDExtensionPtrDestructor destructor(GDExtensionVariantType type) {
  return has(std::string("constructors of ") + type_name(type)) ? destroy : nullptr;
}
GDExtensionVariantFromTypeConstructorFunc to_variant(GDExtensionVariantType type) {
  return has(std::string("conversions of ") + type_name(type)) ? int_to_variant : nullptr;
}
GDExtensionTypeFromVariantConstructorFunc from_variant(GDExtensionVariantType type) {
  return has(std::string("conversions of ") + type_name(type)) ? variant_to_int : nullptr;
}
GDExtensionPtrBuiltInMethod builtin_method(GDExtensionVariantType type,
                                           GDExtensionConstStringNamePtr name,
                                           GDExtensionInt hash) {
  return has(signed_name(std::string(type_name(type)) + "." + text(name), hash)) ? call_builtin
                                                                                 : nullptr;
}
GDExtensionPtrUtilityFunction utility_function(GDExtensionConstStringNamePtr name,
                                               GDExtensionInt hash) {
  return has(signed_name(text(name), hash)) ? call_utility : nullptr;
}
GDExtensionMethodBindPtr class_method(GDExtensionConstStringNamePtr class_name,
                                      GDExtensionConstStringNamePtr name, GDExtensionInt hash) {
  static const int method = 0;
  return has(signed_name(text(class_name) + "." + text(name), hash)) ? &method : nullptr;
}

void print_error(const char*, const char* message, const char*, const char*, std::int32_t,
                 GDExtensionBool) {
  errors.push_back(message);
}

void register_method(GDExtensionClassLibraryPtr, GDExtensionConstStringNamePtr class_name,
                     const GDExtensionClassMethodInfo* info) {
  methods[text(class_name) + "." + text(info->name)] = {info->method_flags, info->argument_count,
                                                        info->default_argument_count,
                                                        info->method_userdata, info->call_func};
}

void variant_new_nil(GDExtensionUninitializedVariantPtr to) { variant(to) = {}; }
void variant_new_copy(GDExtensionUninitializedVariantPtr to, GDExtensionConstVariantPtr from) {
  variant(to) = variant(from);
}
void variant_destroy(GDExtensionVariantPtr) {}
GDExtensionVariantType variant_get_type(GDExtensionConstVariantPtr of) {
  return static_cast<GDExtensionVariantType>(variant(of).type);
}
GDExtensionBool variant_can_convert_strict(GDExtensionVariantType from, GDExtensionVariantType to) {
  return from == to;
}
void variant_get_type_name(GDExtensionVariantType type, GDExtensionUninitializedStringPtr to) {
  make_name(to, type_name(type));
}
void string_new_with_latin1_chars(GDExtensionUninitializedStringPtr to, const char* characters) {
  make_name(to, characters);
}
GDExtensionInt string_to_utf8_chars(GDExtensionConstStringPtr of, char* to, GDExtensionInt size) {
  const std::string characters = text(of);
  if (to != nullptr) std::memcpy(to, characters.data(), static_cast<std::size_t>(size));
  return static_cast<GDExtensionInt>(characters.size());
}
void string_name_new(GDExtensionUninitializedStringNamePtr to, const char* characters) {
  make_name(to, characters);
}
void register_class(GDExtensionClassLibraryPtr, GDExtensionConstStringNamePtr,
                    GDExtensionConstStringNamePtr, const GDExtensionClassCreationInfo5*) {}
void unregister_class(GDExtensionClassLibraryPtr, GDExtensionConstStringNamePtr) {}

void not_called() {}

}  // namespace

void reset() {
  missing.clear();
  found.clear();
  errors.clear();
  methods.clear();
}

GDExtensionInterfaceFunctionPtr get_proc_address(const char* name) {
  using Pointer = GDExtensionInterfaceFunctionPtr;
  static const std::map<std::string, Pointer> functions = {
      {"print_error_with_message", reinterpret_cast<Pointer>(print_error)},
      {"variant_new_nil", reinterpret_cast<Pointer>(variant_new_nil)},
      {"variant_new_copy", reinterpret_cast<Pointer>(variant_new_copy)},
      {"variant_destroy", reinterpret_cast<Pointer>(variant_destroy)},
      {"variant_get_type", reinterpret_cast<Pointer>(variant_get_type)},
      {"variant_get_type_name", reinterpret_cast<Pointer>(variant_get_type_name)},
      {"variant_can_convert_strict", reinterpret_cast<Pointer>(variant_can_convert_strict)},
      {"get_variant_from_type_constructor", reinterpret_cast<Pointer>(to_variant)},
      {"get_variant_to_type_constructor", reinterpret_cast<Pointer>(from_variant)},
      {"variant_get_ptr_constructor", reinterpret_cast<Pointer>(constructor)},
      {"variant_get_ptr_destructor", reinterpret_cast<Pointer>(destructor)},
      {"variant_get_ptr_builtin_method", reinterpret_cast<Pointer>(builtin_method)},
      {"variant_get_ptr_utility_function", reinterpret_cast<Pointer>(utility_function)},
      {"string_new_with_latin1_chars", reinterpret_cast<Pointer>(string_new_with_latin1_chars)},
      {"string_to_utf8_chars", reinterpret_cast<Pointer>(string_to_utf8_chars)},
      {"string_name_new_with_utf8_chars", reinterpret_cast<Pointer>(string_name_new)},
      {"classdb_get_method_bind", reinterpret_cast<Pointer>(class_method)},
      {"classdb_register_extension_class5", reinterpret_cast<Pointer>(register_class)},
      {"classdb_register_extension_class_method", reinterpret_cast<Pointer>(register_method)},
      {"classdb_unregister_extension_class", reinterpret_cast<Pointer>(unregister_class)},
  };
  if (!has(name)) return nullptr;
  const auto function = functions.find(name);
  return function != functions.end() ? function->second : not_called;
}

}  // namespace fake_engine
