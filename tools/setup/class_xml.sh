#!/usr/bin/env bash
# Has the engine write the class reference of the addon's scripts as XML to DIR: class_xml.sh DIR
#
# The scripts are read in a project of their own, without the native library, which need not be built for this.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "class_xml.sh takes a folder"
out=$1
key=$(class_xml_key)
if stamp_is "$out/key" "$key"; then
  exit 0
fi
need_engine
project=$(mktemp -d)
trap 'rm -rf "$project"' EXIT
mkdir -p "$project/addons/lobelight" "$project/user"
cp -r "$ROOT"/addons/lobelight/{runtime,icons,tables,lobelight.gdshaderinc} "$project/addons/lobelight"
cat >"$project/project.godot" <<PROJECT
config_version=5

[application]

config/name="Class reference"
config/features=PackedStringArray("4.6")

[rendering]

renderer/rendering_method="gl_compatibility"
PROJECT
export XDG_DATA_HOME=$project/user

write_xml() {
  "$GODOT" --headless --path "$project" --import
  rm -rf "$out"
  mkdir -p "$out"
  "$GODOT" --headless --path "$project" --doctool "$out" --gdscript-docs res://addons/lobelight
  compgen -G "$out/*.xml" >/dev/null
}
step "Reading the scripts' class reference" write_xml
write_stamp "$out/key" "$key"
