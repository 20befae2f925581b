#!/usr/bin/env bash
# draws glTF's anisotropy, strengths, rotations and textures, and compares it with Mitsuba 3 ([--renderer R] [--out DIR] [--json FILE])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev crosscheck-gltf [--renderer R] [--out DIR] [--json FILE]

--renderer R  mobile (default), gl_compatibility or forward_plus
--out DIR     the pictures of both sides (otherwise they are not kept)
--json FILE   the results
USAGE
}

help_if_asked "$@"
renderer=mobile
out=""
json=""
while (($# > 0)); do
  case $1 in
    --renderer | --out | --json)
      (($# > 1)) || die "crosscheck-gltf: $1 needs a value"
      case $1 in
        --renderer) renderer=$2 ;;
        --out) out=$(realpath -m -- "$2") ;;
        --json) json=$(realpath -m -- "$2") ;;
      esac
      shift 2
      ;;
    *) die "crosscheck-gltf: there is no option '$1'; take --renderer, --out or --json" ;;
  esac
done
check_renderer crosscheck-gltf "$renderer"

need_engine
need_library
need_import
need_mitsuba
if [[ -z $out ]]; then
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
fi
mkdir -p "$out"
"$PYTHON" "$ROOT/tools/crosscheck/gltf.py" write "$out"
godot_rendered "$renderer" --no-header --script res://tools/crosscheck/gltf_pictures.gd -- --folder "$out" >/dev/null
"$PYTHON" "$ROOT/tools/crosscheck/gltf.py" judge "$out" --env "$ROOT/demo/environments/hall.exr" ${json:+--json "$json"}
