#!/usr/bin/env bash
# Draws the picture for two eyes of docs/stereo.md: stereo.sh [FILE.png]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/stereo.sh
source "$ROOT/tools/lib/stereo.sh"

picture=$(realpath -m -- "${1:-$ROOT/docs/pictures/stereo.png}")
need_engine
need_python ""
need_library
need_stereo_project
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
step "Drawing for two eyes" godot_rendered mobile --path "$STEREO_PROJECT" \
  --script res://demo/commands/stereo_picture.gd -- --out "$work/$(basename "$picture")"
"$PYTHON" "$ROOT/tools/guide/small_png.py" "$(dirname "$picture")" "$work"/*.png
say "The picture is $picture"
