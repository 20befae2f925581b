#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/godot.hpp>

namespace godot {

namespace {

GDExtensionBinding::Callback initializer = nullptr;
GDExtensionBinding::Callback terminator = nullptr;
GDExtensionInitializationLevel minimum_level = GDEXTENSION_INITIALIZATION_CORE;

void initialize(void*, GDExtensionInitializationLevel level) {
  if (initializer != nullptr) initializer(static_cast<ModuleInitializationLevel>(level));
}

void deinitialize(void*, GDExtensionInitializationLevel level) {
  if (terminator != nullptr) terminator(static_cast<ModuleInitializationLevel>(level));
  if (level == minimum_level) ClassDB::_unregister_classes();
}

}  // namespace

GDExtensionBinding::InitObject::InitObject(GDExtensionInterfaceGetProcAddress get_proc_address,
                                           GDExtensionClassLibraryPtr library,
                                           GDExtensionInitialization* initialization)
    : get_proc_address_(get_proc_address), library_(library), initialization_(initialization) {}

void GDExtensionBinding::InitObject::register_initializer(Callback callback) const {
  initializer = callback;
}

void GDExtensionBinding::InitObject::register_terminator(Callback callback) const {
  terminator = callback;
}

void GDExtensionBinding::InitObject::set_minimum_library_initialization_level(
    ModuleInitializationLevel level) const {
  minimum_level = static_cast<GDExtensionInitializationLevel>(level);
}

GDExtensionBool GDExtensionBinding::InitObject::init() const {
  if (!subset::engine.load(get_proc_address_, library_)) return false;
  initialization_->minimum_initialization_level = minimum_level;
  initialization_->userdata = nullptr;
  initialization_->initialize = initialize;
  initialization_->deinitialize = deinitialize;
  return true;
}

}  // namespace godot
