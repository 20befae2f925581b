#!/usr/bin/env bash
# gets everything the other commands need: packages, engine, libraries, Python tools, the extension
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev setup

Gets what the other commands need, into the cache and build/. They do so themselves; this does it beforehand.
USAGE
}

help_if_asked "$@"
(($# == 0)) || die "setup takes no arguments"

need_packages
need_engine
need_display
need_python
need_library
need_import
say "Everything is there. Engine: $GODOT ($(godot_version "$GODOT")); cache: $CACHE"
