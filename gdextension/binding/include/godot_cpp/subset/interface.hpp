// What this binding calls of the engine, all of it looked up once when the library loads.
#pragma once

#include <gdextension_interface.h>

namespace godot::subset {

// One line a function: its type in gdextension_interface.h without the prefix GDExtensionInterface,
// and the name that the engine knows it by.
#define GODOT_SUBSET_INTERFACE(X)                                                    \
  X(PrintErrorWithMessage, print_error_with_message)                                 \
  X(VariantNewNil, variant_new_nil)                                                  \
  X(VariantNewCopy, variant_new_copy)                                                \
  X(VariantDestroy, variant_destroy)                                                 \
  X(VariantGetType, variant_get_type)                                                \
  X(VariantGetTypeName, variant_get_type_name)                                       \
  X(VariantStringify, variant_stringify)                                             \
  X(VariantCanConvertStrict, variant_can_convert_strict)                             \
  X(GetVariantFromTypeConstructor, get_variant_from_type_constructor)                \
  X(GetVariantToTypeConstructor, get_variant_to_type_constructor)                    \
  X(VariantGetPtrConstructor, variant_get_ptr_constructor)                           \
  X(VariantGetPtrDestructor, variant_get_ptr_destructor)                             \
  X(VariantGetPtrBuiltinMethod, variant_get_ptr_builtin_method)                      \
  X(VariantGetPtrUtilityFunction, variant_get_ptr_utility_function)                  \
  X(StringNewWithLatin1Chars, string_new_with_latin1_chars)                          \
  X(StringNewWithUtf8Chars, string_new_with_utf8_chars)                              \
  X(StringNewWithUtf8CharsAndLen2, string_new_with_utf8_chars_and_len2)              \
  X(StringToUtf8Chars, string_to_utf8_chars)                                         \
  X(StringNameNewWithUtf8Chars, string_name_new_with_utf8_chars)                     \
  X(ArrayOperatorIndexConst, array_operator_index_const)                             \
  X(DictionaryOperatorIndex, dictionary_operator_index)                              \
  X(DictionaryOperatorIndexConst, dictionary_operator_index_const)                   \
  X(PackedByteArrayOperatorIndex, packed_byte_array_operator_index)                  \
  X(PackedByteArrayOperatorIndexConst, packed_byte_array_operator_index_const)       \
  X(PackedInt32ArrayOperatorIndex, packed_int32_array_operator_index)                \
  X(PackedInt32ArrayOperatorIndexConst, packed_int32_array_operator_index_const)     \
  X(PackedFloat32ArrayOperatorIndex, packed_float32_array_operator_index)            \
  X(PackedFloat32ArrayOperatorIndexConst, packed_float32_array_operator_index_const) \
  X(GlobalGetSingleton, global_get_singleton)                                        \
  X(ObjectMethodBindCall, object_method_bind_call)                                   \
  X(ObjectMethodBindPtrcall, object_method_bind_ptrcall)                             \
  X(ObjectSetInstance, object_set_instance)                                          \
  X(ClassdbConstructObject2, classdb_construct_object2)                              \
  X(ClassdbGetMethodBind, classdb_get_method_bind)                                   \
  X(ClassdbRegisterExtensionClass5, classdb_register_extension_class5)               \
  X(ClassdbRegisterExtensionClassMethod, classdb_register_extension_class_method)    \
  X(ClassdbRegisterExtensionClassSignal, classdb_register_extension_class_signal)    \
  X(ClassdbUnregisterExtensionClass, classdb_unregister_extension_class)

// Methods of builtin types: the member of Interface that holds it, the type, the method's name and
// the hash of its signature. extension_api.json lists names and hashes, here and below.
#define GODOT_SUBSET_BUILTIN_METHODS(X)                                \
  X(array_size, ARRAY, size, 3173160232)                               \
  X(array_append, ARRAY, append, 3316032543)                           \
  X(dictionary_size, DICTIONARY, size, 3173160232)                     \
  X(dictionary_has, DICTIONARY, has, 3680194679)                       \
  X(dictionary_keys, DICTIONARY, keys, 4144163970)                     \
  X(callable_call_deferred, CALLABLE, call_deferred, 3286317445)       \
  X(packed_byte_array_size, PACKED_BYTE_ARRAY, size, 3173160232)       \
  X(packed_byte_array_resize, PACKED_BYTE_ARRAY, resize, 848867239)    \
  X(packed_int32_array_size, PACKED_INT32_ARRAY, size, 3173160232)     \
  X(packed_int32_array_resize, PACKED_INT32_ARRAY, resize, 848867239)  \
  X(packed_float32_array_size, PACKED_FLOAT32_ARRAY, size, 3173160232) \
  X(packed_float32_array_resize, PACKED_FLOAT32_ARRAY, resize, 848867239)

// Functions of the global scope: the name, which is the member's too, and the hash.
#define GODOT_SUBSET_UTILITY_FUNCTIONS(X) X(push_error, 2648703342)

// Methods of classes: the member of Interface that holds it, class, name and hash.
#define GODOT_SUBSET_CLASS_METHODS(X)                      \
  X(object_notification, Object, notification, 4023243586) \
  X(object_emit_signal, Object, emit_signal, 4047867050)   \
  X(project_settings_globalize_path, ProjectSettings, globalize_path, 3135753539)

// Builtin types whose layout belongs to the engine: they are constructed, copied and destroyed by
// it.
#define GODOT_SUBSET_OPAQUE_TYPES(X)      \
  X(STRING, String)                       \
  X(STRING_NAME, StringName)              \
  X(CALLABLE, Callable)                   \
  X(DICTIONARY, Dictionary)               \
  X(ARRAY, Array)                         \
  X(PACKED_BYTE_ARRAY, PackedByteArray)   \
  X(PACKED_INT32_ARRAY, PackedInt32Array) \
  X(PACKED_FLOAT32_ARRAY, PackedFloat32Array)

// Builtin types that go into a Variant and come out of one.
#define GODOT_SUBSET_VARIANT_TYPES(X)     \
  X(BOOL, bool)                           \
  X(INT, int)                             \
  X(FLOAT, float)                         \
  X(STRING, String)                       \
  X(VECTOR2, Vector2)                     \
  X(VECTOR2I, Vector2i)                   \
  X(VECTOR3, Vector3)                     \
  X(STRING_NAME, StringName)              \
  X(DICTIONARY, Dictionary)               \
  X(ARRAY, Array)                         \
  X(PACKED_BYTE_ARRAY, PackedByteArray)   \
  X(PACKED_INT32_ARRAY, PackedInt32Array) \
  X(PACKED_FLOAT32_ARRAY, PackedFloat32Array)

// The engine's functions for one builtin type; null where the lists above do not ask for them.
struct TypeFunctions {
  GDExtensionPtrConstructor construct = nullptr;
  GDExtensionPtrConstructor construct_copy = nullptr;
  GDExtensionPtrDestructor destroy = nullptr;
  GDExtensionVariantFromTypeConstructorFunc to_variant = nullptr;
  GDExtensionTypeFromVariantConstructorFunc from_variant = nullptr;
};

struct Interface {
#define GODOT_SUBSET_DECLARE(type, name) GDExtensionInterface##type name = nullptr;
  GODOT_SUBSET_INTERFACE(GODOT_SUBSET_DECLARE)
#undef GODOT_SUBSET_DECLARE

#define GODOT_SUBSET_DECLARE(member, type, name, hash) GDExtensionPtrBuiltInMethod member = nullptr;
  GODOT_SUBSET_BUILTIN_METHODS(GODOT_SUBSET_DECLARE)
#undef GODOT_SUBSET_DECLARE

#define GODOT_SUBSET_DECLARE(name, hash) GDExtensionPtrUtilityFunction name = nullptr;
  GODOT_SUBSET_UTILITY_FUNCTIONS(GODOT_SUBSET_DECLARE)
#undef GODOT_SUBSET_DECLARE

#define GODOT_SUBSET_DECLARE(member, class_name, name, hash) \
  GDExtensionMethodBindPtr member = nullptr;
  GODOT_SUBSET_CLASS_METHODS(GODOT_SUBSET_DECLARE)
#undef GODOT_SUBSET_DECLARE

  // By GDExtensionVariantType.
  TypeFunctions types[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX];
  // Callable(object, method).
  GDExtensionPtrConstructor callable_of_method = nullptr;

  // This library, as the engine's class functions want to be told.
  GDExtensionClassLibraryPtr library = nullptr;

  // False where the engine lacks any of these, each of which is then named in an error.
  bool load(GDExtensionInterfaceGetProcAddress get_proc_address, GDExtensionClassLibraryPtr owner);

 private:
  bool load_functions(GDExtensionInterfaceGetProcAddress get_proc_address);
  bool load_types();
  bool load_methods();
};

// Filled by GDExtensionBinding::InitObject::init(); nothing here works before that.
extern Interface engine;

}  // namespace godot::subset
