#!/usr/bin/env bash
# compares the reference integrator with SciPy's quadrature and with Mitsuba 3 ([--small] [--only CHECK,…] [--env X.exr]… [--json FILE])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

# Mitsuba compiles through LLVM; what Debian bookworm's default, 14, and 15 make of its code does not run.
LLVM_PROBES=("file /usr/lib/*/libLLVM.so.19* libllvm19")
llvm=$(compgen -G "/usr/lib/*/libLLVM.so.[12][0-9].*" | sort -V | tail -n 1) || llvm=""
if [[ -z ${DRJIT_LIBLLVM_PATH:-}$llvm ]]; then
  install_packages "${LLVM_PROBES[@]}"
  llvm=$(compgen -G "/usr/lib/*/libLLVM.so.19*" | tail -n 1)
fi
export DRJIT_LIBLLVM_PATH=${DRJIT_LIBLLVM_PATH:-$llvm}

need_native_tests
need_python crosscheck
"$PYTHON" "$ROOT/tools/crosscheck/crosscheck.py" --tool "$ROOT/build/cmake/lobelight_reference" \
  --default-env "$ROOT/demo/environments/hall.exr" "$ROOT/demo/environments/sunset.exr" "$@"
