# shellcheck shell=bash
# need_…: each makes sure that something is there. Quick and silent when it is; otherwise the work is done by a
# script below tools/setup, under a lock, so that two runs at once do it once.

# What is looked for, and the Debian package that brings it. A probe is a kind and what it looks for.
PACKAGE_PROBES=(
  "command cmake cmake"
  "command ninja ninja-build"
  "command g++ g++"
  "command git git"
  "command patchelf patchelf"
  "command shellcheck shellcheck"
  "command Xvfb xvfb"
  "command xauth xauth"
  "header glm/glm.hpp libglm-dev"
  "header doctest/doctest.h doctest-dev"
  "file /usr/lib/python3*/ensurepip python3-venv"
  "file /usr/share/keyrings/debian-archive-keyring.gpg debian-archive-keyring"
  "mirror debian debootstrap"
)

# Software drivers, for an engine that is not the unpacked one and so brings none.
# shellcheck disable=SC2034 # used by need_display
DRIVER_PROBES=(
  "file /usr/share/vulkan/icd.d/lvp_icd*.json mesa-vulkan-drivers"
  "file /usr/lib/*/libGLX_mesa.so* libglx-mesa0"
  "file /usr/lib/*/libGL.so.1 libgl1"
  "file /usr/lib/*/dri/swrast_dri.so libgl1-mesa-dri"
)

# missing_packages PROBE…: prints the packages whose probe finds nothing, one a line.
missing_packages() {
  local entry kind wanted package
  for entry in "$@"; do
    read -r kind wanted package <<<"$entry"
    case $kind in
      command) command -v "$wanted" >/dev/null ;;
      header) [[ -f /usr/include/$wanted || -f /usr/local/include/$wanted ]] ;;
      file) compgen -G "$wanted" >/dev/null ;;
      # Outside Debian, debootstrap knows where Debian's packages are.
      mirror)
        [[ -n ${LOBELIGHT_DEBIAN_MIRROR:-} || -x /usr/sbin/debootstrap ]] \
          || grep -qsx 'ID=debian' /etc/os-release
        ;;
    esac || echo "$package"
  done
}

# need_packages: the system packages, by apt where they are missing.
need_packages() {
  [[ -z ${LOBELIGHT_PACKAGES_READY:-} ]] || return 0
  if [[ -n $(missing_packages "${PACKAGE_PROBES[@]}") ]]; then
    install_packages "${PACKAGE_PROBES[@]}"
  fi
  export LOBELIGHT_PACKAGES_READY=1
}

# install_packages PROBE…: by apt, what these probes miss.
install_packages() {
  locked "$CACHE/lock/packages" bash "$ROOT/tools/setup/packages.sh" "$@"
}

# need_python [EXTRA]: sets and exports PYTHON, the interpreter of a virtual environment in the cache with
# tools/requirements.txt, and tools/requirements-EXTRA.txt if EXTRA is given.
# shellcheck disable=SC2120 # commands pass EXTRA, this file does not
need_python() {
  local extra=${1:-} name=base
  local requirements=("$ROOT/tools/requirements.txt")
  if [[ -n $extra ]]; then
    requirements+=("$ROOT/tools/requirements-$extra.txt")
    name=$extra
  fi
  PYTHON=$CACHE/python/bin/python3
  export PYTHON
  if [[ ! -x $PYTHON ]] || ! stamp_is "$CACHE/python/lobelight-$name" "$(content_hash "${requirements[@]}")"; then
    need_packages
    locked "$CACHE/lock/python" bash "$ROOT/tools/setup/python.sh" "$extra"
  fi
}

# need_actionlint: sets ACTIONLINT, which checks GitHub's workflows.
need_actionlint() {
  local folder
  folder=$CACHE/actionlint/$(content_hash "$ROOT/tools/setup/actionlint.sh" "$ROOT/tools/setup/actionlint.txt" \
    "$ROOT/tools/lint/actionlint/go.mod" "$ROOT/tools/lint/actionlint/go.sum")
  if [[ ! -f $folder/complete ]]; then
    locked "$CACHE/lock/actionlint" bash "$ROOT/tools/setup/actionlint.sh" "$folder"
  fi
  # shellcheck disable=SC2034 # used by those who call this
  ACTIONLINT=$folder/actionlint
}

# need_openexr: sets OPENEXR_DIR, where static OpenEXR and Imath are installed.
need_openexr() {
  OPENEXR_DIR=$CACHE/deps/openexr-$(content_hash "$ROOT/tools/setup/openexr.sh" "$ROOT/tools/setup/openexr.txt")
  if [[ ! -f $OPENEXR_DIR/complete ]]; then
    need_python ""
    locked "$CACHE/lock/openexr" bash "$ROOT/tools/setup/openexr.sh" "$OPENEXR_DIR"
  fi
}

# need_interface: sets GODOT_INTERFACE, gdextension_interface.h of the engine that is used, in the cache.
need_interface() {
  local stamp
  need_engine
  stamp=$CACHE/interface/engine-$(program_identity "$GODOT")
  if [[ ! -f $stamp || ! -f $(<"$stamp") ]]; then
    locked "$CACHE/lock/interface" bash "$ROOT/tools/setup/interface.sh" "$stamp"
  fi
  GODOT_INTERFACE=$(<"$stamp")
}

# configure_native FOLDER OPTION…: CMake on gdextension/ in FOLDER, which is emptied first where it belongs to another
# folder of sources, as after a clone was moved or copied. Takes OpenEXR, and the engine's interface where it was needed.
configure_native() {
  local build=$1 home
  shift
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt" 2>/dev/null) || true
  if [[ -n $home && $(realpath -m -- "$home") != $(realpath -m -- "$ROOT/gdextension") ]]; then
    say "${build#"$ROOT/"} was built for $home and is built anew."
    rm -rf "$build"
  fi
  cmake -S "$ROOT/gdextension" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLOBELIGHT_DEPS_DIR="$OPENEXR_DIR" \
    ${GODOT_INTERFACE:+"-DLOBELIGHT_GDEXTENSION_INTERFACE=$GODOT_INTERFACE"} "$@"
}

# need_cross_compiler TARGET: sets CROSS, CMake's options that build for TARGET, a system and a processor as
# lobelight.gdextension names them.
need_cross_compiler() {
  local folder
  folder=$CACHE/zig/$(content_hash "$ROOT/tools/setup/zig.sh" "$ROOT/tools/setup/zig.txt")
  if [[ ! -f $folder/complete ]]; then
    need_python ""
    locked "$CACHE/lock/zig" bash "$ROOT/tools/setup/zig.sh" "$folder"
  fi
  ZIG_FOLDER=$folder/ziglang
  # shellcheck disable=SC2034 # used by those who call this
  CROSS=("-DCMAKE_TOOLCHAIN_FILE=$ROOT/gdextension/cmake/Zig.cmake" "-DLOBELIGHT_ZIG=$ZIG_FOLDER/zig"
    "-DLOBELIGHT_TARGET=$1")
  # Zig keeps here what it has compiled of its own libraries.
  export ZIG_GLOBAL_CACHE_DIR=$folder/cache ZIG_LOCAL_CACHE_DIR=$folder/cache
}

# need_cross TARGET: need_cross_compiler, and sets OPENEXR_DIR to OpenEXR and Imath for TARGET.
need_cross() {
  need_cross_compiler "$1"
  OPENEXR_DIR=$CACHE/deps/openexr-$1-$(content_hash "$ROOT/tools/setup/openexr.sh" "$ROOT/tools/setup/openexr.txt" \
    "$ROOT/tools/setup/zig.txt" "$ROOT/gdextension/cmake/Zig.cmake")
  if [[ ! -f $OPENEXR_DIR/complete ]]; then
    locked "$CACHE/lock/openexr-$1" bash "$ROOT/tools/setup/openexr.sh" "$OPENEXR_DIR" "$1"
  fi
}

# cross_key: as library_key, for what need_cross has set OPENEXR_DIR to, after need_interface.
cross_key() {
  echo "$(fingerprint "$ROOT/gdextension" "$ROOT/addons/lobelight/doc_classes" \
    "$ROOT/tools/setup/cross_library.sh") $OPENEXR_DIR $GODOT_INTERFACE"
}

# need_cross_library TARGET: the native library for TARGET, in build/libraries/TARGET.
need_cross_library() {
  need_packages
  need_interface
  need_cross "$1"
  if ! stamp_is "$ROOT/build/libraries/$1/key" "$(cross_key)"; then
    locked "$ROOT/build/lock" bash "$ROOT/tools/setup/cross_library.sh" "$1"
  fi
}

# need_package_libraries [--all]: what ./dev package packs, in build/libraries: the library for this machine, or those for
# every desktop.
need_package_libraries() {
  local targets target OPENEXR_DIR
  need_python ""
  mapfile -t targets < <("$PYTHON" "$ROOT/tools/package/package.py" --targets "$@")
  ((${#targets[@]} > 0)) || die "there is no library for this machine among those that lobelight.gdextension names"
  for target in "${targets[@]}"; do
    need_cross_library "$target"
  done
}

# library_key: what the native library is built from. Changes when a source, the recipe, OpenEXR or the engine's interface
# does.
library_key() {
  echo "$(fingerprint "$ROOT/gdextension" "$ROOT/addons/lobelight/doc_classes" \
    "$ROOT/addons/lobelight/lobelight.gdextension" "$ROOT/tools/setup/library.sh") $OPENEXR_DIR ${GODOT_INTERFACE:-}"
}

# need_library: the native library, built in build/cmake and installed where lobelight.gdextension looks for it.
need_library() {
  need_packages
  need_openexr
  need_interface
  if ! stamp_is "$ROOT/build/library-key" "$(library_key)" || [[ ! -f $ROOT/.godot/extension_list.cfg ]] \
    || ! compgen -G "$ROOT/addons/lobelight/bin/*" >/dev/null; then
    locked "$ROOT/build/lock" bash "$ROOT/tools/setup/library.sh" lobelight_library
  fi
}

# need_native_tests: need_library, and everything else that CMake builds, in build/cmake: the C++ tests for ctest.
need_native_tests() {
  need_packages
  need_openexr
  need_interface
  if ! stamp_is "$ROOT/build/tests-key" "$(library_key)"; then
    locked "$ROOT/build/lock" bash "$ROOT/tools/setup/library.sh" all
  fi
  need_library
}

# need_core_tests: only the C++ tests' program, for a single suite of theirs.
need_core_tests() {
  need_packages
  need_openexr
  need_interface
  if ! stamp_is "$ROOT/build/core-tests-key" "$(library_key)"; then
    locked "$ROOT/build/lock" bash "$ROOT/tools/setup/library.sh" lobelight_tests
  fi
}

# import_key: what the import depends on: every file that the engine looks at, and the engine itself.
import_key() {
  local entries=("$ROOT"/*)
  local kept=() entry
  for entry in "${entries[@]}"; do
    case ${entry##*/} in
      build | gdextension | docs | tools | reports) ;;
      *) kept+=("$entry") ;;
    esac
  done
  echo "$(fingerprint "${kept[@]}" "$ROOT/tools/lib/check_scripts.gd") $GODOT"
}

# resource_key: what the import of resources depends on: of scripts and shaders only that they are there, and the lines by
# which a script becomes a class.
resource_key() {
  local kept=() entry
  for entry in "$ROOT"/*; do
    case ${entry##*/} in
      build | gdextension | docs | tools | reports) ;;
      *) kept+=("$entry") ;;
    esac
  done
  {
    find "${kept[@]}" -name build -prune -o -type f \( -name '*.gd' -o -name '*.gdshader' -o -name '*.gdshaderinc' \) -print \
      -o -type f -printf '%p %s %T@\n' | LC_ALL=C sort
    grep -rhE --include='*.gd' '^(class_name|extends|@tool|@icon|@abstract)' "${kept[@]}" | LC_ALL=C sort
    echo "$GODOT"
  } | sha256sum | cut -c 1-16
}

# need_resources: the project's resources imported. Scripts are not looked at.
need_resources() {
  need_engine
  need_library
  if ! stamp_is "$ROOT/.godot/lobelight-resource-key" "$(resource_key)"; then
    locked "$ROOT/build/lock" bash "$ROOT/tools/setup/import.sh" --resources
  fi
}

# need_import: the project's resources imported and every script of it free of errors.
need_import() {
  need_engine
  need_library
  if ! stamp_is "$ROOT/.godot/lobelight-import-key" "$(import_key)"; then
    locked "$ROOT/build/lock" bash "$ROOT/tools/setup/import.sh"
  fi
}

# need_mobile_compilers adreno|mali: sets MOBILE_ENGINE, the engine of Debian's package with its drivers, and
# MOBILE_COMPILERS or MOBILE_COMPILERS_MALI, where Mesa's no-op kernels are.
need_mobile_compilers() {
  local kind=$1 folder
  MOBILE_ENGINE=$CACHE/engine
  if [[ ! -x $MOBILE_ENGINE/godot ]] || ! stamp_is "$MOBILE_ENGINE/key" "$(engine_key)"; then
    need_packages
    locked "$CACHE/lock/engine" bash "$ROOT/tools/setup/engine.sh"
  fi
  # Of the engine's own Mesa or of another one: the kernels do nothing, so that either will do.
  folder=$CACHE/mobile-compilers/$kind-$(content_hash "$ROOT/tools/setup/mobile_compilers.sh" "$MOBILE_ENGINE/key")
  if [[ ! -f $folder/complete ]]; then
    need_packages
    locked "$CACHE/lock/mobile-compilers" bash "$ROOT/tools/setup/mobile_compilers.sh" "$kind" "$folder"
  fi
  if [[ $kind == mali ]]; then MOBILE_COMPILERS_MALI=$folder/root; else MOBILE_COMPILERS=$folder/root; fi
  export MOBILE_ENGINE MOBILE_COMPILERS MOBILE_COMPILERS_MALI
}

# need_template x86_64|arm64: the engine's export template of Debian's package; sets TEMPLATE, the folder that has it,
# for run_exported in tools/lib/export.sh.
need_template() {
  if [[ ! -x $CACHE/engine/godot ]] || ! stamp_is "$CACHE/engine/key" "$(engine_key)"; then
    need_packages
    locked "$CACHE/lock/engine" bash "$ROOT/tools/setup/engine.sh"
  fi
  TEMPLATE=$CACHE/templates/$1-$(content_hash "$ROOT/tools/setup/template.sh" "$CACHE/engine/key")
  if [[ ! -f $TEMPLATE/complete ]]; then
    need_packages
    locked "$CACHE/lock/template-$1" bash "$ROOT/tools/setup/template.sh" "$1" "$TEMPLATE"
  fi
  export TEMPLATE
}

# need_web_template: sets WEB_TEMPLATE, the folder with the engine's Web template: index.js, index.wasm and two worklets.
need_web_template() {
  WEB_TEMPLATE=$CACHE/templates/web-$(content_hash "$ROOT/tools/setup/web_template.sh" "$ROOT/tools/setup/web_template.txt")
  if [[ ! -f $WEB_TEMPLATE/complete ]]; then
    need_packages
    locked "$CACHE/lock/web-template" bash "$ROOT/tools/setup/web_template.sh" "$WEB_TEMPLATE"
  fi
  export WEB_TEMPLATE
}

# class_xml_key: what the scripts' class reference depends on.
class_xml_key() {
  echo "$(fingerprint "$ROOT/addons/lobelight/runtime" "$ROOT/tools/setup/class_xml.sh") $GODOT"
}

# need_class_xml: sets CLASS_XML, a folder with the class reference of the addon's scripts as the engine writes it.
need_class_xml() {
  need_engine
  CLASS_XML=$ROOT/build/class-xml
  if ! stamp_is "$CLASS_XML/key" "$(class_xml_key)"; then
    locked "$ROOT/build/class-xml.lock" bash "$ROOT/tools/setup/class_xml.sh" "$CLASS_XML"
  fi
}

# need_maths_font: sets MATHS_FONT, a font for equations and its licence.
need_maths_font() {
  local probes=("file /usr/share/fonts/opentype/stix-word/STIXMath-Regular.otf fonts-stix")
  if [[ -n $(missing_packages "${probes[@]}") ]]; then
    install_packages "${probes[@]}"
  fi
  # shellcheck disable=SC2034 # used by ./dev docs
  MATHS_FONT=(/usr/share/fonts/opentype/stix-word/STIXMath-Regular.otf /usr/share/doc/fonts-stix/copyright)
}

# need_browser: Chromium, and PYTHON with what drives it.
need_browser() {
  local probes=("file /usr/bin/chromium chromium")
  if [[ -n $(missing_packages "${probes[@]}") ]]; then
    install_packages "${probes[@]}"
  fi
  need_python web
}

# need_java: sets and exports JAVA_HOME, a JDK of at least 17, and makes sure of Maven.
need_java() {
  local probes=("command javac openjdk-17-jdk-headless" "command mvn maven")
  if [[ -n $(missing_packages "${probes[@]}") ]]; then
    install_packages "${probes[@]}"
  fi
  JAVA_HOME=$(dirname "$(dirname "$(readlink -f "$(command -v javac)")")")
  export JAVA_HOME
}

# need_android: sets ANDROID_KIT, the folder with the engine's Android template and the tools that sign and check.
need_android() {
  need_java
  ANDROID_KIT=$CACHE/android/$(content_hash "$ROOT/tools/setup/android.sh" "$ROOT/tools/android/artefacts.txt" \
    "$ROOT/tools/android/build_template.py")
  if [[ ! -f $ANDROID_KIT/complete ]]; then
    need_packages
    locked "$CACHE/lock/android" bash "$ROOT/tools/setup/android.sh" "$ANDROID_KIT"
  fi
  export ANDROID_KIT
}

# need_mitsuba: sets PYTHON with Mitsuba in it, and exports the LLVM through which that compiles. What Debian bookworm's
# default, 14, and 15 make of its code does not run.
need_mitsuba() {
  local probes=("file /usr/lib/*/libLLVM.so.19* libllvm19") llvm
  llvm=$(compgen -G "/usr/lib/*/libLLVM.so.[12][0-9].*" | sort -V | tail -n 1) || llvm=""
  if [[ -z ${DRJIT_LIBLLVM_PATH:-}$llvm ]]; then
    install_packages "${probes[@]}"
    llvm=$(compgen -G "/usr/lib/*/libLLVM.so.19*" | tail -n 1)
  fi
  export DRJIT_LIBLLVM_PATH=${DRJIT_LIBLLVM_PATH:-$llvm}
  need_python crosscheck
}
