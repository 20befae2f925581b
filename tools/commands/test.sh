#!/usr/bin/env bash
# runs the tests: all, or those named (lint harness standin cpp stability native runtime editor demo commands export cost crosscheck accuracy renderers render); [--json FILE]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/gdunit.sh
source "$ROOT/tools/lib/gdunit.sh"
# shellcheck source=tools/lib/demo_tables.sh
source "$ROOT/tools/lib/demo_tables.sh"
# shellcheck source=tools/testing/runners.sh
source "$ROOT/tools/testing/runners.sh"

GROUPS_OF_TESTS=(lint harness standin cpp stability native runtime editor demo commands export cost crosscheck accuracy renderers render)

usage() {
  cat <<USAGE
usage: ./dev test [GROUP…] [--json FILE]

Groups, all of them if none is named: ${GROUPS_OF_TESTS[*]}
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

need_engine
need_python
need_library
need_gdunit
need_import

rm -rf "$RESULTS"
mkdir -p "$RESULTS"
for group in "${groups[@]}"; do
  "run_$group"
done
mapfile -t outcomes < <(find "$RESULTS" -maxdepth 1 -name '*.json' -printf '%T@ %p\n' | sort -n | cut -d' ' -f2-)
"$PYTHON" "$ROOT/tools/testing/results.py" total "${outcomes[@]}" "${total_options[@]}"
