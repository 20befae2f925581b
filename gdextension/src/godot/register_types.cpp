// The library's entry point.
#include <gdextension_interface.h>

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/defs.hpp>
#include <godot_cpp/godot.hpp>

#include "base/background_work.h"
#include "godot/class_documentation.h"
#include "godot/lobe_baker.h"
#include "godot/lobe_image_file.h"
#include "godot/lobe_light_encoder.h"
#include "godot/lobe_light_filter.h"
#include "godot/lobe_reference.h"
#include "godot/lobe_task.h"

namespace {

GDExtensionInterfaceGetProcAddress engine_function = nullptr;

void initialize(godot::ModuleInitializationLevel level) {
  if (level == godot::MODULE_INITIALIZATION_LEVEL_SCENE) {
    GDREGISTER_ABSTRACT_CLASS(lobelight::LobeTask);
    GDREGISTER_CLASS(lobelight::LobeBaker);
    GDREGISTER_CLASS(lobelight::LobeLightEncoder);
    GDREGISTER_CLASS(lobelight::LobeLightFilter);
    GDREGISTER_CLASS(lobelight::LobeReference);
    GDREGISTER_CLASS(lobelight::LobeImageFile);
  }
  if (level == godot::MODULE_INITIALIZATION_LEVEL_EDITOR) {
    lobelight::load_class_documentation(engine_function);
  }
}

void terminate(godot::ModuleInitializationLevel level) {
  if (level == godot::MODULE_INITIALIZATION_LEVEL_SCENE) lobelight::BackgroundWork::stop_all();
}

}  // namespace

extern "C" GDExtensionBool GDE_EXPORT lobelight_library_init(
    GDExtensionInterfaceGetProcAddress get_proc_address, GDExtensionClassLibraryPtr library,
    GDExtensionInitialization* initialization) {
  engine_function = get_proc_address;
  const godot::GDExtensionBinding::InitObject binding(get_proc_address, library, initialization);
  binding.register_initializer(initialize);
  binding.register_terminator(terminate);
  binding.set_minimum_library_initialization_level(godot::MODULE_INITIALIZATION_LEVEL_SCENE);
  return binding.init();
}
