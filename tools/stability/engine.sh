#!/usr/bin/env bash
# Runs bake/stability/stability.gd: engine.sh RENDERER PROJECT ARGUMENTS…
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

renderer=$1
project=$2
shift 2
# The engine takes the last --path.
godot_rendered "$renderer" --path "$project" --no-header --script res://bake/stability/stability.gd -- "$@"
