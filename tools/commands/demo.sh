#!/usr/bin/env bash
# draws the demo's pictures and measures them; --window opens it; --pictures DIR, --cost ([--env N] [--renderer R] [--out DIR])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/demo_tables.sh
source "$ROOT/tools/lib/demo_tables.sh"

ENVIRONMENTS=(hall sunset interior)
# What is measured: this recipe's BRDF with 8 lobes, on a sphere this many pixels wide.
MEASURED_RECIPE=brushed_ward
MEASURED_SIZE=128

usage() {
  cat <<USAGE
usage: ./dev demo [--env N] [--renderer R] [--out DIR] [--json FILE]
       ./dev demo --window [--renderer R]
       ./dev demo --pictures DIR [--renderer R]
       ./dev demo --cost [--out DIR]
       ./dev demo --engine-light FILE
       ./dev demo --engine-diffuse FILE [--renderer R]

--env N        only environment N: 1 hall, 2 sunset, 3 the interior, which is not measured
--renderer R   mobile (default), gl_compatibility or forward_plus
--out DIR      where the pictures go (default: build/demo)
--json FILE    writes what the closing table shows as JSON
--window       opens the demo on your display
--pictures DIR every environment by every method, landscape and portrait, and both with the controls: 36 pictures
--cost         what a frame asks of the shader units of two phones, from the compilers' statistics and the pixels that the
               demo's surfaces cover; README.md and results.json go to DIR (default: docs/report/demo-cost)
--engine-light FILE   draws one picture instead, in Forward+: what the engine's lights, fog, decals, reflection
               probes and VoxelGI make of a LobeMaterial3D (left) and of a StandardMaterial3D (right)
--engine-diffuse FILE   draws one picture instead: white things in SSAO, a LightmapGI, a VoxelGI, SDFGI and a
               ReflectionProbe with SSR, as far as the renderer has them, as LobeMaterial3Ds (above) and as
               StandardMaterial3Ds (below); prints how far the diffuse light of both is apart
USAGE
}

window=false
renderer=mobile
out=""
json=""
chosen=""
engine_light=""
engine_diffuse=""
all_pictures=""
cost=false
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --window) window=true ;;
    --cost) cost=true ;;
    --env | --renderer | --out | --json | --engine-light | --engine-diffuse | --pictures)
      [[ -n ${2:-} ]] || die "demo: $1 needs a value"
      case $1 in
        --env) chosen=$2 ;;
        --renderer) renderer=$2 ;;
        --out) out=$(realpath -m -- "$2") ;;
        --json) json=$(realpath -m -- "$2") ;;
        --pictures) all_pictures=$(realpath -m -- "$2") ;;
        --engine-light) engine_light=$(realpath -m -- "$2") ;;
        --engine-diffuse) engine_diffuse=$(realpath -m -- "$2") ;;
      esac
      shift
      ;;
    *) die "demo: there is no option '$1'; ./dev demo --help lists them" ;;
  esac
  shift
done
check_renderer demo "$renderer"
environments=("${ENVIRONMENTS[@]}")
if [[ -n $chosen ]]; then
  [[ $chosen =~ ^[1-9]$ && -n ${ENVIRONMENTS[chosen - 1]:-} ]] \
    || die "demo: --env takes a number from 1 to ${#ENVIRONMENTS[@]}, not '$chosen'"
  environments=("${ENVIRONMENTS[chosen - 1]}")
fi
[[ -z $json || -d $(dirname -- "$json") ]] || die "demo: $json: its folder does not exist"

# draw_pictures OPTION…
draw_pictures() {
  say "Drawing the demo (software renderers need some seconds a picture) …"
  LOBELIGHT_CWD=$PWD godot_rendered "$renderer" --no-header --script res://demo/commands/render_pictures.gd -- "$@"
}

# measure ENVIRONMENT: error and GPU time of the measured recipe, as ./dev compare has them.
measure() {
  local brdf alpha
  read -r brdf alpha < <("$PYTHON" "$ROOT/tools/demo/summary.py" recipe "$ROOT/bake/recipes/$MEASURED_RECIPE.json")
  say "Measuring 8 lobes against the reference in $1 …"
  bash "$ROOT/tools/commands/compare.sh" --env "$ROOT/demo/environments/$1.exr" --brdf "$brdf" --alpha "$alpha" \
    --methods gmm8 --size "$MEASURED_SIZE" --renderer "$renderer" --out "$out/compare_$1" \
    --json "$work/$1.json" >&2
}

need_engine
need_python
need_library
need_import
export LOBELIGHT_TERMINAL=0
if [[ -t 1 ]]; then LOBELIGHT_TERMINAL=1; fi

if $window; then
  export LOBELIGHT_DISPLAY=real
  need_display
  bake_demo_tables "${DEMO_SETS[@]}"
  godot_rendered "$renderer" res://demo/demo.tscn
  exit
fi

if [[ -n $all_pictures ]]; then
  mkdir -p "$all_pictures" || die "demo: $all_pictures: the folder cannot be made"
  bake_demo_tables thesis_8
  draw_pictures --out "$all_pictures" --all yes
  say "$all_pictures"
  exit
fi

if [[ -n $engine_light ]]; then
  godot_rendered forward_plus --no-header --script res://demo/commands/engine_light.gd -- --out "$engine_light"
  say "$engine_light"
  exit
fi

if [[ -n $engine_diffuse ]]; then
  godot_rendered "$renderer" --no-header --script res://demo/commands/engine_diffuse.gd -- --out "$engine_diffuse"
  say "$engine_diffuse"
  exit
fi

if $cost; then
  out=${out:-$ROOT/docs/report/demo-cost}
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  variants=$("$PYTHON" "$ROOT/tools/demo/cost.py" --variants)
  say "Counting instructions …"
  bash "$ROOT/tools/commands/mobile-cost.sh" --gpus adreno320,adreno630 --variants "$variants" \
    --json "$work/rows.json" --out "$work/mobile-cost" >&2
  say "Counting pixels …"
  godot_rendered gl_compatibility --no-header --script res://demo/commands/coverage.gd -- --out "$work/coverage.json"
  "$PYTHON" "$ROOT/tools/demo/cost.py" --rows "$work/rows.json" --coverage "$work/coverage.json" --out "$out"
  exit
fi

out=${out:-$ROOT/build/demo}
mkdir -p "$out" || die "demo: $out: the folder cannot be made"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
arguments=(--out "$out" --json "$work/pictures.json")
[[ -z $chosen ]] || arguments+=(--env "$chosen")
draw_pictures "${arguments[@]}"
for environment in "${environments[@]}"; do
  # Rooms are measured by ./dev compare --room.
  [[ $environment != interior ]] || continue
  measure "$environment"
done
"$PYTHON" "$ROOT/tools/demo/summary.py" table --pictures "$work/pictures.json" --measured "$work" \
  --recipe "$ROOT/bake/recipes/$MEASURED_RECIPE.json" --size "$MEASURED_SIZE" ${json:+--json "$json"}
