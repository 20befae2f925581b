# shellcheck shell=bash
# gdUnit4: the real one where it is installed in addons/gdUnit4, otherwise this project's stand-in.

GDUNIT=$ROOT/addons/gdUnit4
# shellcheck disable=SC2034 # used by those who source this file
GDUNIT_TOOL=res://addons/gdUnit4/bin/GdUnitCmdTool.gd
GDUNIT_STANDIN=$ROOT/tools/gdunit_standin

# need_gdunit: copies the stand-in to addons/gdUnit4 unless gdUnit4 itself (it has a plugin.cfg) is there.
need_gdunit() {
  [[ ! -f $GDUNIT/plugin.cfg ]] || return 0
  local part
  mkdir -p "$GDUNIT"
  for part in bin src; do
    if ! diff --recursive --brief --exclude='*.uid' "$GDUNIT_STANDIN/$part" "$GDUNIT/$part" >/dev/null 2>&1; then
      rm -rf "${GDUNIT:?}/$part"
      cp -r "$GDUNIT_STANDIN/$part" "$GDUNIT/$part"
    fi
  done
}
