#!/usr/bin/env bash
# Builds what ./dev fuzz and its tests run, the core with sanitizers: fuzz.sh lobelight_fuzz|lobelight_sanitized_tests…
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

need_packages
need_openexr
compile() {
  configure_native "$ROOT/build/cmake"
  cmake --build "$ROOT/build/cmake" --target "$@" --parallel "$JOBS"
}
mkdir -p "$ROOT/build/fuzz"
touch "$ROOT/build/.gdignore"
exec {lock}>"$ROOT/build/lock"
flock "$lock"
step "Building the core with sanitizers" compile "$@"
