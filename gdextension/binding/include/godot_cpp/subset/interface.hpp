// The engine's C functions that this binding calls, looked up by name once when the library loads.
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

struct Interface {
#define GODOT_SUBSET_DECLARE(type, name) GDExtensionInterface##type name = nullptr;
  GODOT_SUBSET_INTERFACE(GODOT_SUBSET_DECLARE)
#undef GODOT_SUBSET_DECLARE

  // This library, as the engine's class functions want to be told.
  GDExtensionClassLibraryPtr library = nullptr;

  // False, with a line on stderr that names it, where the engine lacks one of the functions.
  bool load(GDExtensionInterfaceGetProcAddress get_proc_address, GDExtensionClassLibraryPtr owner);
};

// Filled by GDExtensionBinding::InitObject::init(); nothing here works before that.
extern Interface engine;

// Look-ups by name and signature hash (extension_api.json lists both). The engine's answer does not
// change: keep it. Null, with an error printed, where this engine has no such method.
GDExtensionPtrBuiltInMethod find_builtin_method(GDExtensionVariantType type, const char* name,
                                                GDExtensionInt hash);
GDExtensionPtrUtilityFunction find_utility_function(const char* name, GDExtensionInt hash);
GDExtensionMethodBindPtr find_method(const char* class_name, const char* name, GDExtensionInt hash);

}  // namespace godot::subset
