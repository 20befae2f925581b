#!/usr/bin/env bash
# fits the ready tables over all widths ([--brdf ward|ward_bounded|ggx|charlie|coat|all] [--lobes N] [--out DIR] [--check])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev bake-tables [OPTIONS]

--brdf B       ward, ggx, charlie, coat (ggx of a clear coat's widths), ward_bounded, or all of them
               (default: all but the last, the ones that are shipped)
--lobes N      lobes for each view (default 8, charlie and coat 4)
--views T,P    elevations and azimuths of the view (default 16,8; charlie and coat 16,1)
--widths N     how many widths from 0.005 to 1 on each axis (default 21; charlie 10 from 0.04, coat 13 to 0.1)
--out DIR      where BRDF_LOBES.res goes, a LobeTableSet (default: the addon's tables)
--check        fits nothing new: fits every twelfth table of the sets in DIR again and compares the bytes
--threads N, --seed N
--json FILE    sizes, times and, with --check, what differs
USAGE
}

arguments=()
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --check) arguments+=(--check yes) ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

need_engine
need_library
need_import
export LOBELIGHT_CWD=$PWD LOBELIGHT_TERMINAL=0
if [[ -t 1 ]]; then LOBELIGHT_TERMINAL=1; fi
godot_headless --no-header --script res://bake/bake_tables.gd -- "${arguments[@]}"
