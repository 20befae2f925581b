#!/usr/bin/env bash
# How much bumpy metal flickers under a small sun: see usage().
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/rendered.sh"

usage() {
  cat <<USAGE
usage: ./dev bench flicker [--renderer R] [--roughness R] [--anisotropy A] [--texels T] [--slope S] [--size N]
                           [--frames N] [--json FILE]

How much a metal with a normal map flickers under a sky with a small bright sun while a camera moves slowly: the share of
the pixels of which a channel jumps by more than 60/255 from frame to frame, and the mean difference between frames. And
the PSNR to a picture with 64 samples a pixel of the material without antialiasing. Methods: Godot's StandardMaterial3D
(standard), and LobeMaterial3D without antialiasing, with it (antialiased), and with a baked normal variance texture (baked).
The truth is each renderer's own. With all renderers, the last line says whether, in each of them, the baked material has no
more pixels that jump and no larger mean difference than Godot's in Forward+, and 3 dB more than without; exits 1 if not.

--renderer R    mobile, gl_compatibility or forward_plus (default: one after the other)
--roughness R   0 to 1 (default 0.25)
--anisotropy A  -1 to 1 (default 0)
--texels T      of the normal map, along a pixel in the picture's middle (default 1.5)
--slope S       deviation of the bumps' slopes along each axis (default 0.4)
--size N        pixels a side (default 96)
--frames N      frames that are compared (default 5)
--json FILE     [{"renderer", "method", "roughness", "anisotropy", "jumping", "mean_difference", "psnr"}], a share, /255, dB
USAGE
}

help_if_asked "$@"
export LOBELIGHT_CWD=$PWD
json='' chosen='' arguments=()
while (($# > 0)); do
  case $1 in
    --json | --renderer)
      (($# > 1)) || die "bench flicker: $1 needs a value"
      if [[ $1 == --json ]]; then json=$2; else chosen=$2; fi
      shift
      ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
if [[ -n $chosen ]]; then
  [[ -z $json ]] || arguments+=(--json "$json")
  bench_rendered flicker res://bake/bench_flicker.gd --renderer "$chosen" "${arguments[@]}"
  exit
fi
parts=$(mktemp -d)
trap 'rm -rf "$parts"' EXIT
for renderer in forward_plus mobile gl_compatibility; do
  echo "$renderer:"
  bench_rendered flicker res://bake/bench_flicker.gd --renderer "$renderer" "${arguments[@]}" --json "$parts/$renderer.json"
done
python3 "$ROOT/tools/bench/flicker.py" "$parts" ${json:+"$json"}
