#!/usr/bin/env bash
# What updates of an environment cost beside a frame: see usage().
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/rendered.sh"

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
bench_rendered runtime res://bake/bench_runtime.gd "$@"
