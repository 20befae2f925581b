#!/usr/bin/env bash
# packs the addon, with the editor's library, into the zip that is unpacked into a project ([--out X.zip] [--all])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev package [--out X.zip] [--json FILE]

--out X.zip    where the package goes (default: build/lobelight.zip)
--no-library   without the native library: materials, environments and the ready tables work, baking does not
--all          with the libraries for every desktop; not available yet
--json FILE    the files, their sizes and the package's SHA-256

The package holds addons/lobelight as a project needs it: run time, editor scripts, ready tables, icons and the library
for this machine with the licences of what is linked into it. Equal sources give equal bytes.
USAGE
}

help_if_asked "$@"

need_python ""
export PYTHONDONTWRITEBYTECODE=1 LOBELIGHT_CWD=$PWD
tool=$ROOT/tools/package/package.py
# What is wrong with the options is said before anything is built.
"$PYTHON" "$tool" --check "$@"
if [[ " $* " != *" --no-library "* ]]; then
  need_library
fi
exec "$PYTHON" "$tool" --downloads "$CACHE/downloads" "$@"
