#!/usr/bin/env bash
# Draws what the Asset Store shows beside the guide's pictures, the icon and the clip: listing.sh [FOLDER]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

folder=$(realpath -m -- "${1:-$ROOT/docs/listing}")
need_engine
need_python ""
need_library
need_import
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$GODOT" --headless --path "$ROOT/tools/package" --script "$ROOT/tools/package/draw_icon.gd" \
  -- "$ROOT/addons/lobelight/icons/lobelight.svg" "$folder/icon.png" 128 >&2
step "Drawing the clip" godot_rendered mobile --no-header --script res://demo/commands/clip_frames.gd -- --out "$work"
"$PYTHON" "$ROOT/tools/package/clip.py" "$work" "$folder/turning.webp"
say "The icon and the clip are in $folder"
