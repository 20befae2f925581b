#!/usr/bin/env bash
# Builds what ./dev bench runs: bench.sh BUILD_FOLDER
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "bench.sh takes the folder to build in"
build=$1
need_openexr

key="$(library_key) $(content_hash "$ROOT/tools/setup/bench.sh")"
if stamp_is "$build/lobelight-key" "$key"; then
  exit 0
fi
compile() {
  configure_native "$build"
  cmake --build "$build" --parallel "$JOBS" --target lobelight_speed lobelight_curve lobelight_fit_c
}
mkdir -p "$build"
touch "$ROOT/build/.gdignore"
step "Building the benchmarks" compile
write_stamp "$build/lobelight-key" "$key"
