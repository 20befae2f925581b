#pragma once

#include <gdextension_interface.h>

namespace lobelight {

// Hands the class reference that is built into the library to the editor's help. Only the editor
// can take it; elsewhere nothing happens.
void load_class_documentation(GDExtensionInterfaceGetProcAddress get_proc_address);

}  // namespace lobelight
