#!/usr/bin/env bash
# Draws the pictures of demo/examples in docs/examples: examples.sh [FOLDER [EXAMPLE]]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

folder=$(realpath -m -- "${1:-$ROOT/docs/examples}")
only=()
[[ -z ${2:-} ]] || only=(--only "$2")
need_engine
need_python ""
need_library
need_import
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
step "Drawing the examples" godot_rendered mobile --script res://demo/commands/example_pictures.gd -- --out "$work" "${only[@]}"
mkdir -p "$folder"
"$PYTHON" "$ROOT/tools/guide/small_png.py" "$folder" "$work"/*.png
say "The pictures are in $folder"
