#!/usr/bin/env bash
# runs the tests: all, or those named (lint harness standin cpp stability native runtime editor demo commands export cost crosscheck accuracy renderers render); [--json FILE]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/gdunit.sh
source "$ROOT/tools/lib/gdunit.sh"
# shellcheck source=tools/lib/demo_tables.sh
source "$ROOT/tools/lib/demo_tables.sh"
# shellcheck source=tools/testing/runners.sh
source "$ROOT/tools/testing/runners.sh"
# shellcheck source=tools/testing/lanes.sh
source "$ROOT/tools/testing/lanes.sh"

GROUPS_OF_TESTS=(lint harness standin cpp stability native runtime editor demo commands export cost crosscheck accuracy renderers render)

usage() {
  cat <<USAGE
usage: ./dev test [GROUP…] [--json FILE]

Groups, all of them if none is named: ${GROUPS_OF_TESTS[*]}
What they need is made first, once. Then they run side by side, as many at once as there are cores, up to 4; each one's output
is shown when it has ended, and says how long it took. LOBELIGHT_JOBS=1 runs one after another.
The last line is "N passed, N failed". Logs and reports are kept in build/test.
LOBELIGHT_RENDERERS="mobile …" limits the rendered suites to these renderers.
USAGE
}

groups=()
total_options=()
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --json)
      [[ -n ${2:-} ]] || die "test: --json needs a file name"
      [[ -d $(dirname -- "$2") ]] || die "test: $2: its folder does not exist"
      total_options=(--json "$2")
      shift
      ;;
    *)
      [[ " ${GROUPS_OF_TESTS[*]} " == *" $1 "* ]] \
        || die "test: there is no group '$1'; the groups are ${GROUPS_OF_TESTS[*]}"
      groups+=("$1")
      ;;
  esac
  shift
done
((${#groups[@]} > 0)) || groups=("${GROUPS_OF_TESTS[@]}")

mapfile -t runners < <(for group in "${groups[@]}"; do jobs_of "$group"; done | awk '!seen[$0]++')
mapfile -t runners < <(order_jobs "${runners[@]}")

# Tests draw small pictures with many shaders: what Mesa's compiler spends on optimising them is never earned back. What
# is drawn stays the same.
export GALLIVM_PERF=${GALLIVM_PERF:-nopt}
export LOBELIGHT_DRAFT_TABLES=yes

rm -rf "$RESULTS"
mkdir -p "$RESULTS"
prepare_tests "${runners[@]}"
if ((${#runners[@]} > 1 && JOBS > 1)); then
  run_side_by_side "${runners[@]}"
else
  for runner in "${runners[@]}"; do
    "run_$runner"
  done
fi
mapfile -t outcomes < <(find "$RESULTS" -maxdepth 1 -name '*.json' -printf '%T@ %p\n' | sort -n | cut -d' ' -f2-)
"$PYTHON" "$ROOT/tools/testing/results.py" total "${outcomes[@]}" "${total_options[@]}"
