#!/usr/bin/env bash
# The package as a user meets it: unpacked into an empty project, the plugin switched on in the editor, a frame drawn, a
# pack exported and run, a table baked. No step may write an error or a warning.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/lib/common.sh"
# shellcheck source=tools/lib/export.sh
source "$ROOT/tools/lib/export.sh"

need_engine
need_python
need_library
need_display
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
project=$work/project
package=$work/lobelight.zip
passed=0
failed=0

# expect NAME COMMAND…: one check; its output is shown only when it fails. `set -e` is off inside COMMAND.
expect() {
  local name=$1 started=$SECONDS
  shift
  if "$@" >"$work/check.log" 2>&1; then
    passed=$((passed + 1))
    echo "  $name: passed ($((SECONDS - started)) s)"
  else
    failed=$((failed + 1))
    echo "  $name: FAILED"
    grep -avE '\[1m(savepack|savezip)' "$work/check.log" | tail -n 40 | sed 's/^/    | /'
  fi
}

# in_project ENGINE_ARGUMENT…: headless, with a clean log.
in_project() {
  quiet_engine "$GODOT" --headless --path "$project" "$@"
}

# In a project that is new to it the engine writes its documentation on a thread, and aborts if it has to end before
# that has (godotengine/godot#111048): so the first time it is open for twelve seconds.
open_first() {
  in_project --editor --frame-delay 50 --quit-after 240
}

# In a project that no editor has opened, as README says.
import_first() {
  local line
  # shellcheck disable=SC2016 # the quotes are README's
  line=$(sed -n 's/^ *`\(mkdir -p \.godot && .*\)`$/\1/p' "$ROOT/README.md")
  cp -r "$project" "$work/imported" \
    && [[ $line == *"godot --headless --import" ]] \
    && (cd "$work/imported" && eval "${line% && godot --headless --import}") \
    && quiet_engine "$GODOT" --headless --path "$work/imported" --import
}

open_editor() {
  in_project --editor --quit-after 60
}

same_bytes() {
  bash "$ROOT/tools/commands/package.sh" --out "$work/again.zip" && cmp "$package" "$work/again.zip"
}

# Everything in the zip is of the addon, and nothing is that belongs to the repository only.
only_the_addon() {
  local names
  names=$("$PYTHON" -c 'import sys, zipfile; print(*zipfile.ZipFile(sys.argv[1]).namelist(), sep="\n")' "$package")
  grep -qx 'addons/lobelight/runtime/material/lobe_material_3d.gd' <<<"$names" \
    && grep -qx 'addons/lobelight/lobelight.gdshaderinc' <<<"$names" \
    && grep -qx 'addons/lobelight/bin/LICENCES.txt' <<<"$names" \
    && ! grep -vE '^addons/lobelight/(runtime|editor|tables|icons|bin)/|^addons/lobelight/[^/]+$' <<<"$names" \
    && ! grep -E '_test\.gd|doc_classes|\.o$' <<<"$names"
}

# What an archive of the repository unpacks, which asset libraries offer: the addon without the library and what names it.
archive_is_an_addon() {
  local names
  names=$(git -C "$ROOT" archive --worktree-attributes HEAD | tar --list) \
    && grep -qx 'addons/lobelight/runtime/material/lobe_material_3d.gd' <<<"$names" \
    && ! grep -vE '^addons/$|^addons/lobelight/' <<<"$names" \
    && ! grep -E '\.gdextension|doc_classes|/bin/' <<<"$names"
}

# What the README promises: Debian 10, RHEL 8. Nothing of the compiler's own C++ library is asked of the system.
needs_an_old_system() {
  "$PYTHON" - "$package" <<'PYTHON_END'
import re
import sys
import zipfile

package = zipfile.ZipFile(sys.argv[1])
libraries = [name for name in package.namelist() if name.endswith(".so")]
for name in libraries:
    library = package.read(name)
    versions = sorted({tuple(map(int, version.split(b"."))) for version in re.findall(rb"\0GLIBC_([\d.]+)\0", library)})
    print(name, versions, "GLIBCXX" if b"GLIBCXX_" in library else "")
    if not versions or versions[-1] > (2, 28) or b"GLIBCXX_" in library or b"libstdc++.so" in library:
        sys.exit(1)
sys.exit(not libraries)
PYTHON_END
}

unpack() {
  cp -r "$ROOT/tests/commands/new_project" "$project" && rm "$project/.gdignore" \
    && mv "$project/project.template" "$project/project.godot" \
    && "$PYTHON" -c 'import sys, zipfile; zipfile.ZipFile(sys.argv[1]).extractall(sys.argv[2])' "$package" "$project"
}

# What the tick in Project > Project Settings > Plugins writes.
enable_plugin() {
  printf '\n[editor_plugins]\n\nenabled=PackedStringArray("res://addons/lobelight/plugin.cfg")\n' \
    >>"$project/project.godot"
  open_editor
}

draw() {
  quiet_engine bash "$ROOT/tools/lib/with_display.sh" "$GODOT" --path "$project" --audio-driver Dummy \
    --rendering-driver vulkan -- "$1"
}

# Two balls that the sky lights: they differ from each other and from the sky.
shows_balls() {
  "$PYTHON" - "$1" <<'PYTHON_END'
import sys

import numpy as np
from PIL import Image

picture = np.asarray(Image.open(sys.argv[1]).convert("RGB"), dtype=float)
height, width, _ = picture.shape
left, right = picture[:, : width // 2], picture[:, width // 2 :][:, ::-1]
print("spread", picture.std(), "difference of the halves", np.abs(left - right).mean())
sys.exit(0 if picture.std() > 10 and np.abs(left - right).mean() > 1 else 1)
PYTHON_END
}

# Two balls of one roughness reach a few of the set's widths; nothing reaches the other set.
export_and_list() {
  local pack=$work/$2
  in_project --export-pack "$1" "$pack" || return 1
  shift 2
  expect_pack "$pack" "$@" --absent bake.gd --absent '*/ward_8.res' --sizes "$work/sizes.json" \
    && "$PYTHON" -c 'import json, sys; sys.exit(json.load(open(sys.argv[1]))["tables"] > 600000)' "$work/sizes.json"
}

# The pack alone, in an empty folder, draws what the project drew with all its tables.
run_pack() {
  mkdir -p "$work/run" \
    && cp "$work/Linux.pck" "$work/run/game.pck" \
    && (cd "$work/run" && quiet_engine bash "$ROOT/tools/lib/with_display.sh" "$GODOT" --main-pack game.pck \
      --audio-driver Dummy --rendering-driver vulkan -- "$work/pack.png" | tee "$work/run.log") \
    && grep -qx "main: ready set, 12 frames" "$work/run.log"
}

same_picture() {
  "$PYTHON" - "$work/ready.png" "$work/pack.png" <<'PYTHON_END'
import sys

import numpy as np
from PIL import Image

LEAST_PSNR = 45.0
one, other = (np.asarray(Image.open(file).convert("RGB"), dtype=float) / 255.0 for file in sys.argv[1:])
error = float(np.mean((one - other) ** 2))
psnr = -10.0 * np.log10(max(error, 1e-10))
print("PSNR", psnr)
sys.exit(0 if psnr >= LEAST_PSNR else 1)
PYTHON_END
}

# The same table, but for roundings of exponentials and the like, from the library that this machine's compiler builds and
# with which everything else is tested: no entry, slope, logarithm or weight, further away than 0.02.
same_table() {
  mv "$project/brushed.res" "$project/packaged.res" \
    && cp "$ROOT"/addons/lobelight/bin/liblobelight.* "$project/addons/lobelight/bin" \
    && in_project --script res://bake.gd || return 1
  cat >"$project/compare.gd" <<'SCRIPT_END'
extends SceneTree

func _initialize() -> void:
	var tables: Array[LobeTable] = [load("res://packaged.res"), load("res://brushed.res")]
	var size := tables[0].image.get_size()
	var furthest := INF if size != tables[1].image.get_size() else 0.0
	for y in size.y if furthest == 0.0 else 0:
		for x in size.x:
			var apart := tables[0].image.get_pixel(x, y) - tables[1].image.get_pixel(x, y)
			for channel in 4:
				furthest = maxf(furthest, absf(apart[channel]))
	print("furthest: ", furthest)
	quit(0 if furthest < 0.02 else 1)
SCRIPT_END
  in_project --script res://compare.gd || return 1
  rm -f "$project"/{compare.gd,packaged.res}*
}

make_package() {
  bash "$ROOT/tools/commands/package.sh" --out "$package"
}

expect "a package" make_package
expect "equal bytes on the second run" same_bytes
expect "the addon and nothing else" only_the_addon
if [[ -e $ROOT/.git ]]; then
  expect "an archive of the repository is the addon, too" archive_is_an_addon
fi
expect "the library runs on systems with glibc 2.28" needs_an_old_system
expect "unpacked" unpack
expect "a first import from the command line" import_first
expect "the editor opens" open_first
expect "the plugin is switched on" enable_plugin
expect "a frame with the ready tables" draw "$work/ready.png"
expect "it shows two balls" shows_balls "$work/ready.png"
expect "a pack for Linux" export_and_list Linux Linux.pck --absent brushed.res
expect "the pack runs" run_pack
expect "with a part of the tables, it draws the same" same_picture
expect "a table is baked" in_project --script res://bake.gd
expect "another compiler's library bakes the same" same_table
expect "a pack for Android" export_and_list Android Android.zip --present brushed.res
expect "the list of extensions is as before" grep -qx 'res://addons/lobelight/lobelight.gdextension' \
  "$project/.godot/extension_list.cfg"
echo "export-package: $passed passed, $failed failed"
((failed == 0))
