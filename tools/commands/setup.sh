#!/usr/bin/env bash
# gets everything the other commands need: packages, engine, libraries, Python tools, the extension
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 0)) || die "setup takes no arguments"

need_packages
need_engine
need_display
need_python
need_library
need_import
say "Everything is there. Engine: $GODOT ($(godot_version "$GODOT")); cache: $CACHE"
