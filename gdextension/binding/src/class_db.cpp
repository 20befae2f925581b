#include <godot_cpp/core/class_db.hpp>

namespace godot {

using subset::engine;

namespace {

// Everything the engine holds pointers to until the classes are taken back.
std::vector<std::unique_ptr<subset::MethodBind>> bound_methods;
std::vector<const char*> class_names;

thread_local GDExtensionObjectPtr owner_under_construction = nullptr;

std::vector<GDExtensionPropertyInfo> to_gdextension(const std::vector<PropertyInfo>& infos) {
  std::vector<GDExtensionPropertyInfo> native;
  for (const PropertyInfo& info : infos) native.push_back(info._to_gdextension());
  return native;
}

void call(void* bound, GDExtensionClassInstancePtr instance,
          const GDExtensionConstVariantPtr* arguments, GDExtensionInt count,
          GDExtensionVariantPtr result, GDExtensionCallError* error) {
  static_cast<const subset::MethodBind*>(bound)->call(
      instance, reinterpret_cast<const Variant* const*>(arguments), count,
      *static_cast<Variant*>(result), *error);
}

void call_pointers(void* bound, GDExtensionClassInstancePtr instance,
                   const GDExtensionConstTypePtr* arguments, GDExtensionTypePtr result) {
  static_cast<const subset::MethodBind*>(bound)->call_pointers(instance, arguments, result);
}

}  // namespace

Wrapped::Wrapped() : _owner(std::exchange(owner_under_construction, nullptr)) {}

void ClassDB::set_owner_under_construction(GDExtensionObjectPtr owner) {
  owner_under_construction = owner;
}

GDExtensionObjectPtr ClassDB::create_owner(const char* engine_class) {
  return engine.classdb_construct_object2(StringName(engine_class)._native_ptr());
}

void ClassDB::set_instance(GDExtensionObjectPtr owner, const char* class_name,
                           GDExtensionClassInstancePtr instance) {
  engine.object_set_instance(owner, StringName(class_name)._native_ptr(), instance);
}

// By pointer call, not through a Variant: the object has no reference yet, and a Variant would take
// the first one and free the object with it.
void ClassDB::notify_postinitialize(GDExtensionObjectPtr owner) {
  const std::int64_t postinitialize = 0;
  const GDExtensionBool reversed = 0;
  const GDExtensionConstTypePtr arguments[] = {&postinitialize, &reversed};
  engine.object_method_bind_ptrcall(engine.object_notification, owner, arguments, nullptr);
}

void ClassDB::register_class_with(const char* name, const char* parent,
                                  const GDExtensionClassCreationInfo5& info) {
  engine.classdb_register_extension_class5(engine.library, StringName(name)._native_ptr(),
                                           StringName(parent)._native_ptr(), &info);
  class_names.push_back(name);
}

void ClassDB::_unregister_classes() {
  for (auto name = class_names.rbegin(); name != class_names.rend(); ++name) {
    engine.classdb_unregister_extension_class(engine.library, StringName(*name)._native_ptr());
  }
  class_names.clear();
  bound_methods.clear();
}

void ClassDB::bind_with(const StringName& class_name, const StringName& name,
                        std::unique_ptr<subset::MethodBind> bound) {
  GDExtensionPropertyInfo return_info = bound->return_info._to_gdextension();
  std::vector<GDExtensionPropertyInfo> arguments = to_gdextension(bound->arguments);
  std::vector<GDExtensionVariantPtr> defaults;
  for (const Variant& value : bound->defaults) defaults.push_back(value._native_ptr());

  GDExtensionClassMethodInfo info{};
  info.name = name._native_ptr();
  info.method_userdata = bound.get();
  info.call_func = call;
  info.ptrcall_func = call_pointers;
  info.method_flags = bound->flags;
  info.has_return_value = bound->has_return;
  info.return_value_info = &return_info;
  info.return_value_metadata = bound->return_metadata;
  info.argument_count = static_cast<std::uint32_t>(arguments.size());
  info.arguments_info = arguments.data();
  info.arguments_metadata = bound->argument_metadata.data();
  info.default_argument_count = static_cast<std::uint32_t>(defaults.size());
  info.default_arguments = defaults.data();
  engine.classdb_register_extension_class_method(engine.library, class_name._native_ptr(), &info);
  bound_methods.push_back(std::move(bound));
}

void ClassDB::add_signal(const StringName& class_name, const MethodInfo& signal) {
  const std::vector<GDExtensionPropertyInfo> arguments = to_gdextension(signal.arguments);
  engine.classdb_register_extension_class_signal(engine.library, class_name._native_ptr(),
                                                 signal.name._native_ptr(), arguments.data(),
                                                 static_cast<GDExtensionInt>(arguments.size()));
}

}  // namespace godot
