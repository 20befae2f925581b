# shellcheck shell=bash
# Two eyes: the engine compiles its shaders for them only where a setting of the project says so, which this project's own
# does not, as every shader would be compiled twice.

STEREO_PROJECT=$ROOT/build/stereo

# need_stereo_project: this project with that setting, in $STEREO_PROJECT; all else in it are links.
need_stereo_project() {
  local entry
  need_import
  rm -rf "$STEREO_PROJECT"
  mkdir -p "$STEREO_PROJECT/build"
  for entry in addons bake demo tests .godot; do
    ln -s "$ROOT/$entry" "$STEREO_PROJECT/$entry"
  done
  # Where reports go.
  ln -s "$ROOT/build/test" "$STEREO_PROJECT/build/test"
  cp "$ROOT/project.godot" "$STEREO_PROJECT"
  printf '\n[xr]\n\nshaders/enabled=true\n' >>"$STEREO_PROJECT/project.godot"
}
