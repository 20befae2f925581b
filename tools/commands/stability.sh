#!/usr/bin/env bash
# runs the fitter and the shaders on their hardest input against 50 digits ([--quick] [--json FILE] [--out DIR])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev stability [--quick] [--json FILE] [--out DIR] [--group G]…

--quick      the reduced set that ./dev test runs; writes no report
--json FILE  {"cases": [{"name", "group", "finite", "within_energy_bound", "error", "iterations", …}]};
             those of shaders have "renderer" and "precision" ("single", or "half": mediump rounded as on phones)
--out DIR    where the tables and heat maps go (default: docs/report/stability)
--group G    only this group: gaussian, brdf, step, slice, data, table or shader; writes no report

The last line is "stability: N passed, N failed"; the exit status is 1 if a case failed.
USAGE
}

out=$ROOT/docs/report/stability
arguments=()
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --quick) arguments+=(--quick) ;;
    --json | --out | --group)
      [[ -n ${2:-} ]] || die "stability: $1 needs a value"
      case $1 in
        --json)
          [[ -d $(dirname -- "$2") ]] || die "stability: $2: its folder does not exist"
          arguments+=(--json "$2")
          ;;
        --out) out=$2 ;;
        --group)
          [[ " gaussian brdf step slice data table shader " == *" $2 "* ]] \
            || die "stability: there is no group '$2'; the groups are gaussian, brdf, step, slice, data, table, shader"
          arguments+=(--group "$2")
          ;;
      esac
      shift
      ;;
    *) die "stability: there is no option '$1'; ./dev stability --help lists them" ;;
  esac
  shift
done

need_native_tests
need_python stability
need_import
need_display
exec "$PYTHON" "$ROOT/tools/stability/stability.py" --tool "$ROOT/build/cmake/lobelight_stability" \
  --out "$out" "${arguments[@]}"
