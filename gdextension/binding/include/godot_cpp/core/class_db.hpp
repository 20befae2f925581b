#pragma once

#include <godot_cpp/core/defs.hpp>
#include <godot_cpp/core/object.hpp>
#include <godot_cpp/subset/method_bind.hpp>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace godot {

// A method's name and those of its arguments.
struct MethodDefinition {
  StringName name;
  std::vector<StringName> arguments;
};

template <class... Names>
MethodDefinition D_METHOD(const char* name, const Names&... arguments) {
  return {StringName(name), {StringName(arguments)...}};
}

#define DEFVAL(m_value) (m_value)

// Tells the engine about this library's classes.
class ClassDB {
 public:
  template <class T>
  static void register_class() {
    register_class_as<T>(false);
  }
  // For classes that only serve as a base.
  template <class T>
  static void register_abstract_class() {
    register_class_as<T>(true);
  }

  // `defaults` are for the last arguments.
  template <class Class, class Result, class... Arguments, class... Defaults>
  static void bind_method(const MethodDefinition& definition, Result (Class::*method)(Arguments...),
                          const Defaults&... defaults) {
    const auto function = [method](Class* self, auto&&... arguments) -> Result {
      return (self->*method)(std::forward<decltype(arguments)>(arguments)...);
    };
    bind<Class, Result, Arguments...>(Class::get_class_static(), definition, function,
                                      GDEXTENSION_METHOD_FLAGS_DEFAULT, {Variant(defaults)...});
  }
  template <class Class, class Result, class... Arguments, class... Defaults>
  static void bind_method(const MethodDefinition& definition,
                          Result (Class::*method)(Arguments...) const,
                          const Defaults&... defaults) {
    const auto function = [method](const Class* self, auto&&... arguments) -> Result {
      return (self->*method)(std::forward<decltype(arguments)>(arguments)...);
    };
    bind<const Class, Result, Arguments...>(
        Class::get_class_static(), definition, function,
        GDEXTENSION_METHOD_FLAGS_DEFAULT | GDEXTENSION_METHOD_FLAG_CONST, {Variant(defaults)...});
  }
  template <class Result, class... Arguments, class... Defaults>
  static void bind_static_method(const StringName& class_name, const MethodDefinition& definition,
                                 Result (*method)(Arguments...), const Defaults&... defaults) {
    const auto function = [method](const void*, auto&&... arguments) -> Result {
      return method(std::forward<decltype(arguments)>(arguments)...);
    };
    bind<const void, Result, Arguments...>(class_name, definition, function,
                                           GDEXTENSION_METHOD_FLAG_STATIC, {Variant(defaults)...});
  }

  static void add_signal(const StringName& class_name, const MethodInfo& signal);

  // Takes back every class, in reverse order.
  static void _unregister_classes();

 private:
  // By specialisation: under the undefined-behaviour sanitizer GCC does not take a comparison of
  // functions for a constant.
  template <void (*ONE)(), void (*OTHER)()>
  struct SameFunction : std::false_type {};
  template <void (*ONE)()>
  struct SameFunction<ONE, ONE> : std::true_type {};

  // Makes the C++ half for the engine's half `owner`.
  template <class T>
  static std::unique_ptr<T> construct(GDExtensionObjectPtr owner) {
    set_owner_under_construction(owner);
    return std::make_unique<T>();
  }

  template <class T>
  static GDExtensionObjectPtr create_instance(void*, GDExtensionBool notify) {
    const GDExtensionObjectPtr owner = create_owner(T::_get_engine_class_static());
    // From here on the engine's half owns the other one and frees it by free_instance.
    set_instance(owner, T::get_class_static(), construct<T>(owner).release());
    if (notify != 0) notify_postinitialize(owner);
    return owner;
  }
  template <class T>
  static void free_instance(void*, GDExtensionClassInstancePtr instance) {
    delete static_cast<T*>(instance);
  }
  // After a reload of the library: a fresh C++ half for an object that lives on.
  template <class T>
  static GDExtensionClassInstancePtr recreate_instance(void*, GDExtensionObjectPtr owner) {
    return construct<T>(owner).release();
  }

  template <class T>
  static void register_class_as(bool is_abstract) {
    static_assert(!SameFunction<T::_bind_methods, T::parent_type::_bind_methods>::value,
                  "The class must declare 'static void _bind_methods()'.");
    GDExtensionClassCreationInfo5 info{};
    info.is_abstract = is_abstract;
    info.is_exposed = true;
    info.free_instance_func = free_instance<T>;
    if constexpr (!std::is_abstract_v<T>) {
      info.create_instance_func = create_instance<T>;
      info.recreate_instance_func = recreate_instance<T>;
    }
    register_class_with(T::get_class_static(), T::get_parent_class_static(), info);
    T::_bind_methods();
  }

  template <class Class, class Result, class... Arguments, class Function>
  static void bind(const StringName& class_name, const MethodDefinition& definition,
                   Function function, std::uint32_t flags, std::vector<Variant> defaults) {
    auto bound = std::make_unique<subset::FunctionBind<Function, Class, Result, Arguments...>>(
        function, definition.arguments);
    bound->flags = flags;
    bound->defaults = std::move(defaults);
    bind_with(class_name, definition.name, std::move(bound));
  }

  static GDExtensionObjectPtr create_owner(const char* engine_class);
  static void set_owner_under_construction(GDExtensionObjectPtr owner);
  static void set_instance(GDExtensionObjectPtr owner, const char* class_name,
                           GDExtensionClassInstancePtr instance);
  static void notify_postinitialize(GDExtensionObjectPtr owner);
  static void register_class_with(const char* name, const char* parent,
                                  const GDExtensionClassCreationInfo5& info);
  static void bind_with(const StringName& class_name, const StringName& name,
                        std::unique_ptr<subset::MethodBind> bound);
};

#define GDREGISTER_CLASS(m_class) ::godot::ClassDB::register_class<m_class>()
#define GDREGISTER_ABSTRACT_CLASS(m_class) ::godot::ClassDB::register_abstract_class<m_class>()

}  // namespace godot
