#!/usr/bin/env bash
# compares the reference integrator with SciPy's quadrature and with Mitsuba 3 ([--small] [--only CHECK,…] [--env X.exr]… [--json FILE])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev crosscheck [--small] [--only CHECK,…] [--env X.exr]… [--json FILE]

--small         fewer and smaller comparisons: about a minute
--only CHECK,…  of self, adaptive, cells, mitsuba and teapot (default: all)
--env X.exr     a panorama, instead of the demo's; may be given more than once
--json FILE     the results
USAGE
}

help_if_asked "$@"
need_native_tests
need_mitsuba
"$PYTHON" "$ROOT/tools/crosscheck/crosscheck.py" --tool "$ROOT/build/cmake/lobelight_reference" \
  --default-env "$ROOT/demo/environments/hall.exr" "$ROOT/demo/environments/sunset.exr" "$@"
