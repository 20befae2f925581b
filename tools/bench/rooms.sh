#!/usr/bin/env bash
# What scripts take in each frame of a scene of many rooms: see usage().
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

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
renderer=mobile
arguments=()
while (($# > 0)); do
  if [[ $1 == --renderer ]]; then
    (($# > 1)) || die "bench rooms: $1 needs a value"
    renderer=$2
    shift 2
  else
    arguments+=("$1")
    shift
  fi
done
case $renderer in
  mobile | gl_compatibility | forward_plus) ;;
  *) die "bench rooms: there is no renderer '$renderer'; take mobile, gl_compatibility or forward_plus" ;;
esac

need_engine
need_import
export LOBELIGHT_CWD=$PWD
godot_rendered "$renderer" --no-header --script res://bake/bench_rooms.gd -- "${arguments[@]}"
