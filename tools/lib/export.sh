# shellcheck shell=bash
# What exporting commands and their tests share: an engine that must not complain, and what a pack may hold.

# quiet_engine COMMAND…: runs it with its output passed on; fails if it fails or has written an error or a warning.
quiet_engine() {
  local log status=0
  log=$(mktemp)
  "$@" 2>&1 </dev/null | tee "$log" || status=${PIPESTATUS[0]}
  if grep -aE '(^|[[:space:]])(SCRIPT |USER )?(ERROR|WARNING)(:|[[:space:]])|handle_crash|leaked at exit' "$log" >"$log.bad"; then
    say "$(head -n 1 "$log.bad")"
    ((status != 0)) || status=1
  fi
  rm -f "$log" "$log.bad"
  return "$status"
}

# prepare_export COMMAND OUT JSON: refuses paths that nothing can be written to, or makes the folder OUT and all that exports
# of the demo need. JSON may be empty. For those who also source demo_tables.sh.
prepare_export() {
  local command=$1 out=$2 json=$3
  [[ -z $json || -d $(dirname -- "$json") ]] || die "$command: $json: its folder does not exist"
  [[ ! -e $out || -d $out ]] || die "$command: $out is not a folder"
  need_engine
  need_python
  need_library
  need_import
  mkdir -p "$out" || die "$command: $out: the folder cannot be made"
  bake_demo_tables "${DEMO_SETS[@]}"
}

# What exports of the repository's project hold while they run: they share files in .godot.
# shellcheck disable=SC2034 # used by those who source this file
EXPORT_LOCK=$ROOT/.godot/export.lock

# expect_pack FILE OPTION…: checks the list of files in an exported pack; see tools/android/pack_files.py.
expect_pack() {
  "$PYTHON" "$ROOT/tools/android/pack_files.py" "$@"
}

# run_exported x86_64|arm64 PACK ARGUMENT…: an exported .pck with the engine's export template, headless and without
# anything else of the project; arm64 is emulated. Fails if the run fails or an error or a warning is written.
run_exported() {
  local architecture=$1 pack=$2 folder status=0 emulator=()
  shift 2
  need_template "$architecture"
  [[ $architecture == x86_64 ]] || emulator=("$TEMPLATE/root/qemu" -L "$TEMPLATE/root")
  folder=$(mktemp -d)
  # Debian's template runs the pack that lies beside it and has its name.
  cp "$TEMPLATE/root/usr/bin/godot-template-debug" "$folder/game"
  cp "$pack" "$folder/game.pck"
  (cd "$folder" && HOME=$folder quiet_engine "${emulator[@]}" ./game --headless "$@") || status=$?
  rm -rf "$folder"
  return "$status"
}
