#!/usr/bin/env bash
# loads the editor's library in an engine and bakes a small table with it ([--engine VERSION] [--package X.zip] [--json FILE]; also on macOS and Windows)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/portable.sh"

usage() {
  cat <<'USAGE'
usage: ./dev smoke [--engine VERSION] [--package X.zip] [--json FILE]

Puts the addon into an empty project, has the engine load the library and bake a table without a display, and looks whether
the table holds the light that it should. It says whether a library works on this system, not whether all of it does.

--engine VERSION  an official build of Godot, as ./dev engine downloads it
--package X.zip   the addon from what ./dev package wrote; otherwise from addons/lobelight, with the library in its bin/
--json FILE       what was checked

Without --engine, GODOT=PATH is the engine; on Linux ./dev gets one, and builds the library, where that is not set either.
USAGE
}

engine=""
package=""
json=""
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --engine)
      [[ -n ${2:-} ]] || die "smoke: --engine needs a version"
      engine=$2
      shift
      ;;
    --package)
      [[ -n ${2:-} ]] || die "smoke: --package needs a file"
      package=$(absolute_path "$2")
      [[ -f $package ]] || die "smoke: $2: there is no such file"
      shift
      ;;
    --json)
      [[ -n ${2:-} ]] || die "smoke: --json needs a file name"
      json=$(absolute_path "$2")
      [[ -d $(dirname -- "$json") ]] || die "smoke: $2: its folder does not exist"
      shift
      ;;
    *) die "smoke: there is no option '$1'" ;;
  esac
  shift
done

system=$(host_system)
library=$system.editor.$(host_architecture)
[[ -z $engine ]] || GODOT=$(bash "$ROOT/tools/commands/engine.sh" "$engine")
if [[ -z ${GODOT:-} && $system == linux ]]; then
  # shellcheck source=tools/lib/common.sh
  source "$ROOT/tools/lib/common.sh"
  need_engine
  [[ -n $package ]] || need_library
fi
[[ -n ${GODOT:-} ]] || die "smoke: say --engine 4.6, or set GODOT to the path of an engine"
command -v "$GODOT" >/dev/null || die "smoke: GODOT=$GODOT is not a program that can be run"

project=$(mktemp -d)
trap 'rm -rf "$project"' EXIT
mkdir -p "$project/.godot" "$project/addons"
if [[ -n $package ]]; then
  command -v unzip >/dev/null || die "smoke: unzip, which unpacks the package, is not installed"
  unzip -q "$package" -d "$project" || die "smoke: $package: cannot be unpacked"
else
  cp -R "$ROOT/addons/lobelight" "$project/addons/lobelight"
fi
libraries=("$project/addons/lobelight/bin/liblobelight.$library."*)
[[ -f ${libraries[0]} ]] || die "smoke: there is no library for $library in ${package:-addons/lobelight/bin}"
# Otherwise the first import aborts when it finds an extension that it did not know from the start.
echo "res://addons/lobelight/lobelight.gdextension" >"$project/.godot/extension_list.cfg"
printf 'config_version=5\n\n[application]\n\nconfig/name="Smoke"\nconfig/features=PackedStringArray("4.6")\n' \
  >"$project/project.godot"
cp "$ROOT/tools/smoke/smoke.gd" "$project/smoke.gd"

# smoke.gd names classes, which are known once the project has been imported.
cd "$project"
"$GODOT" --version || die "smoke: $GODOT does not run here"
"$GODOT" --headless --path . --import >"$project/import.log" 2>&1 || {
  tail -n 15 "$project/import.log" >&2
  die "smoke: the engine did not import the project"
}
status=0
"$GODOT" --headless --path . --script res://smoke.gd -- "$library" || status=$?
((status == 0)) || die "smoke: the library for $library does not work with this engine (status $status)"
if [[ -n $json ]]; then
  cp "$project/smoke.json" "$json.$$" || die "smoke: $json cannot be written"
  mv -f "$json.$$" "$json"
fi
