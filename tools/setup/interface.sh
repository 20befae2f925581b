#!/usr/bin/env bash
# Has the engine write its C interface, gdextension_interface.h, into the cache: interface.sh STAMP
# STAMP then says which file it is. Engines with equal interfaces share one, so that nothing is built anew for them.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "interface.sh takes the stamp to write"
stamp=$1
need_engine
if [[ -f $stamp && -f $(<"$stamp") ]]; then
  exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The engine writes into the folder that it is started in.
dump_interface() {
  cd "$work"
  "$GODOT" --headless --dump-gdextension-interface
  [[ -s gdextension_interface.h ]]
}

step --advice "Does $GODOT run?" "Asking the engine for its C interface" dump_interface
folder=$CACHE/interface/$(content_hash "$work/gdextension_interface.h")
mkdir -p "$folder"
mv -f "$work/gdextension_interface.h" "$folder/gdextension_interface.h"
write_stamp "$stamp" "$folder/gdextension_interface.h"
