# The engine's C interface, which the subset of godot-cpp in binding/ is compiled against. Sets
# LOBELIGHT_INTERFACE_FOLDER, the folder that has gdextension_interface.h, or leaves it empty where there is none.
set(LOBELIGHT_GDEXTENSION_INTERFACE "" CACHE FILEPATH
  "gdextension_interface.h, as `godot --headless --dump-gdextension-interface` writes it; empty: godot on PATH is asked")

set(LOBELIGHT_INTERFACE_FOLDER "")
if(LOBELIGHT_GDEXTENSION_INTERFACE)
  cmake_path(GET LOBELIGHT_GDEXTENSION_INTERFACE FILENAME _name)
  if(NOT _name STREQUAL gdextension_interface.h OR NOT EXISTS "${LOBELIGHT_GDEXTENSION_INTERFACE}")
    message(FATAL_ERROR
      "LOBELIGHT_GDEXTENSION_INTERFACE: ${LOBELIGHT_GDEXTENSION_INTERFACE} is no file gdextension_interface.h")
  endif()
  cmake_path(GET LOBELIGHT_GDEXTENSION_INTERFACE PARENT_PATH LOBELIGHT_INTERFACE_FOLDER)
else()
  find_program(LOBELIGHT_GODOT NAMES godot godot4 DOC "The engine that is asked for gdextension_interface.h")
  if(LOBELIGHT_GODOT)
    set(_folder "${CMAKE_BINARY_DIR}/engine-interface")
    if(NOT EXISTS "${_folder}/gdextension_interface.h" OR "${LOBELIGHT_GODOT}" IS_NEWER_THAN "${_folder}/gdextension_interface.h")
      file(MAKE_DIRECTORY "${_folder}")
      execute_process(COMMAND "${LOBELIGHT_GODOT}" --headless --dump-gdextension-interface
        WORKING_DIRECTORY "${_folder}" OUTPUT_QUIET ERROR_QUIET)
    endif()
    if(EXISTS "${_folder}/gdextension_interface.h")
      set(LOBELIGHT_INTERFACE_FOLDER "${_folder}")
    endif()
  endif()
endif()

if(LOBELIGHT_INTERFACE_FOLDER)
  file(STRINGS "${LOBELIGHT_INTERFACE_FOLDER}/gdextension_interface.h" _newest
    REGEX "GDExtensionInterfaceClassdbRegisterExtensionClass5" LIMIT_COUNT 1)
  if(NOT _newest)
    message(FATAL_ERROR
      "${LOBELIGHT_INTERFACE_FOLDER}/gdextension_interface.h is of an engine before 4.5, but Lobelight needs Godot 4.6")
  endif()
endif()
