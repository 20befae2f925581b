#!/usr/bin/env bash
# ./dev test GROUP:SUITE: which file a name stands for, and after which changes resources are imported again.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/testing/single.sh
source "$ROOT/tools/testing/single.sh"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0

# expect NAME COMMAND…: one check, in a shell of its own.
expect() {
  local name=$1
  shift
  if ("$@") >"$work.log" 2>&1; then
    passed=$((passed + 1))
    echo "  $name: passed"
  else
    failed=$((failed + 1))
    echo "  $name: FAILED"
    sed 's/^/    | /' "$work.log"
  fi
  rm -f "$work.log"
}

# finds ARGUMENT FILE [TEST]
finds() {
  local group file test
  find_single "$1"
  echo "$file '$test'"
  [[ $file == "$2" && $test == "${3:-}" && $group == "${1%%:*}" ]]
}
expect "a suite of scripts" finds runtime:lobe_table tests/runtime/lobe_table_test.gd
expect "its whole name" finds runtime:lobe_table_test tests/runtime/lobe_table_test.gd
expect "one test of it" finds runtime:lobe_table:test_single_lobe tests/runtime/lobe_table_test.gd test_single_lobe
expect "a test by its short name" finds runtime:lobe_table:single_lobe tests/runtime/lobe_table_test.gd test_single_lobe
expect "C++" finds cpp:table_half_float gdextension/tests/table_half_float_test.cpp
expect "a part of a name with spaces" finds "cpp:table_half_float:come back: from" \
  gdextension/tests/table_half_float_test.cpp "come back: from"
expect "the editor's, without the library" finds editor:missing_library tests/editor/without_library/missing_library_test.gd
expect "of exports" finds export:diet tests/diet/diet_test.gd
expect "a command's" finds commands:package_tool tests/commands/package_tool_test.py
expect "errors of one command" finds commands:errors:bake tests/commands/errors_test.sh bake

# A small project in this one's place.
# shellcheck disable=SC2034 # named in the key
GODOT=/engine
ROOT=$work/project
mkdir -p "$ROOT"/{addons,tools,build}
printf 'class_name Lamp\nextends Node\n\nvar light := 1.0\n' >"$ROOT/addons/lamp.gd"
echo 'shader_type spatial;' >"$ROOT/addons/lamp.gdshader"
echo 'picture' >"$ROOT/addons/lamp.png"

# keeps COMMAND…: after COMMAND the imported resources are still what is wanted.
keeps() {
  local before
  before=$(resource_key)
  (cd "$ROOT" && "$@")
  [[ $(resource_key) == "$before" ]]
}
renews() {
  ! keeps "$@"
}
edit() {
  sleep 0.02
  sed -i "$2" "$1"
}
expect "a line of a script" keeps edit addons/lamp.gd 's/1.0/2.0/'
expect "a line of a shader" keeps edit addons/lamp.gdshader 's/$/ \/\/ lit/'
expect "tools" keeps touch tools/lamp.png
expect "the name of a class" renews edit addons/lamp.gd 's/Lamp/Sun/'
expect "what a class extends" renews edit addons/lamp.gd 's/extends Node/extends Node3D/'
expect "a picture" renews edit addons/lamp.png 's/picture/photograph/'
expect "a new script" renews touch addons/sun.gd
expect "a script that is gone" renews rm addons/sun.gd

echo "single: $passed passed, $failed failed"
((failed == 0))
