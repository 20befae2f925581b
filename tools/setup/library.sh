#!/usr/bin/env bash
# Configures, builds and installs the native library: library.sh lobelight_library|all ("all": the C++ tests too)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "library.sh takes what to build: lobelight_library or all"
target=$1
build=$ROOT/build/cmake
extensions=$ROOT/.godot/extension_list.cfg
need_openexr
need_interface
key=$(library_key)
case $target in
  lobelight_library) stamp=$ROOT/build/library-key ;;
  all) stamp=$ROOT/build/tests-key ;;
  *) die "library.sh builds lobelight_library or all, not '$target'" ;;
esac
if stamp_is "$stamp" "$key" && [[ -f $extensions ]] && compgen -G "$ROOT/addons/lobelight/bin/*" >/dev/null; then
  exit 0
fi

compile() {
  cmake --build "$build" --target "$target" --parallel "$JOBS"
  cmake --install "$build" --strip
}
mkdir -p "$ROOT/build"
touch "$ROOT/build/.gdignore"
step --advice "If the compiler or CMake has changed, removing build/ and running this again helps." \
  "Configuring the extension" configure_native "$build"
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
