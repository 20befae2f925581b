#!/usr/bin/env bash
# Builds what ./dev fuzz runs: the file readers with sanitizers
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

need_packages
need_openexr
compile() {
  configure_native "$ROOT/build/cmake"
  cmake --build "$ROOT/build/cmake" --target lobelight_fuzz --parallel "$JOBS"
}
mkdir -p "$ROOT/build/fuzz"
touch "$ROOT/build/.gdignore"
exec {lock}>"$ROOT/build/lock"
flock "$lock"
step "Building the readers with sanitizers" compile
