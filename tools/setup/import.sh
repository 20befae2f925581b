#!/usr/bin/env bash
# Imports the project's resources and, without --resources, checks that every script compiles: import.sh [--resources]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

resources_only=false
[[ ${1:-} != --resources ]] || resources_only=true
need_engine
if ! $resources_only && stamp_is "$ROOT/.godot/lobelight-import-key" "$(import_key)"; then
  exit 0
fi

import_resources() {
  "$GODOT" --headless --path "$ROOT" --import
}

# --import ends well with broken scripts in the project, so each script is loaded afterwards.
check_scripts() {
  "$GODOT" --headless --path "$ROOT" --script "$ROOT/tools/lib/check_scripts.gd"
}

if ! stamp_is "$ROOT/.godot/lobelight-resource-key" "$(resource_key)"; then
  step "Importing the project's resources" import_resources
  # Only now, since the import itself writes .import and .uid files.
  write_stamp "$ROOT/.godot/lobelight-resource-key" "$(resource_key)"
fi
! $resources_only || exit 0
step "Checking the project's scripts" check_scripts
write_stamp "$ROOT/.godot/lobelight-import-key" "$(import_key)"
