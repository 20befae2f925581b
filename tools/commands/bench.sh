#!/usr/bin/env bash
# measures the fit's speed, memory and error beside NumPy's and SciPy's ([--quick] [--only PART] [--json FILE] [--out DIR]); runtime: first light, updates and properties in a running game; rooms: what probes cost a frame; flicker: bumps under a small sun; light-formats: what saved light keeps
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

if [[ ${1:-} == runtime || ${1:-} == rooms || ${1:-} == flicker || ${1:-} == light-formats ]]; then
  part=$1
  shift
  exec bash "$ROOT/tools/bench/$part.sh" "$@"
fi

usage() {
  cat <<USAGE
usage: ./dev bench [--quick] [--only PART] [--json FILE] [--out DIR]
       ./dev bench runtime|rooms|flicker|light-formats [OPTIONS]

--quick       two slices and few settings: a minute
--only PART   rivals, curve or speed
--json FILE   all numbers
--out DIR     figures and data (default: build/bench)

runtime, rooms, flicker and light-formats measure other things; ./dev bench runtime --help, say, tells more.
USAGE
}

help_if_asked "$@"
BENCH_PROBES=("header benchmark/benchmark.h libbenchmark-dev")

need_packages
if [[ -n $(missing_packages "${BENCH_PROBES[@]}") ]]; then
  install_packages "${BENCH_PROBES[@]}"
fi
need_openexr
need_python bench
# In a folder of its own: here Google Benchmark must be found, elsewhere it need not be.
build=$ROOT/build/bench-cmake
locked "$ROOT/build/lock" bash "$ROOT/tools/setup/bench.sh" "$build"
export PYTHONDONTWRITEBYTECODE=1
exec "$PYTHON" "$ROOT/tools/bench/bench.py" --build "$build" "$@"
