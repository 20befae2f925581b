#!/usr/bin/env bash
# Imports the project's resources and checks that every script compiles: import.sh
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

need_engine
if stamp_is "$ROOT/.godot/lobelight-import-key" "$(import_key)"; then
  exit 0
fi

import_resources() {
  "$GODOT" --headless --path "$ROOT" --import
}

# --import ends well with broken scripts in the project, so each script is loaded afterwards.
check_scripts() {
  "$GODOT" --headless --path "$ROOT" --script "$ROOT/tools/lib/check_scripts.gd"
}

step "Importing the project's resources" import_resources
step "Checking the project's scripts" check_scripts
# Only now, since the import itself writes .import and .uid files.
write_stamp "$ROOT/.godot/lobelight-import-key" "$(import_key)"
