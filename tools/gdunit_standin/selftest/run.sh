#!/usr/bin/env bash
# Tests the stand-in for gdUnit4: suites that are wrong on purpose, each with the exit code it must end with.
# usage: run.sh PROJECT_DIRECTORY GODOT     (the directory is made anew)
set -euo pipefail

project=$1
godot=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
passed=0
failed=0

prepare() {
  rm -rf "$project"
  mkdir -p "$project/addons/gdUnit4"
  printf 'config_version=5\n\n[application]\n\nconfig/name="Self-test of the stand-in"\n' >"$project/project.godot"
  cp -r "$here/../bin" "$here/../src" "$project/addons/gdUnit4/"
  cp -r "$here/suites" "$project/tests"
  timeout 120 "$godot" --headless --path "$project" --import >"$project/import.log" 2>&1
}

# tool ARGUMENTS…: the command-line tool; its output goes to $project/log, its exit code to $status.
tool() {
  status=0
  # The group's stderr takes bash's own line about a crash.
  {
    timeout 60 "$godot" --headless --path "$project" -s res://addons/gdUnit4/bin/GdUnitCmdTool.gd "$@" \
      >"$project/log" 2>&1 || status=$?
  } 2>/dev/null
}

# verdict NAME EXPECTED_STATUS EXPECTED_TEXT: compares with what the tool did. Status "crash": none of its own codes.
verdict() {
  local name=$1 expected=$2 text=$3 problem=""
  case $expected in
    crash) [[ $status -gt 103 && $status -ne 124 ]] || problem="ended with $status, expected a crash" ;;
    *) [[ $status -eq $expected ]] || problem="ended with $status, expected $expected" ;;
  esac
  [[ -n $problem ]] || grep -qF -- "$text" "$project/log" || problem="does not say '$text'"
  if [[ -z $problem ]]; then
    passed=$((passed + 1))
    echo "  $name passed"
  else
    failed=$((failed + 1))
    echo "  $name FAILED: $problem"
    sed 's/^/    | /' "$project/log"
  fi
}

# suite NAME EXPECTED_STATUS EXPECTED_TEXT: runs one suite of the folder.
suite() {
  tool --ignoreHeadlessMode -a "res://tests/$1_test.gd" -c
  verdict "$1" "$2" "$3"
}

prepare

suite good 0 "end, 8 passed, 0 failed, 1 skipped"
suite wrong_values 100 "end, 0 passed, 16 failed"
suite no_assertion 100 "end, 0 passed, 2 failed"
suite script_error 100 "end, 0 passed, 2 failed"
suite engine_error 100 "end, 0 passed, 4 failed"
suite missing_script 100 "the script does not load"
suite type_error 100 "the script does not load"
suite no_suite 100 "the script is no GdUnitTestSuite"
suite no_tests 100 "the suite has no test"
suite all_skipped 100 "end, 0 passed, 0 failed, 1 skipped"
suite no_parameters 100 "test_parameters must be a constant and not empty"
suite never_ends 100 "end, 1 passed, 2 failed"
suite before_fails 100 "end, 0 passed, 2 failed"
suite after_fails 100 "end, 1 passed, 1 failed"
suite leaves_node 101 "nodes left behind: 1"
suite quits 100 "the program was ended by a test"
suite crashes crash "Program crashed"
suite not_there 100 "there is no script at this path"

tool --ignoreHeadlessMode -a res://tests/wrong_values_test.gd
verdict "stops at the first failure without -c" 100 "end, 0 passed, 1 failed"

tool --ignoreHeadlessMode -a res://tests/good_test.gd -i good_test -c
verdict "an ignored suite leaves no test" 100 "end, 0 passed, 0 failed"

tool --ignoreHeadlessMode -a res://tests/good_test.gd -i res://tests/good_test.gd:test_doubles -c
verdict "an ignored test leaves the others" 0 "end, 5 passed, 0 failed, 1 skipped"

tool --ignoreHeadlessMode -a res://tests/good_test.gd -i res://tests/good_test.gd:test_gone -c
verdict "an ignored test has to be there" 100 "test_gone is to be left out, but there is no such test"

tool -a res://tests/good_test.gd -c
verdict "headless needs the flag" 103 "headless mode needs --ignoreHeadlessMode"

tool --ignoreHeadlessMode -c
verdict "no path is named" 100 "no suite is named"

tool --ignoreHeadlessMode --wrong -a res://tests/good_test.gd
verdict "an unknown argument" 100 "unknown argument '--wrong'"

tool --ignoreHeadlessMode -a res://tests/good_test.gd -a res://tests/before_fails_test.gd -rd reports_here -c
report="$project/reports_here/report_1/results.xml"
cp "$report" "$project/log" 2>/dev/null || : >"$project/log"
verdict "the report names what failed" 100 '<error message="not run, because before() failed"/>'

sed -i 's/await _runner.run(/await _runner.no_such_method(/' "$project/addons/gdUnit4/bin/GdUnitCmdTool.gd"
tool --ignoreHeadlessMode -a res://tests/good_test.gd -c
verdict "an error in the runner itself" 100 "the runner stopped"

echo "stand-in: $passed passed, $failed failed"
((failed == 0))
