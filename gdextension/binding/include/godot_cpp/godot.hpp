#pragma once

#include <gdextension_interface.h>

namespace godot {

enum ModuleInitializationLevel {
  MODULE_INITIALIZATION_LEVEL_CORE = GDEXTENSION_INITIALIZATION_CORE,
  MODULE_INITIALIZATION_LEVEL_SERVERS = GDEXTENSION_INITIALIZATION_SERVERS,
  MODULE_INITIALIZATION_LEVEL_SCENE = GDEXTENSION_INITIALIZATION_SCENE,
  MODULE_INITIALIZATION_LEVEL_EDITOR = GDEXTENSION_INITIALIZATION_EDITOR,
};

class GDExtensionBinding {
 public:
  using Callback = void (*)(ModuleInitializationLevel level);

  // What the library's entry point fills in from the engine's arguments and returns init() of.
  class InitObject {
   public:
    InitObject(GDExtensionInterfaceGetProcAddress get_proc_address,
               GDExtensionClassLibraryPtr library, GDExtensionInitialization* initialization);

    // Called once for each level from the minimum upwards, and in reverse when the engine ends.
    void register_initializer(Callback callback) const;
    void register_terminator(Callback callback) const;
    void set_minimum_library_initialization_level(ModuleInitializationLevel level) const;

    // False where the engine lacks something that the binding needs.
    GDExtensionBool init() const;

   private:
    GDExtensionInterfaceGetProcAddress get_proc_address_;
    GDExtensionClassLibraryPtr library_;
    GDExtensionInitialization* initialization_;
  };
};

}  // namespace godot
