#!/usr/bin/env bash
# Configures, builds and installs the native library: library.sh lobelight_library|lobelight_tests|all
# lobelight_tests is the C++ tests' program alone, without the library; all is everything that CMake builds.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "library.sh takes what to build: lobelight_library, lobelight_tests or all"
target=$1
build=$ROOT/build/cmake
extensions=$ROOT/.godot/extension_list.cfg
need_openexr
need_interface
key=$(library_key)
case $target in
  lobelight_library) stamp=$ROOT/build/library-key ;;
  lobelight_tests) stamp=$ROOT/build/core-tests-key ;;
  all) stamp=$ROOT/build/tests-key ;;
  *) die "library.sh builds lobelight_library, lobelight_tests or all, not '$target'" ;;
esac
if [[ $target == lobelight_tests ]] && stamp_is "$stamp" "$key"; then
  exit 0
fi
if stamp_is "$stamp" "$key" && [[ -f $extensions ]] && compgen -G "$ROOT/addons/lobelight/bin/*" >/dev/null; then
  exit 0
fi

build_target() {
  cmake --build "$build" --target "$target" --parallel "$JOBS"
}
compile() {
  build_target
  cmake --install "$build" --strip
}
mkdir -p "$ROOT/build"
touch "$ROOT/build/.gdignore"
step --advice "If the compiler or CMake has changed, removing build/ and running this again helps." \
  "Configuring the extension" configure_native "$build"
if [[ $target == lobelight_tests ]]; then
  step "Building the C++ tests" build_target
  write_stamp "$stamp" "$key"
  exit 0
fi
if [[ $target == all ]]; then
  step "Building the extension and its tests" compile
else
  step "Building the extension" compile
fi
ln -sfn cmake/compile_commands.json "$ROOT/build/compile_commands.json"

# The engine's first import of a project aborts when it finds an extension that it did not know from the start.
mkdir -p "$(dirname "$extensions")"
if ! grep -qsx "res://addons/lobelight/lobelight.gdextension" "$extensions"; then
  echo "res://addons/lobelight/lobelight.gdextension" >>"$extensions"
fi

write_stamp "$ROOT/build/library-key" "$key"
write_stamp "$stamp" "$key"
