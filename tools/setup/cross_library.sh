#!/usr/bin/env bash
# Builds the native library for another system into build/libraries: cross_library.sh TARGET
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "cross_library.sh takes the target, as lobelight.gdextension names it: windows.x86_64"
target=$1
build=$ROOT/build/cross/$target
libraries=$ROOT/build/libraries
need_interface
need_cross "$target"
key=$(cross_key)
if stamp_is "$libraries/$target/key" "$key"; then
  exit 0
fi

compile() {
  configure_native "$build" "${CROSS[@]}"
  cmake --build "$build" --target lobelight_library --parallel "$JOBS"
}

mkdir -p "$build"
touch "$ROOT/build/.gdignore"
step --advice "If the compiler or CMake has changed, removing build/cross and running this again helps." \
  "Building the library for $target" compile
rm -rf "${libraries:?}/$target"
mkdir -p "$libraries/$target"
cp "$build/liblobelight.${target%%.*}.editor.${target##*.}".* "$libraries/$target"
write_stamp "$libraries/$target/key" "$key"
