#!/usr/bin/env bash
# Fetches Zig, a C++ compiler with the libraries of every desktop, into DIRECTORY: zig.sh DIRECTORY
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "zig.sh takes the directory to unpack into"
target=$1
[[ ! -f $target/complete ]] || exit 0
need_python ""

fetch() {
  "$PYTHON" -m pip install --disable-pip-version-check --no-deps --only-binary :all: --require-hashes \
    --target "$target" --requirement "$ROOT/tools/setup/zig.txt"
  "$target/ziglang/zig" version
}

rm -rf "$target"
mkdir -p "$target"
step --advice "Is the Python package index reachable?" "Fetching Zig, a compiler for every desktop (94 MB)" fetch
touch "$target/complete"
