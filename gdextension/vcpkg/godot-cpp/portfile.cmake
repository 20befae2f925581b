# godot-cpp's sources, of one commit, in share/godot-cpp/source, for GODOT_CPP_SOURCE_DIR (gdextension/cmake/GodotCpp.cmake).
# vcpkg has a port of this name, but of Godot 4.5 and built without exceptions and hot reload.
set(VCPKG_POLICY_EMPTY_INCLUDE_FOLDER enabled)

vcpkg_from_git(
  OUT_SOURCE_PATH SOURCE_PATH
  URL https://github.com/godotengine/godot-cpp.git
  REF 9c8aeff0f58ad030f3d1030e8262de1322cd0ccd
)

file(INSTALL "${SOURCE_PATH}/" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}/source")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE.md")
