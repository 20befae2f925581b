#!/usr/bin/env bash
# fits a BRDF by lobes in the C++ library and saves the table (--brdf --alpha AX,AY --lobes N --out X.res)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

need_engine
need_library
need_import
export LOBELIGHT_CWD=$PWD LOBELIGHT_TERMINAL=0
if [[ -t 1 ]]; then LOBELIGHT_TERMINAL=1; fi
godot_headless --no-header --script res://bake/bake.gd -- "$@"
