# shellcheck shell=bash
# ./dev test --sanitize KIND: the C++ tests under one of g++'s sanitizers and, with address, the native suites in the
# engine. OpenEXR and the engine are as they are, without them.

# shellcheck disable=SC2034 # used by those who source this file
SANITIZERS=(address undefined thread)
THREADED='*base_*,*fit_table_fitter*,*fit_roughness*,*fit_refinement*,*fit_product*,*brdf_measured*,*reference_*,*bake_*'

# prepare_sanitized GROUP…: what these need besides what is built for them.
prepare_sanitized() {
  need_python
  need_interface
  if is_one_of native "$@"; then need_gdunit; fi
}

# need_sanitized KIND TARGET…: builds them under the sanitizer in build/cmake-KIND.
need_sanitized() {
  local kind=$1 lock
  shift
  need_packages
  need_openexr
  mkdir -p "$ROOT/build"
  touch "$ROOT/build/.gdignore"
  exec {lock}>"$ROOT/build/lock-$kind"
  flock "$lock"
  step "Building with the $kind sanitizer" build_sanitized "$kind" "$@"
  exec {lock}>&-
}

build_sanitized() {
  local kind=$1
  shift
  configure_native "$ROOT/build/cmake-$kind" --preset "$kind" -DCMAKE_BUILD_TYPE=Debug
  cmake --build "$ROOT/build/cmake-$kind" --target "$@" --parallel "$JOBS"
}

# The C++ tests. A report ends the test that it is about, which then counts as failed. Under the thread sanitizer, which
# is slow, only those of files whose subject has threads.
sanitize_cpp() {
  local kind=$1 targets=(lobelight_tests)
  [[ $kind == thread ]] || targets+=(lobelight_binding_tests)
  need_sanitized "$kind" "${targets[@]}"
  rm -f "$RESULTS/cpp-$kind.xml"
  if [[ $kind == thread ]]; then
    run_logged "cpp-$kind" in_time "$ROOT/build/cmake-$kind/lobelight_tests" -d "-sf=$THREADED" \
      -r=junit "-o=$RESULTS/cpp-$kind.xml"
  else
    UBSAN_OPTIONS=print_stacktrace=1 run_logged "cpp-$kind" ctest --test-dir "$ROOT/build/cmake-$kind" \
      --timeout "$RUNNER_LIMIT" --parallel "$JOBS" --no-tests=error --output-on-failure \
      --output-junit "$RESULTS/cpp-$kind.xml"
  fi
  judge "cpp-$kind" --junit "$RESULTS/cpp-$kind.xml"
}

# The native suites, in a project of their own that has the sanitized library. The engine was not built for it, so the
# sanitizer's library has to be loaded before everything else; what the engine never frees is no leak of ours.
sanitize_native() {
  local project=$RESULTS/native-address-project build=$ROOT/build/cmake-address runtime
  need_sanitized address lobelight_library lobelight_no_deepbind
  runtime=$(g++ -print-file-name=libasan.so)
  [[ $runtime == /* ]] || die "test: g++ has no address sanitizer (libasan)"
  local engine=(env "LD_PRELOAD=$build/liblobelight_no_deepbind.so:$(readlink -f "$runtime")"
    ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0 "$GODOT" --headless --path "$project")
  make_native_project "$project" "$build"
  step "Importing the native suites' project" "${engine[@]}" --import
  XDG_DATA_HOME=$project/user run_logged native-address in_time "${engine[@]}" -s "$GDUNIT_TOOL" --ignoreHeadlessMode \
    -a res://tests/native -c -rd res://report
  local reports=("$project"/report/report_*/results.xml)
  judge native-address --engine --junit "${reports[0]}"
}

# make_native_project PROJECT BUILD: what the native suites need, with the library of the folder BUILD.
make_native_project() {
  local project=$1 part
  rm -rf "$project"
  mkdir -p "$project/addons" "$project/tests" "$project/.godot" "$project/user"
  touch "$project/user/.gdignore"
  # The suites ask what comparisons say of files, too.
  for part in addons/lobelight addons/gdUnit4 bake tests/native tests/data; do
    cp -r "$ROOT/$part" "$project/$part"
  done
  rm -rf "$project/addons/lobelight/bin"
  mkdir "$project/addons/lobelight/bin"
  cp "$2"/liblobelight.*.editor.* "$project/addons/lobelight/bin"
  echo "res://addons/lobelight/lobelight.gdextension" >"$project/.godot/extension_list.cfg"
  cat >"$project/project.godot" <<PROJECT
config_version=5

[application]

config/name="Native suites"
config/features=PackedStringArray("4.6")

[rendering]

renderer/rendering_method="gl_compatibility"
PROJECT
}
