# shellcheck shell=bash
# One suite, or one test of it, while something is being changed: ./dev test GROUP:SUITE[:TEST]. Only what that suite needs
# is made anew: after a changed script nothing is imported, after changed C++ only the tests' program is built.

# Those of whose suites one can be named.
SINGLE_GROUPS=(cpp native runtime editor demo export stereo render commands)

# find_single ARGUMENT: sets $group, $file, a path in the repository, and $test, which is empty for the whole suite.
find_single() {
  local rest=${1#*:} name folder candidate
  local -a folders
  group=${1%%:*}
  name=${rest%%:*}
  test=""
  [[ $rest != *:* ]] || test=${rest#*:}
  is_one_of "$group" "${SINGLE_GROUPS[@]}" \
    || die "test: '$1' asks for a suite of '$group', but one can be named in ${SINGLE_GROUPS[*]}"
  case $group in
    cpp) folders=(gdextension/tests) ;;
    editor) folders=(tests/editor/with_library tests/editor/without_library) ;;
    export) folders=(tests/diet) ;;
    *) folders=("tests/$group") ;;
  esac
  [[ $name =~ ^[a-z0-9_]+$ ]] || die "test: '$1' names no suite; write $group:SUITE, as in ${folders[0]}"
  file=""
  for folder in "${folders[@]}"; do
    for candidate in "$ROOT/$folder/${name%_test}_test".{gd,cpp,sh,py}; do
      [[ ! -f $candidate ]] || file=$folder/$(basename "$candidate")
    done
  done
  [[ -n $file ]] || die "test: there is no suite '$name' in ${folders[*]}"
  if [[ -n $test && $file == *.gd ]]; then
    [[ $group != editor ]] || die "test: suites of the editor run whole; leave out ':$test'"
    test=test_${test#test_}
    grep -q "^func $test(" "$ROOT/$file" || die "test: $file has no test '$test'"
  elif [[ -n $test && $file != *.cpp && $file != */errors_test.sh ]]; then
    die "test: $file runs whole; leave out ':$test'"
  fi
}

# run_single ARGUMENT: makes what the suite needs, and runs and judges it.
run_single() {
  local group file test suite name renderer
  find_single "$1"
  suite=$(basename "${file%.*}")
  # What its log and its report are called; each run has its own.
  name=$group-$suite${test:+-${test//[^A-Za-z0-9_]/-}}
  case $group in
    cpp) single_cpp ;;
    commands) single_command ;;
    *)
      need_engine
      need_python ""
      need_library
      need_gdunit
      need_resources
      case $group in
        render)
          need_display
          bake_demo_tables thesis_8
          for renderer in ${LOBELIGHT_RENDERERS:-gl_compatibility}; do
            single_gdscript "$name-$renderer" godot_rendered "$renderer"
          done
          ;;
        stereo)
          need_display
          need_stereo_project
          for renderer in ${LOBELIGHT_RENDERERS:-mobile forward_plus}; do
            single_gdscript "$name-$renderer" godot_rendered "$renderer" --path "$STEREO_PROJECT"
          done
          ;;
        editor) single_editor ;;
        *) single_gdscript "$name" godot_headless ;;
      esac
      ;;
  esac
}

# single_gdscript NAME ENGINE…: gdUnit4 names suites to run, and tests to leave out.
single_gdscript() {
  local name=$1 other arguments=(-a "res://$file")
  shift
  if [[ -n $test ]]; then
    while read -r other; do
      [[ $other == "$test" ]] || arguments+=(-i "res://$file:$other")
    done < <(sed -n 's/^func \(test_[A-Za-z0-9_]*\)(.*/\1/p' "$ROOT/$file")
  fi
  run_gdunit "$name" "${arguments[@]}" -- in_time "$@"
}

single_cpp() {
  need_python ""
  need_core_tests
  rm -f "$RESULTS/$name.xml"
  run_logged "$name" in_time "$ROOT/build/cmake/lobelight_tests" "--source-file=*$suite.cpp" \
    ${test:+"--test-case=*$test*"} --reporters=junit "--out=$RESULTS/$name.xml"
  judge "$name" --junit "$RESULTS/$name.xml"
}

single_editor() {
  local project=$RESULTS/editor-project
  mkdir -p "$RESULTS/editor-user"
  bash "$ROOT/tools/testing/editor_project.sh" "$project"
  if [[ $file == */without_library/* ]]; then
    rm -rf "$project"/{addons/lobelight/{bin,lobelight.gdextension*},.godot/extension_list.cfg}
  fi
  run_logged "$name" in_time env "XDG_DATA_HOME=$RESULTS/editor-user" "$GODOT" --headless --editor --path "$project" ++ \
    --editor-tests "res://$file"
  judge "$name" --engine --junit "$project/report/results.xml"
}

single_command() {
  need_python accuracy
  need_import
  if [[ $file == *.py ]]; then
    run_logged "$name" in_time "$PYTHON" "$ROOT/$file"
  else
    run_logged "$name" in_time bash "$ROOT/$file" ${test:+"$test"}
  fi
  judge "$name"
}
