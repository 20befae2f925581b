# Third-party packages. Sets nothing; afterwards there are the targets Threads::Threads, glm::glm, doctest::doctest
# and OpenEXR::OpenEXR, and the function doctest_discover_tests.

set(LOBELIGHT_DEPS_DIR "" CACHE PATH
  "Where static OpenEXR and Imath are installed (./dev builds them); empty: the system's OpenEXR")

find_package(Threads REQUIRED)
if(CMAKE_CROSSCOMPILING)
  # Of these packages' headers only: beside them may lie this system's C library, which is not that of the other one.
  foreach(package glm doctest)
    find_path(LOBELIGHT_${package}_PARENT "${package}" PATHS /usr/include /usr/local/include NO_DEFAULT_PATH REQUIRED)
    set(links "${CMAKE_BINARY_DIR}/${package}-include")
    file(MAKE_DIRECTORY "${links}")
    file(CREATE_LINK "${LOBELIGHT_${package}_PARENT}/${package}" "${links}/${package}" SYMBOLIC)
    add_library(${package}::${package} INTERFACE IMPORTED)
    target_include_directories(${package}::${package} SYSTEM INTERFACE "${links}")
  endforeach()
  function(doctest_discover_tests)
    # The tests do not run on this machine.
  endfunction()
else()
  find_package(glm REQUIRED)
  find_package(doctest REQUIRED)
  include(doctest)
endif()

if(LOBELIGHT_DEPS_DIR)
  # Imath by name, since OpenEXR's own look-up would go through the system's folders too; and always anew, since what
  # an earlier run found would win over a changed LOBELIGHT_DEPS_DIR.
  foreach(package Imath OpenEXR)
    unset(${package}_DIR CACHE)
    find_package(${package} CONFIG REQUIRED PATHS "${LOBELIGHT_DEPS_DIR}" NO_DEFAULT_PATH)
  endforeach()
else()
  find_package(OpenEXR 3.1 CONFIG REQUIRED)
endif()
message(STATUS "OpenEXR ${OpenEXR_VERSION} from ${OpenEXR_DIR}")
