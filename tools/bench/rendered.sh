# shellcheck shell=bash
# What the benches of the run time have in common, to be sourced after their usage().

# bench_rendered NAME SCRIPT ARGUMENTS…: runs a script of bake/ in the renderer that --renderer names, mobile without it.
bench_rendered() {
  local name=$1 script=$2 renderer=mobile arguments=()
  shift 2
  while (($# > 0)); do
    if [[ $1 == --renderer ]]; then
      (($# > 1)) || die "bench $name: $1 needs a value"
      renderer=$2
      shift 2
    else
      arguments+=("$1")
      shift
    fi
  done
  check_renderer "bench $name" "$renderer"
  need_engine
  need_import
  export LOBELIGHT_CWD=$PWD
  godot_rendered "$renderer" --no-header --script "$script" -- "${arguments[@]}"
}
