# shellcheck shell=bash
# The runners of ./dev test, one function each. Each runs its tests with the output on the terminal and in a log
# below $RESULTS, and has tools/testing/results.py judge them. Runners may run side by side: what they need, and share, is
# made by prepare_tests beforehand.

RESULTS=$ROOT/build/test
# Seconds after which a runner is stopped: far more than any needs on two cores with a software renderer.
RUNNER_LIMIT=${LOBELIGHT_TEST_LIMIT:-3600}

# timed COMMAND…: runs COMMAND in this shell and sets $took to its seconds: wall, user and system.
timed() {
  local times TIMEFORMAT='%0R %0U %0S'
  times=$(mktemp)
  # The command's errors go to where they went before; only what `time` says goes to the file.
  { time "$@" 2>&3; } 3>&2 2>"$times"
  took=$(<"$times")
  rm -f "$times"
}

# run_logged NAME COMMAND…: runs COMMAND with its output on the terminal and in NAME.log, and says how long it took; sets
# $status and $took.
run_logged() {
  local name=$1 wall user system
  shift
  echo
  echo "== $name"
  status=0
  timed log_output "$RESULTS/$name.log" "$@"
  read -r wall user system <<<"$took"
  echo "== $name: $wall s, $user + $system s of processor time"
}

log_output() {
  local log=$1
  shift
  "$@" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
}

# judge NAME [OPTION…]: counts what NAME's run, which ended with $status, has in its log or report.
judge() {
  local name=$1
  shift
  "$PYTHON" "$ROOT/tools/testing/results.py" judge --runner "$name" --status "$status" --took "${took:-}" \
    --log "$RESULTS/$name.log" --out "$RESULTS/$name.json" "$@" || true
  [[ -s $RESULTS/$name.json ]] || die "test: what $name did could not be judged"
}

# Tests of the C++ core, through CTest.
run_cpp() {
  local left_out=(--exclude-regex "$THOROUGH_CPP")
  [[ -z ${LOBELIGHT_THOROUGH:-} ]] || left_out=()
  rm -f "$RESULTS/cpp.xml"
  run_logged cpp ctest --test-dir "$ROOT/build/cmake" "${left_out[@]}" --timeout "$RUNNER_LIMIT" --parallel "$JOBS" \
    --no-tests=error --output-on-failure --output-junit "$RESULTS/cpp.xml"
  judge cpp --junit "$RESULTS/cpp.xml"
}

# Those that the build for ./dev fuzz has, under the address and undefined-behaviour sanitizers.
run_cpp_sanitized() {
  rm -f "$RESULTS/cpp-sanitized.xml"
  run_logged cpp-sanitized in_time "$ROOT/build/cmake/fuzz/lobelight_sanitized_tests" -r=junit \
    "-o=$RESULTS/cpp-sanitized.xml"
  judge cpp-sanitized --junit "$RESULTS/cpp-sanitized.xml"
}

# A few seconds of mutated files and recipes under sanitizers.
run_fuzz() {
  run_logged fuzz in_time bash "$ROOT/tools/commands/fuzz.sh" --minutes 0.1 --seed 1
  judge fuzz
}

# jobs_of GROUP: prints the runners of a group of ./dev test, one a line.
jobs_of() {
  local renderer
  case $1 in
    cpp) printf '%s\n' cpp cpp_sanitized fuzz ;;
    stability) printf '%s\n' stability stability_changes ;;
    commands) printf '%s\n' commands setup report release report_smoke bench_runtime ;;
    stereo) printf '%s\n' stereo_mobile stereo_forward_plus ;;
    export) printf '%s\n' export_diet export_pictures export_package export_android export_web ;;
    render)
      for renderer in ${LOBELIGHT_RENDERERS:-mobile gl_compatibility forward_plus}; do
        echo "render_$renderer"
      done
      ;;
    web) printf '%s\n' export_web browser ;;
    *) echo "$1" ;;
  esac
}

# What a run of everything leaves to --thorough, and to runs that name the group. The package's library is built once more, by
# Zig; what runs under sanitizers needs a build of its own; and two eyes see in Forward+ what they see in Mobile.
THOROUGH_RUNNERS=(export_package cpp_sanitized fuzz stereo_forward_plus)

# C++ tests that take more than ten seconds each.
THOROUGH_CPP='No step of the largest tables|A fit needs no more memory than the formula|in all ways, stop soon|Long highlights are drawn no worse'

# jobs_of_groups GROUP…: prints the runners of these groups, one a line.
jobs_of_groups() {
  local group
  for group in "$@"; do
    jobs_of "$group"
  done
}

# runners_of_everything GROUP…: prints the runners of a run in which no group was named, one a line.
runners_of_everything() {
  local group job
  for group in "$@"; do
    for job in $(jobs_of "$group"); do
      if [[ -n ${LOBELIGHT_THOROUGH:-} ]] || ! is_one_of "$job" "${THOROUGH_RUNNERS[@]}"; then
        echo "$job"
      fi
    done
  done
}

# The runners that take longest begin first, so that none of them is left over at the end.
LONGEST_FIRST=(render_gl_compatibility render_mobile export_pictures browser render_forward_plus accuracy cpp docs lint
  export_package commands stability report_smoke editor export_diet export_web stereo_mobile export_android renderers)

# order_jobs JOB…: prints them, one a line.
order_jobs() {
  local job
  for job in "${LONGEST_FIRST[@]}"; do
    [[ " $* " != *" $job "* ]] || echo "$job"
  done
  for job in "$@"; do
    [[ " ${LONGEST_FIRST[*]} " == *" $job "* ]] || echo "$job"
  done
}

# prepare_tests JOB…: what these need, made once, with all cores.
prepare_tests() {
  local wanted=" $* "
  need_engine
  need_display
  need_python
  if [[ $wanted =~ \ (cpp|stability|crosscheck)\  ]]; then need_native_tests; else need_library; fi
  [[ $wanted != *" fuzz "* ]] || bash "$ROOT/tools/setup/fuzz.sh" lobelight_fuzz lobelight_sanitized_tests
  need_gdunit
  need_import
  [[ ! $wanted =~ \ stereo_ ]] || need_stereo_project
  [[ ! $wanted =~ \ (render_[a-z_]+)\  ]] || bake_demo_tables thesis_8
  [[ $wanted != *" export_package "* ]] || need_package_libraries
  [[ ! $wanted =~ \ export_(android|web)\  ]] || bake_demo_tables "${DEMO_SETS[@]}"
  [[ ! $wanted =~ \ (export_web|browser)\  ]] || need_web_template
  [[ ! $wanted =~ \ (export_web|browser)\  ]] || need_browser
  if [[ $wanted == *" docs "* ]]; then
    need_class_xml
    need_maths_font
    need_browser
    need_python docs
  fi
  [[ ! $wanted =~ \ (stability|stability_changes)\  ]] || need_python stability
  [[ $wanted != *" crosscheck "* ]] || need_python crosscheck
  [[ ! $wanted =~ \ (report|report_smoke|commands)\  ]] || need_python report
  [[ $wanted != *" bench_runtime "* ]] || need_python bench
  # The last one is what PYTHON stays.
  need_python accuracy
}

# The reduced set of ./dev stability.
run_stability() {
  run_logged stability in_time bash "$ROOT/tools/commands/stability.sh" --quick
  judge stability
}

# That it finds what is changed in a shader.
run_stability_changes() {
  run_logged stability-changes in_time "$PYTHON" "$ROOT/tests/commands/stability_test.py"
  judge stability-changes
}

# run_suites NAME FOLDER ENGINE…: the suites of a folder; ENGINE is how the engine is called.
run_suites() {
  local name=$1 folder=$2
  shift 2
  run_gdunit "$name" -a "res://$folder" -- "$@"
}

# run_gdunit NAME ARGUMENT… -- ENGINE…: gdUnit4's tool with these arguments. user:// is this run's own.
run_gdunit() {
  local name=$1 arguments=()
  shift
  while [[ $1 != -- ]]; do
    arguments+=("$1")
    shift
  done
  shift
  rm -rf "${RESULTS:?}/$name-report" "${RESULTS:?}/$name-user"
  mkdir "$RESULTS/$name-user"
  XDG_DATA_HOME=$RESULTS/$name-user run_logged "$name" "$@" -s "$GDUNIT_TOOL" --ignoreHeadlessMode "${arguments[@]}" -c \
    -rd "res://build/test/$name-report"
  local reports=("$RESULTS/$name-report"/report_*/results.xml)
  judge "$name" --engine --junit "${reports[0]}"
}

# The native classes.
run_native() {
  run_suites native tests/native in_time godot_headless
}

# The run time as far as it needs no renderer.
run_runtime() {
  run_suites runtime tests/runtime in_time godot_headless
}

# check_class_reference PROJECT FOLDER: has the engine write the class reference of the addon in PROJECT to FOLDER, and
# looks for what is not described. For native classes it completes the XML files that the library takes in.
check_class_reference() {
  mkdir -p "$2/doc_classes"
  cp "$1"/addons/lobelight/doc_classes/*.xml "$2/doc_classes"
  "$GODOT" --headless --path "$1" --doctool "$2" --gdscript-docs res://addons/lobelight || return
  "$GODOT" --headless --path "$1" --doctool "$2" --gdextension-docs || return
  "$PYTHON" "$ROOT/tests/editor/class_reference.py" "$2"
}

# The editor's side: suites in a running editor, the editor closed during a bake, and without the native library.
run_editor() {
  local project=$RESULTS/editor-project
  local editor=(in_time env "XDG_DATA_HOME=$RESULTS/editor-user" "$GODOT" --headless --editor --path "$project" ++)
  mkdir -p "$RESULTS/editor-user"
  bash "$ROOT/tools/testing/editor_project.sh" "$project"
  run_logged editor "${editor[@]}" --editor-tests res://tests/editor/with_library
  judge editor --engine --junit "$project/report/results.xml"
  run_logged editor-class-reference check_class_reference "$project" "$RESULTS/class-reference"
  judge editor-class-reference --engine
  run_logged editor-closing "${editor[@]}" --quit-while-baking
  judge editor-closing --engine
  rm -rf "$project"/{report,addons/lobelight/{bin,lobelight.gdextension*},.godot/extension_list.cfg}
  run_logged editor-without-library "${editor[@]}" --editor-tests res://tests/editor/without_library
  judge editor-without-library --engine --junit "$project/report/results.xml"
}

# The demo's shapes and scene.
run_demo() {
  run_suites demo tests/demo in_time godot_headless
}

# The rendered suites, in one renderer each.
run_render_mobile() { run_render mobile; }
run_render_gl_compatibility() { run_render gl_compatibility; }
run_render_forward_plus() { run_render forward_plus; }

run_render() {
  local rendered=()
  list_rendered "$1"
  run_gdunit "render-$1" "${rendered[@]}" -- in_time godot_rendered "$1"
}

# Pictures for two eyes. (In Compatibility, Mesa's drivers in software draw for one.)
run_stereo_mobile() { run_stereo mobile; }
run_stereo_forward_plus() { run_stereo forward_plus; }

run_stereo() {
  run_suites "stereo-$1" tests/stereo in_time godot_rendered "$1" --path "$STEREO_PROJECT"
}

# What the commands do with wrong arguments and files.
run_commands() {
  run_logged commands in_time bash "$ROOT/tests/commands/errors_test.sh"
  judge commands
}

# What ./dev docs finds in bad pages, the figures of good ones, and the site itself.
run_docs() {
  run_logged docs-checks in_time "$PYTHON" "$ROOT/tests/commands/docs_test.py"
  judge docs-checks
  run_logged docs-figures in_time "$PYTHON" "$ROOT/tests/commands/docs_figures_test.py"
  judge docs-figures
  run_logged docs in_time bash "$ROOT/tools/commands/docs.sh" --check --out "$RESULTS/docs-site"
  judge docs
}

# What the set-up does where the outside changes.
run_setup() {
  run_logged setup in_time bash "$ROOT/tests/commands/setup_test.sh"
  judge setup
  run_logged engine in_time bash "$ROOT/tests/commands/engine_test.sh"
  judge engine
}

# What ./dev report and ./dev accuracy make of measurements.
run_report() {
  run_logged report in_time "$PYTHON" "$ROOT/tests/commands/report_test.py"
  judge report
  run_logged accuracy-report in_time "$PYTHON" "$ROOT/tests/commands/accuracy_report_test.py"
  judge accuracy-report
}

# What ./dev release refuses and writes.
run_release() {
  run_logged release in_time "$PYTHON" "$ROOT/tests/commands/release_test.py"
  judge release
}

# ./dev report from end to end, small.
run_report_smoke() {
  run_logged report-smoke in_time "$PYTHON" "$ROOT/tests/commands/report_smoke_test.py"
  judge report-smoke
}

# ./dev bench runtime --out from end to end, small.
run_bench_runtime() {
  run_logged bench-runtime in_time "$PYTHON" "$ROOT/tests/commands/bench_runtime_test.py"
  judge bench-runtime
}

# What exports leave out, as the editor's scripts find it.
run_export_diet() {
  run_suites export-diet tests/diet in_time godot_headless
}

# What exports leave out, and that the pictures stay the same.
run_export_pictures() {
  local quick=(--quick)
  [[ -z ${LOBELIGHT_THOROUGH:-} ]] || quick=()
  run_logged export-pictures in_time bash "$ROOT/tools/commands/diet.sh" --acceptance "${quick[@]}"
  judge export-pictures
}

# The package, and what is exported from a project that it was unpacked into.
run_export_package() {
  run_logged export-libraries in_time "$PYTHON" "$ROOT/tests/commands/package_tool_test.py"
  judge export-libraries
  run_logged export-package in_time bash "$ROOT/tests/commands/package_test.sh"
  judge export-package
}

# The demo's pack for Android.
run_export_android() {
  run_logged export-android in_time bash "$ROOT/tools/commands/android.sh" --pack-only --out "$RESULTS/android"
  judge export-android
}

# The demo as a page for browsers, and in one.
run_export_web() {
  # Beside the page lies what it weighs; results are not in this folder.
  mkdir -p "$RESULTS/web"
  run_logged export-web in_time "$PYTHON" "$ROOT/tests/commands/web_test.py" "$RESULTS/web/page"
  judge export-web
  run_logged browser-page in_time "$PYTHON" "$ROOT/tests/commands/browser_test.py" --page "$RESULTS/web/page"
  judge browser-page
}

# Scenes in a browser beside Compatibility here.
run_browser() {
  local every=()
  [[ -z ${LOBELIGHT_THOROUGH:-} ]] || every=(--every-scene)
  run_logged browser in_time "$PYTHON" "$ROOT/tests/commands/browser_test.py" --scenes "$RESULTS/browser" "${every[@]}"
  judge browser
}

# The reference integrator against Mitsuba 3, small.
run_crosscheck() {
  run_logged crosscheck in_time bash "$ROOT/tools/commands/crosscheck.sh" --small --only mitsuba,teapot
  judge crosscheck
}

# What ./dev compare finds, against the project's bounds.
run_accuracy() {
  run_logged accuracy in_time "$PYTHON" "$ROOT/tests/commands/accuracy_test.py"
  judge accuracy
}

# How ./dev mobile-cost reads what the compilers say, and what ./dev demo --cost makes of it.
run_cost() {
  run_logged cost in_time "$PYTHON" "$ROOT/tests/commands/mobile_cost_test.py"
  judge cost
  run_logged demo-cost in_time "$PYTHON" "$ROOT/tests/commands/demo_cost_test.py"
  judge demo-cost
}

# One scene in the three renderers.
run_renderers() {
  run_logged renderers in_time bash "$ROOT/tests/commands/renderers_test.sh"
  judge renderers
}

# The judge of the runners, how one suite is found, and what ./dev lint finds in the run time and its shaders.
run_harness() {
  run_logged single in_time bash "$ROOT/tools/testing/single_test.sh"
  judge single
  run_logged harness in_time "$PYTHON" "$ROOT/tools/testing/results_test.py"
  judge harness
  run_logged arrows in_time "$PYTHON" "$ROOT/tools/lint/arrows_test.py"
  judge arrows
  run_logged house in_time "$PYTHON" "$ROOT/tools/house/house_test.py"
  judge house
  run_logged shader-names in_time "$PYTHON" "$ROOT/tools/lint/shader_names_test.py"
  judge shader-names
}

# The stand-in for gdUnit4.
run_standin() {
  run_logged standin in_time bash "$GDUNIT_STANDIN/selftest/run.sh" "$RESULTS/standin-project" "$GODOT"
  judge standin
}

# The form of the sources.
run_lint() {
  run_logged lint in_time bash "$ROOT/tools/commands/lint.sh"
  judge lint
}

# in_time COMMAND…: COMMAND, a program or a function of the shell library, stopped after RUNNER_LIMIT seconds.
in_time() {
  if [[ $(type -t "$1") == function ]]; then
    # shellcheck disable=SC2016 # expanded by the inner shell
    timeout "$RUNNER_LIMIT" bash -c 'source "$0/tools/lib/common.sh"; "$@"' "$ROOT" "$@"
  else
    timeout "$RUNNER_LIMIT" "$@"
  fi
}
