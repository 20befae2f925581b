#!/usr/bin/env bash
# Makes an empty project with the addon and the editor's suites in DIR and imports it: editor_project.sh DIR
#
# The addon is enabled by the suites, as a user does it: a new project knows its classes only after the first import.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "editor_project.sh takes a folder"
project=$1
need_engine
need_python ""

rm -rf "$project"
mkdir -p "$project/addons" "$project/.godot" "$project/tests"
"$PYTHON" "$ROOT/tests/editor/files.py" "$project/data"
cp -r "$ROOT/addons/lobelight" "$project/addons/lobelight"
cp -r "$ROOT/tools/gdunit_standin" "$project/addons/gdUnit4"
rm -rf "$project/addons/gdUnit4/.gdignore" "$project/addons/gdUnit4/selftest"
# Scripts without @tool do not run in the editor.
find "$project/addons/gdUnit4" -name '*.gd' -exec sed -i '1i @tool' {} +
cp -r "$ROOT/tests/editor/runner" "$project/addons/editor_tests"
cp -r "$ROOT/tests/editor" "$project/tests/editor"
rm -rf "$project/tests/editor/runner" "$project/addons/editor_tests/.gdignore"
cat >"$project/project.godot" <<PROJECT
config_version=5

[application]

config/name="Editor tests"
config/features=PackedStringArray("4.6")

[rendering]

renderer/rendering_method="gl_compatibility"
PROJECT
if compgen -G "$project/addons/lobelight/bin/*" >/dev/null; then
  echo "res://addons/lobelight/lobelight.gdextension" >"$project/.godot/extension_list.cfg"
else
  rm "$project/addons/lobelight/lobelight.gdextension"
fi
step "Importing the editor's project" "$GODOT" --headless --path "$project" --import
cat >>"$project/project.godot" <<PROJECT

[editor_plugins]

enabled=PackedStringArray("res://addons/editor_tests/plugin.cfg")
PROJECT
