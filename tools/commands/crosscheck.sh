#!/usr/bin/env bash
# compares the reference integrator with SciPy's quadrature and with Mitsuba 3 ([--small] [--only CHECK,…] [--env X.exr]… [--json FILE])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

need_native_tests
need_mitsuba
"$PYTHON" "$ROOT/tools/crosscheck/crosscheck.py" --tool "$ROOT/build/cmake/lobelight_reference" \
  --default-env "$ROOT/demo/environments/hall.exr" "$ROOT/demo/environments/sunset.exr" "$@"
