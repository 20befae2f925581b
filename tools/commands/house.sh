#!/usr/bin/env bash
# counts and draws who knows whom: cycles, files nobody refers to, the way of a lobe ([--draw] [--json FILE])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev house [--draw] [--json FILE]

Reads which file of the repository needs which: preloads, classes and base scripts of GDScript, includes of shaders and C++,
imports of Python, sources of shell scripts, resources of scenes. It prints
  the files that a lobe passes from a recipe to a pixel, and those that light passes from a sky to a pixel
  (tools/house/lobe_path.txt and light_path.txt, each step checked against who needs whom),
  files and lines by folder, the longest file,
  cycles, files that nobody refers to, and functions that nobody names. Who is called from outside is listed in
  tools/house/entries.txt.
It fails if there is one of these, if a way has a gap, or if what --draw writes is out of date.

--draw         draws docs/pictures/architecture.svg (boxes: tools/house/boxes.json), and writes the ways into
               docs/architecture.md
--json FILE    writes the figures to FILE
USAGE
}

help_if_asked "$@"
options=()
while (($# > 0)); do
  case $1 in
    --draw) options+=(--draw) ;;
    --json)
      [[ -n ${2:-} ]] || die "house: --json needs a file name"
      [[ -d $(dirname -- "$2") ]] || die "house: $2: its folder does not exist"
      options+=(--json "$2")
      shift
      ;;
    *) die "house: there is no option '$1'; house [--draw] [--json FILE]" ;;
  esac
  shift
done

need_packages
need_python ""
exec "$PYTHON" "$ROOT/tools/house/house.py" "${options[@]}"
