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

# expect_pack FILE OPTION…: checks the list of files in an exported pack; see tools/android/pack_files.py.
expect_pack() {
  "$PYTHON" "$ROOT/tools/android/pack_files.py" "$@"
}
