#!/usr/bin/env bash
# packs the addon, with the editor's library, into the zip that is unpacked into a project ([--all] [--out X.zip])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev package [--all | --no-library] [--out X.zip] [--json FILE]

--out X.zip    where the package goes (default: build/lobelight.zip)
--no-library   without the native library: materials, environments and the ready tables work, baking does not
--all          with the libraries for Windows, macOS and Linux, each on x86-64 and arm64, which take long, the first time
--json FILE    the files, their sizes and the package's SHA-256

The package holds addons/lobelight as a project needs it: run time, editor scripts, ready tables, icons and the library
for this machine, or those for every desktop, with the licences of what is linked into them. One compiler, Zig's, which
is fetched, builds all of them: those for Linux run from glibc 2.28 on. The tables that they bake differ by roundings from
those of the library that ./dev builds with this machine's compiler. Equal sources give equal bytes.
USAGE
}

help_if_asked "$@"

need_python ""
export PYTHONDONTWRITEBYTECODE=1 LOBELIGHT_CWD=$PWD
tool=$ROOT/tools/package/package.py
# What is wrong with the options is said before anything is built.
"$PYTHON" "$tool" --check "$@"
options=(--downloads "$CACHE/downloads")
if [[ " $* " != *" --no-library "* ]]; then
  if [[ " $* " == *" --all "* ]]; then need_package_libraries --all; else need_package_libraries; fi
  options+=(--libraries "$ROOT/build/libraries" --zig "$ZIG_FOLDER" --interface "$GODOT_INTERFACE")
fi
exec "$PYTHON" "$tool" "${options[@]}" "$@"
