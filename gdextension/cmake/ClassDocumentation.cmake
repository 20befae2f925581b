# Builds the class reference into the library. As a module it defines lobelight_add_documentation;
# run as a script (cmake -DFILES=… -DOUTPUT=… -P) it writes the source file.

if(CMAKE_SCRIPT_MODE_FILE)
  set(literals "")
  foreach(file IN LISTS FILES)
    file(READ "${file}" text)
    string(APPEND literals "      R\"lobelight(${text})lobelight\",\n")
  endforeach()
  file(WRITE "${OUTPUT}" "// Written by cmake/ClassDocumentation.cmake.
#include <string_view>
#include <vector>

namespace lobelight {

const std::vector<std::string_view>& class_documentation_files() {
  static const std::vector<std::string_view> files = {
${literals}  };
  return files;
}

}  // namespace lobelight
")
  return()
endif()

set(LOBELIGHT_CLASS_DOCUMENTATION_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

# Adds the class reference files (*.xml) to the sources of `target`.
function(lobelight_add_documentation target)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/class_documentation_files.cpp")
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DFILES=${ARGN}" "-DOUTPUT=${output}"
            -P "${LOBELIGHT_CLASS_DOCUMENTATION_SCRIPT}"
    DEPENDS ${ARGN} "${LOBELIGHT_CLASS_DOCUMENTATION_SCRIPT}"
    COMMENT "Building the class reference into ${target}"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
