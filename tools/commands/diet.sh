#!/usr/bin/env bash
# reports what an export takes along of the addon, and why (SCENE|PROJECT [--json FILE]; --acceptance)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev diet SCENE|PROJECT [--target DB] [--json FILE]
       ./dev diet --acceptance [--quick] [--instructions] [--out DIR] [--json FILE]

SCENE           a .tscn or .scn with all that it depends on
PROJECT         a folder with a project.godot and this addon: all its files
--target DB     materials get the fewest lobes that have this PSNR, as with the preset's "Lobelight > Target Psnr"
--json FILE     the same as numbers
--acceptance    exports some scenes with all of the addon and with what they need of it, and compares their pictures
--quick         draws most of them in Compatibility alone, as ./dev test does; writes no report
--instructions  also counts what phones' GPUs execute a pixel, as ./dev mobile-cost does (fetches compilers once)
--out DIR       where README.md and results.json of the acceptance go (docs/report/diet)

Exports leave out sets of tables that nothing uses, and of the others the tables that materials cannot reach; the
preset's option "Lobelight > Cut Tables" turns that off. This says what they would do. Scenes and resources are looked
through; numbers that scripts assign to roughness, anisotropy and the clear coat's count; what else scripts do with
them is not known, and then all widths stay, unless the root of a scene says what its scripts reach, by the metadata
"lobelight_reach": {"roughness": [0.2, 0.5], "anisotropy": [0.0, 0.9]}. Only materials whose widths no script changes can
get fewer lobes; the metadata "lobelight_fixed": true of a material says so of it.

Scripts and shaders of features that nothing reaches stay out as well; what a script so much as names is reached, and so is
what a root's metadata "lobelight_features" lists. Environments of automatic size and panoramas that they alone show get
the texels that the sharpest lobe needs; "Lobelight > Fit Environments" turns that off.
USAGE
}

help_if_asked "$@"
subject=""
json=""
acceptance=false
options=()
target=""
while (($# > 0)); do
  case $1 in
    --json | --out)
      [[ -n ${2:-} ]] || die "diet: $1 needs a value"
      path=$(realpath -m -- "$2")
      if [[ $1 == --json ]]; then json=$path; else options+=(--out "$path"); fi
      shift
      ;;
    --target)
      [[ ${2:-} =~ ^[0-9]+(\.[0-9]+)?$ ]] || die "diet: --target needs a number of decibels, not '${2:-}'"
      target=$2
      shift
      ;;
    --acceptance) acceptance=true ;;
    --quick) options+=(--quick) ;;
    --instructions) options+=(--instructions) ;;
    -*) die "diet: there is no option '$1'; ./dev diet --help lists them" ;;
    *)
      [[ -z $subject ]] || die "diet: one scene or project at a time, not '$1' too"
      subject=$(realpath -m -- "$1")
      ;;
  esac
  shift
done
[[ -z $json || -d $(dirname -- "$json") ]] || die "diet: $json: its folder does not exist"

if $acceptance; then
  [[ -z $target ]] || die "diet: --target goes with a scene or a project"
  if is_one_of --quick "${options[@]}" && is_one_of --out "${options[@]}"; then
    die "diet: --quick draws too little for a report, so --out does not go with it"
  fi
  [[ -z $subject ]] || die "diet: --acceptance has its own scenes, '$subject' is one too many"
  need_engine
  need_python accuracy
  need_library
  need_display
  if [[ " ${options[*]} " == *" --instructions "* ]]; then
    need_mobile_compilers adreno
    need_import
  fi
  [[ -z $json ]] || options+=(--json "$json")
  exec "$PYTHON" "$ROOT/tools/diet/acceptance.py" --work "$ROOT/build/diet" "${options[@]}"
fi

((${#options[@]} == 0)) || die "diet: ${options[0]} goes with --acceptance"
[[ -n $subject ]] || die "diet: which scene or project? ./dev diet SCENE|PROJECT"
[[ -e $subject ]] || die "diet: $subject does not exist"

# The project that the scene, or the folder, is in.
project=$subject
[[ -d $project ]] || project=$(dirname "$project")
while [[ ! -f $project/project.godot ]]; do
  [[ $project != / ]] || die "diet: $subject is in no project: there is no project.godot above it"
  project=$(dirname "$project")
done
arguments=()
if [[ -f $subject ]]; then
  [[ $subject == *.tscn || $subject == *.scn ]] || die "diet: $subject is not a scene (.tscn, .scn)"
  arguments+=(--scene "res://${subject#"$project/"}")
elif [[ $subject != "$project" ]]; then
  die "diet: $subject has no project.godot"
fi
[[ -z $target ]] || arguments+=(--target "$target")
[[ -z $json ]] || arguments+=(--json "$json")
script=addons/lobelight/editor/export/diet_command.gd
[[ -f $project/$script ]] || die "diet: $project does not have this addon in addons/lobelight"

need_engine
if [[ $project -ef $ROOT ]]; then
  [[ -z $target ]] || need_library
  need_import
elif [[ ! -f $project/.godot/global_script_class_cache.cfg ]]; then
  die "diet: $project has not been opened in the editor yet"
fi
"$GODOT" --headless --no-header --path "$project" --script "res://$script" -- "${arguments[@]}"
