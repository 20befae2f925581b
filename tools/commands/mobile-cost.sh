#!/usr/bin/env bash
# counts what phones' GPUs execute a pixel, by their compilers, without a phone ([--gpus A,B] [--variants A,B] [--out DIR])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev mobile-cost [--gpus NAME,NAME…] [--variants NAME,NAME…] [OPTIONS]

--gpus N,N…      adreno320 (Compatibility), adreno630 and adreno740 (Mobile); mali-g52 and mali-g610 (Compatibility)
                 fetch 140 MB more (default: all)
--variants N,N…  of tools/mobile_cost/variants.json (default: all)
--again          measures what is known already, too
--json FILE      the rows there too
--out DIR        README.md, results.json, results.csv and cost.svg (default: docs/report/mobile-cost;
                 build/mobile-cost/report with --gpus or --variants)

Mesa's shader compilers run as on a phone, over a kernel that does nothing. A run that was stopped goes on: rows of
build/mobile-cost/rows.json that were measured with the same sources and compilers are kept. Takes some minutes.
USAGE
}

help_if_asked "$@"

need_python ""
export PYTHONDONTWRITEBYTECODE=1 LOBELIGHT_CWD=$PWD
tool=$ROOT/tools/mobile_cost/mobile_cost.py
# What is wrong with the options is said before anything is fetched; of the GPUs that are asked for, the families.
families=$("$PYTHON" "$tool" --families "$@")
need_python accuracy
for family in $families; do
  need_mobile_compilers "$family"
done
# The engine runs the project as the other commands have imported it.
GODOT=$MOBILE_ENGINE/godot
export GODOT
need_import
exec "$PYTHON" "$tool" "$@"
