#!/usr/bin/env bash
# runs the tests: all, or those named (lint harness standin cpp stability native runtime editor demo commands docs export cost crosscheck accuracy renderers stereo web render), or one suite (GROUP:SUITE[:TEST]); [--engine VERSION] [--thorough] [--json FILE] [--sanitize KIND]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/gdunit.sh
source "$ROOT/tools/lib/gdunit.sh"
# shellcheck source=tools/lib/stereo.sh
source "$ROOT/tools/lib/stereo.sh"
# shellcheck source=tools/lib/demo_tables.sh
source "$ROOT/tools/lib/demo_tables.sh"
# shellcheck source=tools/testing/runners.sh
source "$ROOT/tools/testing/runners.sh"
# shellcheck source=tools/testing/rendered.sh
source "$ROOT/tools/testing/rendered.sh"
# shellcheck source=tools/testing/lanes.sh
source "$ROOT/tools/testing/lanes.sh"
# shellcheck source=tools/testing/single.sh
source "$ROOT/tools/testing/single.sh"
# shellcheck source=tools/testing/sanitizers.sh
source "$ROOT/tools/testing/sanitizers.sh"

GROUPS_OF_TESTS=(lint harness standin cpp stability native runtime editor demo commands docs export cost crosscheck accuracy renderers stereo web render)

usage() {
  cat <<USAGE
usage: ./dev test [GROUP…] [--thorough] [--engine VERSION] [--json FILE]
       ./dev test GROUP:SUITE[:TEST]… [--json FILE]
       ./dev test --sanitize address|undefined|thread [cpp] [native] [--json FILE]

Groups, all of them if none is named: ${GROUPS_OF_TESTS[*]}
What they need is made first, once. Then they run side by side, as many at once as there are cores, up to 4; each one's output
is shown when it has ended, and a table at the end says where the time went. LOBELIGHT_JOBS=1 runs one after another.
GROUP:SUITE[:TEST] runs one suite or one test, and makes only what that needs: runtime:lobe_table, cpp:fit_em,
render:seam:test_no_seam, commands:errors:bake. The groups with such suites are ${SINGLE_GROUPS[*]}.
A rendered suite is then drawn in Compatibility, unless LOBELIGHT_RENDERERS names others.
--engine VERSION takes an official build of Godot, 4.6 or later, as ./dev engine downloads it.
--thorough: also what takes too long for every change. Without it each renderer draws the suites that tools/testing/rendered.sh
names; with it all of them. Exports are compared in all three renderers, more scenes are drawn in a browser, the
package is built and unpacked, and damaged files are read under sanitizers. It takes three times as long; run it at night, and before a release.
With --sanitize the C++ tests run under one of g++'s sanitizers; with address also the native suites, the library in
the engine. They are built in build/cmake-KIND.
The last line is "N passed, N failed". Logs and reports are kept in build/test.
LOBELIGHT_RENDERERS="mobile …" limits the rendered suites to these renderers.
USAGE
}

groups=()
singles=()
total_options=()
sanitizer=""
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --thorough) export LOBELIGHT_THOROUGH=yes ;;
    --engine)
      GODOT=$(bash "$ROOT/tools/commands/engine.sh" "${2:-}") || exit
      export GODOT
      shift
      ;;
    --json)
      [[ -n ${2:-} ]] || die "test: --json needs a file name"
      [[ -d $(dirname -- "$2") ]] || die "test: $2: its folder does not exist"
      total_options=(--json "$2")
      shift
      ;;
    --sanitize)
      is_one_of "${2:-}" "${SANITIZERS[@]}" \
        || die "test: --sanitize is '${2:-}', but must be one of ${SANITIZERS[*]}"
      sanitizer=$2
      shift
      ;;
    *:*)
      (find_single "$1") || exit
      singles+=("$1")
      ;;
    *)
      is_one_of "$1" "${GROUPS_OF_TESTS[@]}" \
        || die "test: there is no group '$1'; the groups are ${GROUPS_OF_TESTS[*]}"
      groups+=("$1")
      ;;
  esac
  shift
done
((${#singles[@]} == 0 || ${#groups[@]} == 0)) || die "test: name groups or single suites, not both"
if [[ -n $sanitizer ]]; then
  ((${#singles[@]} == 0)) || die "test: --sanitize runs groups, not '${singles[0]}'"
  suites=(cpp)
  [[ $sanitizer != address ]] || suites+=(native)
  for group in "${groups[@]}"; do
    is_one_of "$group" "${suites[@]}" \
      || die "test: --sanitize $sanitizer runs ${suites[*]}, not '$group'"
  done
  ((${#groups[@]} > 0)) || groups=("${suites[@]}")
fi
list_runners=jobs_of_groups
if ((${#groups[@]} == 0)); then
  groups=("${GROUPS_OF_TESTS[@]}")
  list_runners=runners_of_everything
fi

# Tests draw small pictures with many shaders: what Mesa's compiler spends on optimising them is never earned back. What
# is drawn stays the same.
export GALLIVM_PERF=${GALLIVM_PERF:-nopt}
# What it has compiled is kept for the next run, apart from what commands that measure times find.
export MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-$CACHE/shaders}
export LOBELIGHT_DRAFT_TABLES=yes

rm -rf "$RESULTS"
mkdir -p "$RESULTS/user"
# The engine's user folders: at what it finds there of shaders that another driver has compiled, it would warn.
export XDG_DATA_HOME=$RESULTS/user
if [[ -n $sanitizer ]]; then
  prepare_sanitized "${groups[@]}"
  for group in "${groups[@]}"; do
    "sanitize_$group" "$sanitizer"
  done
elif ((${#singles[@]} > 0)); then
  for single in "${singles[@]}"; do
    run_single "$single"
  done
else
  mapfile -t runners < <("$list_runners" "${groups[@]}" | awk '!seen[$0]++')
  mapfile -t runners < <(order_jobs "${runners[@]}")
  timed prepare_tests "${runners[@]}"
  total_options+=(--preparation "$took")
  if ((${#runners[@]} > 1 && JOBS > 1)); then
    run_side_by_side "${runners[@]}"
  else
    for runner in "${runners[@]}"; do
      "run_$runner"
    done
  fi
fi
mapfile -t outcomes < <(find "$RESULTS" -maxdepth 1 -name '*.json' -printf '%T@ %p\n' | sort -n | cut -d' ' -f2-)
"$PYTHON" "$ROOT/tools/testing/results.py" total "${outcomes[@]}" "${total_options[@]}"
