#!/usr/bin/env bash
# What scripts take in each frame of a scene of many rooms: see usage().
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/rendered.sh"

usage() {
  cat <<USAGE
usage: ./dev bench rooms [--renderer R] [--probes N] [--meshes N] [--frames N] [--json FILE]

How many functions of the run time a frame calls, and how long they take, in a scene of LobeProbe3Ds and meshes with
LobeMaterial3Ds: while nothing moves, while a probe moves, and while one is captured. Medians over the frames.

--renderer R   mobile (default), gl_compatibility or forward_plus
--probes N     probes (default 16)
--meshes N     meshes, with 20 materials (default 200)
--frames N     frames that are measured in each state (default 100)
--json FILE    [{"renderer", "probes", "meshes", "state", "calls", "script_usec", "texture_mib"}], the last being what the
               scene's textures take, in MiB
USAGE
}

help_if_asked "$@"
bench_rendered rooms res://bake/bench_rooms.gd "$@"
