// A C++ function in the form in which the engine calls it.
#pragma once

#include <cstddef>
#include <godot_cpp/subset/argument.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace godot::subset {

class MethodBind {
 public:
  virtual ~MethodBind() = default;

  // What the engine is told about the function.
  bool has_return = false;
  std::uint32_t flags = GDEXTENSION_METHOD_FLAG_NORMAL;
  PropertyInfo return_info;
  GDExtensionClassMethodArgumentMetadata return_metadata =
      GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE;
  std::vector<PropertyInfo> arguments;
  std::vector<GDExtensionClassMethodArgumentMetadata> argument_metadata;
  std::vector<Variant> defaults;  // for the last arguments

  // Checks the number and the types of the arguments, fills in the defaults (the engine leaves this
  // to the library) and calls.
  void call(void* instance, const Variant* const* values, std::int64_t count, Variant& result,
            GDExtensionCallError& error) const;

  // `values` point to the engine's own representations, all of them there and of the right type.
  virtual void call_pointers(void* instance, const void* const* values, void* result) const = 0;

 protected:
  virtual void call_variants(void* instance, const Variant* const* values,
                             Variant& result) const = 0;
};

// `Function` is callable as Result(Class*, Arguments...); Class is void for static methods.
template <class Function, class Class, class Result, class... Arguments>
class FunctionBind final : public MethodBind {
 public:
  FunctionBind(Function function, const std::vector<StringName>& names) : function_(function) {
    if constexpr (!std::is_void_v<Result>) {
      has_return = true;
      return_info = argument_info<Result>("");
      return_metadata = ArgumentFor<Result>::METADATA;
    }
    argument_metadata = {ArgumentFor<Arguments>::METADATA...};
    arguments = {argument_info<Arguments>("")...};
    for (std::size_t i = 0; i < arguments.size() && i < names.size(); ++i) {
      arguments[i].name = names[i];
    }
  }

  void call_pointers(void* instance, const void* const* values, void* result) const override {
    call_pointers(instance, values, result, std::index_sequence_for<Arguments...>());
  }

 protected:
  void call_variants(void* instance, const Variant* const* values, Variant& result) const override {
    call_variants(instance, values, result, std::index_sequence_for<Arguments...>());
  }

 private:
  template <std::size_t... I>
  void call_variants(void* instance, [[maybe_unused]] const Variant* const* values,
                     [[maybe_unused]] Variant& result, std::index_sequence<I...>) const {
    Class* self = static_cast<Class*>(instance);
    if constexpr (std::is_void_v<Result>) {
      function_(self, ArgumentFor<Arguments>::from_variant(*values[I])...);
    } else {
      result = Variant(function_(self, ArgumentFor<Arguments>::from_variant(*values[I])...));
    }
  }

  template <std::size_t... I>
  void call_pointers(void* instance, [[maybe_unused]] const void* const* values,
                     [[maybe_unused]] void* result, std::index_sequence<I...>) const {
    Class* self = static_cast<Class*>(instance);
    if constexpr (std::is_void_v<Result>) {
      function_(self, ArgumentFor<Arguments>::from_pointer(values[I])...);
    } else {
      ArgumentFor<Result>::to_pointer(
          function_(self, ArgumentFor<Arguments>::from_pointer(values[I])...), result);
    }
  }

  Function function_;
};

}  // namespace godot::subset
