#!/usr/bin/env bash
# What the addon costs in a running game: see usage().
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/rendered.sh"

# Memory first, while no table has been loaded.
PARTS=memory,first-light,updates,idle,properties,shaders

usage() {
  cat <<USAGE
usage: ./dev bench runtime [--renderer R] [--what PART,…] [--scale N] [--rounds N] [--json FILE]
       ./dev bench runtime --out DIR [--renderer R] [--what PART,…] [--scale N] [--rounds N]

What the addon costs in a running game, each beside something ordinary of the same run. LOBELIGHT_DISPLAY=real measures
your own GPU.

  first-light   the first light of a panorama of 1024 x 512 texels, in frames of 1280 x 720 that eight lobes light; and
                the longest single frame of it
  updates       times of the GPU for an update of a pyramid of 256 texels and for such a frame, for each filter, in turns
  idle          what the scripts of one environment take in a frame in which nothing changes
  properties    setting a property of 100 materials in each frame, beside the same of StandardMaterial3D
  memory        what the light of a panorama of 2048 x 1024 texels takes, live and baked, and a material's tables
  shaders       shaders and pipelines of a scene's materials, and the time until they are made, beside StandardMaterial3D

Ratios are medians over the rounds.

--renderer R   mobile (default), gl_compatibility or forward_plus; with --out all three
--what PART,…  of the above (default updates; with --out all)
--scale N      divides the sides of pictures and maps, for software drivers (default 1)
--rounds N     rounds (default 8)
--json FILE    a list with an object for each measurement. Without --what: [{"renderer", "filter", "size", "frame", "rounds",
               "update_gpu_ms", "update_cpu_ms", "frame_gpu_ms", "update_frames_ratio"}], the ratio being the median of
               each round's. With --what each object also says "what" part it belongs to
--out DIR      measures and writes README.md, results.json and runtime.svg there
USAGE
}

help_if_asked "$@"
out="" what="" renderers=() arguments=()
while (($# > 0)); do
  case $1 in
    --out | --what | --renderer)
      [[ -n ${2:-} ]] || die "bench runtime: $1 needs a value"
      case $1 in
        --out) out=$2 ;;
        --what) what=$2 ;;
        --renderer) renderers=("$2") ;;
      esac
      shift
      ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
if ((${#renderers[@]} == 0)); then
  renderers=(mobile)
  [[ -z $out ]] || renderers+=(forward_plus gl_compatibility)
fi

# What is compiled is compiled here, whatever ran before.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_DATA_HOME=$scratch MESA_SHADER_CACHE_DISABLE=true

if [[ -z $out ]]; then
  [[ -z $what ]] || arguments+=(--what "$what")
  bench_rendered runtime res://bake/bench_runtime.gd --renderer "${renderers[0]}" "${arguments[@]}"
  exit
fi

is_one_of --json "${arguments[@]}" && die "bench runtime: --out writes results.json itself, leave --json out"
mkdir -p "$out" || die "bench runtime: --out $out cannot be made"
need_python bench
results=()
for renderer in "${renderers[@]}"; do
  results+=("$scratch/$renderer.json")
  bench_rendered runtime res://bake/bench_runtime.gd --renderer "$renderer" --what "${what:-$PARTS}" --json "${results[-1]}" \
    "${arguments[@]}"
done
PYTHONDONTWRITEBYTECODE=1 "$PYTHON" "$ROOT/tools/bench/runtime_report.py" --out "$out" "${results[@]}"
