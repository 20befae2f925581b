#!/usr/bin/env bash
# checks that the version is ready and makes the files of its release ([--check] [--no-library] [--out DIR] [--json FILE])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/export.sh
source "$ROOT/tools/lib/export.sh"

usage() {
  cat <<USAGE
usage: ./dev release [--check | --no-library] [--out DIR] [--json FILE]

Checks that the version in addons/lobelight/plugin.cfg is the one that everything names, that CHANGELOG.md has its section
with a date, that the licences and what the Asset Store shows are there, and that no file is too large. Then it builds the
documentation and the package with the libraries for six systems, looks at what is in it, switches the plugin on in an empty
project, and writes to DIR, V being the version:

  lobelight-V.zip           to be unpacked into a project
  lobelight-V-store.zip     the same below one folder, which the editor takes off what it gets from the Asset Store
  lobelight-V-listing.zip   what the Asset Store shows: texts, icon, clip, pictures
  lobelight-V-notes.md      the version's section of CHANGELOG.md
  SHA256SUMS                of these

Equal sources give equal bytes. Files that are not committed yet are packed as they are, and it is said how many.

--check        the checks that need no package; nothing is written
--no-library   for a try: the package without libraries, and no documentation
--out DIR      where the files go (default: build/release; with --no-library build/release-try)
--json FILE    version, commit, files that are not committed, the checks that were made, and the files with their SHA-256
USAGE
}

help_if_asked "$@"

need_python ""
export PYTHONDONTWRITEBYTECODE=1 LOBELIGHT_CWD=$PWD
tool=$ROOT/tools/release/release.py
# What is wrong with the options or the sources is said before anything is built.
"$PYTHON" "$tool" --options "$@"
if is_one_of --check "$@"; then
  exec "$PYTHON" "$tool" "$@"
fi
"$PYTHON" "$tool" --look "$@"

need_engine
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
which_package=(--all)
done_here="plugin"
if is_one_of --no-library "$@"; then
  which_package=(--no-library)
elif [[ -f $ROOT/tools/commands/docs.sh ]]; then
  bash "$ROOT/tools/commands/docs.sh" >&2
  done_here+=" docs"
fi
bash "$ROOT/tools/commands/package.sh" "${which_package[@]}" --out "$work/package.zip" >&2

# An editor that opens a project for the first time writes its documentation on a thread, and must not end before that has
# (godotengine/godot#111048): so it is open for twelve seconds.
load_plugin() {
  cp -r "$ROOT/tests/commands/new_project" "$work/project"
  rm "$work/project/.gdignore"
  mv "$work/project/project.template" "$work/project/project.godot"
  "$PYTHON" -c 'import sys, zipfile; zipfile.ZipFile(sys.argv[1]).extractall(sys.argv[2])' "$work/package.zip" \
    "$work/project"
  quiet_engine "$GODOT" --headless --path "$work/project" --editor --frame-delay 50 --quit-after 240
  printf '\n[editor_plugins]\n\nenabled=PackedStringArray("res://addons/lobelight/plugin.cfg")\n' \
    >>"$work/project/project.godot"
  quiet_engine "$GODOT" --headless --path "$work/project" --editor --quit-after 60
}

step "The plugin is switched on in an empty project" load_plugin
"$PYTHON" "$tool" --pack "$work/package.zip" --done "$done_here" "$@"
