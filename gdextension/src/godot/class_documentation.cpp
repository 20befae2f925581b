#include "godot/class_documentation.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lobelight {

// The files of addons/lobelight/doc_classes; written by cmake/ClassDocumentation.cmake.
const std::vector<std::string_view>& class_documentation_files();

// By the C interface, so that it works the same with every way of getting godot-cpp.
void load_class_documentation(GDExtensionInterfaceGetProcAddress get_proc_address) {
  using LoadXml = void (*)(const char* text, GDExtensionInt size);
  const auto load_xml =
      reinterpret_cast<LoadXml>(get_proc_address("editor_help_load_xml_from_utf8_chars_and_len"));
  if (load_xml == nullptr) return;
  for (const std::string_view file : class_documentation_files()) {
    load_xml(file.data(), static_cast<GDExtensionInt>(file.size()));
  }
}

}  // namespace lobelight
