# Third-party packages. Sets nothing; afterwards there are the targets Threads::Threads, glm::glm, doctest::doctest
# and OpenEXR::OpenEXR, and the function doctest_discover_tests.

set(LOBELIGHT_DEPS_DIR "" CACHE PATH
  "Where static OpenEXR and Imath are installed (./dev builds them); empty: the system's OpenEXR")

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(doctest REQUIRED)
include(doctest)

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
