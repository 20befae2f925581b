#!/usr/bin/env bash
# Makes the guide's clicks in the running editor, on a display of its own, and takes its pictures: pictures.sh [FOLDER [guide|hand|room]]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

folder=$(realpath -m -- "${1:-$ROOT/docs/guide/pictures}")
declare -A pages=([guide]=README.md [hand]=README.md [room]=rooms.md)
# How a page says the number of clicks.
declare -A words=([guide]="clicks" [hand]="clicks by hand" [room]="clicks")
walks=("${!pages[@]}")
if [[ -n ${2:-} ]]; then
  is_one_of "$2" "${walks[@]}" || die "pictures.sh: there is no walk '$2'; the walks are ${walks[*]}"
  walks=("$2")
fi
need_engine
need_python ""
need_library
need_display
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/pictures"

# go WALK: the clicks of a page, in a new project and an editor of its own.
go() {
  local walk=$1 project=$work/$1 clicks
  bash "$ROOT/tools/testing/editor_project.sh" "$project"
  rm -rf "$project"/{tests,addons/editor_tests,addons/gdUnit4}
  cp -r "$ROOT/tools/guide/camera" "$project/addons/guide_camera"
  sed -i 's|^enabled=.*|enabled=PackedStringArray("res://addons/guide_camera/plugin.cfg")|' "$project/project.godot"
  step "Making the clicks of docs/guide/${pages[$walk]}, $walk" timeout 600 bash "$ROOT/tools/lib/with_display.sh" "$GODOT" \
    --path "$project" --editor --audio-driver Dummy --rendering-method gl_compatibility --rendering-driver opengl3 \
    --single-window ++ --guide-pictures "$work/pictures" "$walk"
  clicks=$(<"$work/pictures/clicks")
  grep -q "^$clicks ${words[$walk]}\." "$ROOT/docs/guide/${pages[$walk]}" \
    || die "pictures.sh: it took $clicks clicks, which is not what docs/guide/${pages[$walk]} says"
}

for walk in "${walks[@]}"; do
  go "$walk"
done
mkdir -p "$folder"
# 256 colours are enough for the editor and a third of the size, but not for a large ball that mirrors a room.
"$PYTHON" - "$work/pictures" "$folder" <<'PYTHON'
import sys
from pathlib import Path

from PIL import Image

for picture in sorted(Path(sys.argv[1]).glob("*.png")):
    image = Image.open(picture)
    if not picture.stem.endswith("_ball"):
        image = image.quantize(256, dither=Image.Dither.NONE)
    image.save(Path(sys.argv[2]) / picture.name, optimize=True)
PYTHON
say "The pictures are in $folder"
