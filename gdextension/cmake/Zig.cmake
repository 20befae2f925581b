# Toolchain: builds for another system with Zig's Clang, C library and libc++. ./dev package --all uses it.
#   -DCMAKE_TOOLCHAIN_FILE=…/Zig.cmake -DLOBELIGHT_ZIG=…/zig -DLOBELIGHT_TARGET=windows.x86_64
set(LOBELIGHT_ZIG "" CACHE FILEPATH "Program of Zig 0.15")
set(LOBELIGHT_TARGET "" CACHE STRING "System and processor, as lobelight.gdextension names them")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LOBELIGHT_ZIG LOBELIGHT_TARGET)

# The oldest systems that are promised: glibc of Debian 10 and RHEL 8; macOS 10.15, the first with C++17's files, and 11
# on arm64, which the engine asks for.
if(LOBELIGHT_TARGET STREQUAL "linux.x86_64")
  set(CMAKE_SYSTEM_NAME Linux)
  set(_triple x86_64-linux-gnu.2.28)
elseif(LOBELIGHT_TARGET STREQUAL "linux.arm64")
  set(CMAKE_SYSTEM_NAME Linux)
  set(_triple aarch64-linux-gnu.2.28)
elseif(LOBELIGHT_TARGET STREQUAL "windows.x86_64")
  set(CMAKE_SYSTEM_NAME Windows)
  set(_triple x86_64-windows-gnu)
elseif(LOBELIGHT_TARGET STREQUAL "windows.arm64")
  set(CMAKE_SYSTEM_NAME Windows)
  set(_triple aarch64-windows-gnu)
elseif(LOBELIGHT_TARGET STREQUAL "macos.x86_64")
  set(CMAKE_SYSTEM_NAME Darwin)
  set(_triple x86_64-macos.10.15)
elseif(LOBELIGHT_TARGET STREQUAL "macos.arm64")
  set(CMAKE_SYSTEM_NAME Darwin)
  set(_triple aarch64-macos.11.0)
else()
  message(FATAL_ERROR "LOBELIGHT_TARGET: there is no target '${LOBELIGHT_TARGET}'")
endif()
string(REGEX REPLACE "^[a-z]+\\." "" CMAKE_SYSTEM_PROCESSOR "${LOBELIGHT_TARGET}")

# Part of the compiler, since CMake's first test passes nothing else: with other flags Zig would build its libc++ twice.
# Zig turns its undefined-behaviour sanitizer on by itself. Fused multiply-adds would round differently from target to
# target.
set(_flags -target ${_triple} -O2 -g0 -s -fno-sanitize=undefined -ffp-contract=off)
if(NOT CMAKE_SYSTEM_NAME STREQUAL Windows)
  list(APPEND _flags -fPIC)
endif()
set(CMAKE_C_COMPILER "${LOBELIGHT_ZIG}" cc ${_flags})
set(CMAKE_CXX_COMPILER "${LOBELIGHT_ZIG}" c++ ${_flags})
set(CMAKE_RC_COMPILER "${LOBELIGHT_ZIG}")  # CMake insists on one for Windows; nothing here has resources
foreach(_language C CXX)
  set(CMAKE_${_language}_ARCHIVE_CREATE "\"${LOBELIGHT_ZIG}\" ar qcD <TARGET> <LINK_FLAGS> <OBJECTS>")
  set(CMAKE_${_language}_ARCHIVE_APPEND "\"${LOBELIGHT_ZIG}\" ar qD <TARGET> <LINK_FLAGS> <OBJECTS>")
  set(CMAKE_${_language}_ARCHIVE_FINISH "\"${LOBELIGHT_ZIG}\" ranlib -D <TARGET>")
endforeach()

# Programs are this machine's; what is linked and included is what the command line names.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
