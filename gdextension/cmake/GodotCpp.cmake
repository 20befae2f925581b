# Where the C++ API of the engine comes from. Makes the target lobelight_godot_cpp and says which
# of these it stands for:
#   1. a godot-cpp package with a CMake configuration (Conan: godot-cpp::godot-cpp)
#   2. the vcpkg port (unofficial::godot::cpp)
#   3. godot-cpp's own sources in the directory GODOT_CPP_SOURCE_DIR
#   4. the subset of godot-cpp in binding/, which needs the engine's C interface (EngineInterface.cmake)
# An installed package is this machine's: builds for other systems take none.
# Where there is nothing of all this, LOBELIGHT_NO_LIBRARY says so in one sentence.
set(GODOT_CPP_SOURCE_DIR "" CACHE PATH "Directory of godot-cpp's sources; built with the library if no package of godot-cpp is found")

add_library(lobelight_godot_cpp INTERFACE)
set(LOBELIGHT_NO_LIBRARY "")

if(NOT CMAKE_CROSSCOMPILING)
  find_package(godot-cpp CONFIG QUIET)
  if(NOT godot-cpp_FOUND)
    find_package(unofficial-godot-cpp CONFIG QUIET)
  endif()
endif()

if(godot-cpp_FOUND)
  set(_godot_cpp_target godot-cpp::godot-cpp)
  message(STATUS "godot-cpp: package in ${godot-cpp_DIR}")
elseif(unofficial-godot-cpp_FOUND)
  set(_godot_cpp_target unofficial::godot::cpp)
  message(STATUS "godot-cpp: vcpkg package in ${unofficial-godot-cpp_DIR}")
elseif(GODOT_CPP_SOURCE_DIR)
  if(NOT EXISTS "${GODOT_CPP_SOURCE_DIR}/CMakeLists.txt")
    message(FATAL_ERROR "GODOT_CPP_SOURCE_DIR: there is no CMakeLists.txt in ${GODOT_CPP_SOURCE_DIR}")
  endif()
  set(GODOTCPP_SYSTEM_HEADERS ON CACHE BOOL "Expose headers as SYSTEM")  # not held to our warnings
  set(GODOTCPP_DISABLE_EXCEPTIONS OFF CACHE BOOL "Disable exceptions")  # ours end at src/godot
  set(GODOTCPP_USE_HOT_RELOAD ON CACHE BOOL "Support hot reload")  # the .gdextension promises it
  set(GODOTCPP_TARGET editor CACHE STRING "Which target to generate")
  set(GODOTCPP_API_VERSION 4.6 CACHE STRING "The Godot API version to target")
  add_subdirectory("${GODOT_CPP_SOURCE_DIR}" godot-cpp EXCLUDE_FROM_ALL)
  set(_godot_cpp_target godot::cpp)
  message(STATUS "godot-cpp: sources in ${GODOT_CPP_SOURCE_DIR}")
else()
  include(cmake/EngineInterface.cmake)
  if(LOBELIGHT_INTERFACE_FOLDER)
    add_subdirectory(binding)
    set(_godot_cpp_target lobelight_binding)
    message(STATUS "godot-cpp: the subset in ${CMAKE_CURRENT_SOURCE_DIR}/binding, for the engine's interface in ${LOBELIGHT_INTERFACE_FOLDER}")
  else()
    set(LOBELIGHT_NO_LIBRARY "The library for the engine cannot be built without gdextension_interface.h: run `godot --headless --dump-gdextension-interface` with Godot 4.6 and set LOBELIGHT_GDEXTENSION_INTERFACE to the file that it writes, or have godot on PATH, or godot-cpp's sources in GODOT_CPP_SOURCE_DIR.")
  endif()
endif()

if(NOT LOBELIGHT_NO_LIBRARY)
  target_link_libraries(lobelight_godot_cpp INTERFACE ${_godot_cpp_target})
endif()
