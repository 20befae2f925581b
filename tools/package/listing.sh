#!/usr/bin/env bash
# Draws the icon of the Asset Library's listing from the plugin's own: listing.sh [FOLDER]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

folder=$(realpath -m -- "${1:-$ROOT/docs/listing}")
need_engine
mkdir -p "$folder"
"$GODOT" --headless --path "$ROOT/tools/package" --script "$ROOT/tools/package/draw_icon.gd" \
  -- "$ROOT/addons/lobelight/icons/lobelight.svg" "$folder/icon.png" 128 >&2
say "The icon is $folder/icon.png"
