#!/usr/bin/env bash
# What updates of an environment cost beside a frame: see usage().
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev bench runtime [--renderer R] [--scale N] [--rounds N] [--json FILE]

Times of the GPU for an update of a pyramid of 256 texels and for a frame of 1280 x 720 that eight lobes light, for each
filter, in turns; medians over the rounds. LOBELIGHT_DISPLAY=real measures your own GPU.

--renderer R   mobile (default), gl_compatibility or forward_plus
--scale N      divides the sides of both, for software drivers (default 1)
--rounds N     rounds of an update and three frames (default 8)
--json FILE    [{"renderer", "filter", "size", "frame", "rounds", "update_gpu_ms", "update_cpu_ms", "frame_gpu_ms",
               "update_frames_ratio"}], the ratio being the median of each round's
USAGE
}

help_if_asked "$@"
renderer=mobile
arguments=()
while (($# > 0)); do
  if [[ $1 == --renderer ]]; then
    (($# > 1)) || die "bench runtime: $1 needs a value"
    renderer=$2
    shift 2
  else
    arguments+=("$1")
    shift
  fi
done
case $renderer in
  mobile | gl_compatibility | forward_plus) ;;
  *) die "bench runtime: there is no renderer '$renderer'; take mobile, gl_compatibility or forward_plus" ;;
esac

need_engine
need_import
export LOBELIGHT_CWD=$PWD
godot_rendered "$renderer" --no-header --script res://bake/bench_runtime.gd -- "${arguments[@]}"
