# shellcheck shell=bash
# The engine: which Godot is used, and how it is run headless and with a picture.

GODOT_WANTED=4.6
# Where Debian may have it, or still have it.
# shellcheck disable=SC2034 # used by tools/setup/engine.sh
GODOT_SUITES=(forky sid trixie-backports)

# godot_version PROGRAM: prints the version that PROGRAM reports, or nothing. A path that cannot run gives nothing.
godot_version() {
  "$1" --version 2>/dev/null </dev/null | tail -n 1 || true
}

# need_engine: sets and exports GODOT. Order: $GODOT, which may be later than the wanted version, then `godot` on PATH if it is the wanted version, then Debian's
# package unpacked in the cache. An engine that was looked at once is not asked again until its file changes.
need_engine() {
  [[ -z ${GODOT:-} || ${LOBELIGHT_ENGINE_READY:-} != "$GODOT" ]] || return 0
  local found=""
  if [[ -n ${GODOT:-} ]]; then
    found=$(command -v -- "$GODOT") || die "GODOT=$GODOT is not a program that can be run"
    godot_is_wanted "$found" later \
      || die "GODOT=$GODOT reports version '$(godot_version "$found")', but this project needs Godot $GODOT_WANTED or later"
  elif found=$(command -v godot) && godot_is_wanted "$found"; then
    :
  else
    found=$CACHE/engine/godot
    if [[ ! -x $found ]] || ! stamp_is "$CACHE/engine/key" "$(engine_key)"; then
      need_packages
      locked "$CACHE/lock/engine" bash "$ROOT/tools/setup/engine.sh"
    fi
  fi
  [[ $found == /* ]] || found=$PWD/$found
  GODOT=$found
  LOBELIGHT_ENGINE_READY=$GODOT
  export GODOT LOBELIGHT_ENGINE_READY
}

# engine_key: what the engine in the cache depends on; the cache's path is written into it.
engine_key() {
  echo "$(content_hash "$ROOT/tools/setup/engine.sh" "$ROOT/tools/lib/debian.sh") $CACHE"
}

# program_identity PROGRAM: prints what changes when the file does.
program_identity() {
  stat -L -c '%n %i %s %Y' -- "$1" | sha256sum | cut -c 1-16
}

# godot_is_wanted PROGRAM [later]: whether it is the wanted version or, with "later", that or a later 4.x. Remembers the answer
# under the file's identity, since asking an engine takes a while.
godot_is_wanted() {
  local stamp version
  stamp=$CACHE/engine-checks/$(program_identity "$1")${2:+-$2}
  if [[ ! -f $stamp ]]; then
    version=$(godot_version "$1")
    if [[ -n ${2:-} ]]; then
      [[ $version =~ ^4\.([0-9]+)\. ]] && ((BASH_REMATCH[1] >= ${GODOT_WANTED#4.})) || return 1
    else
      [[ $version == "$GODOT_WANTED".* ]] || return 1
    fi
    write_stamp "$stamp" "$1"
  fi
}

# need_display: what a rendered run needs: an X server of its own and software drivers, or the user's display and
# drivers (LOBELIGHT_DISPLAY=real).
need_display() {
  if [[ ${LOBELIGHT_DISPLAY:-own} == real ]]; then
    [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] \
      || die "LOBELIGHT_DISPLAY=real asks for your display, but neither DISPLAY nor WAYLAND_DISPLAY is set"
  else
    need_packages
    need_engine
    if [[ $GODOT != "$CACHE/engine/godot" && -n $(missing_packages "${DRIVER_PROBES[@]}") ]]; then
      install_packages "${DRIVER_PROBES[@]}"
    fi
  fi
}

# check_renderer COMMAND RENDERER: one sentence and the end if there is no such renderer.
check_renderer() {
  is_one_of "$2" mobile gl_compatibility forward_plus \
    || die "$1: there is no renderer '$2'; take mobile, gl_compatibility or forward_plus"
}

# godot_headless ARGS…: the engine in this project without a window or a renderer.
godot_headless() {
  need_engine
  "$GODOT" --headless --path "$ROOT" "$@"
}

# godot_rendered forward_plus|mobile|gl_compatibility ARGS…: the engine in this project, drawing with that renderer.
godot_rendered() {
  local renderer=$1
  local arguments=(--path "$ROOT" --audio-driver Dummy --rendering-method "$renderer")
  shift
  case $renderer in
    forward_plus | mobile) arguments+=(--rendering-driver vulkan) ;;
    gl_compatibility) arguments+=(--rendering-driver opengl3) ;;
    *) die "there is no renderer '$renderer'; take forward_plus, mobile or gl_compatibility" ;;
  esac
  need_engine
  need_display
  if [[ ${LOBELIGHT_DISPLAY:-own} == real ]]; then
    "$GODOT" "${arguments[@]}" "$@"
  else
    bash "$ROOT/tools/lib/with_display.sh" "$GODOT" "${arguments[@]}" "$@"
  fi
}
