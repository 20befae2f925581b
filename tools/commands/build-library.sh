#!/usr/bin/env bash
# builds the editor's library with this system's compiler, godot-cpp and packages of vcpkg (--vcpkg DIR; also on macOS and Windows)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/portable.sh"

usage() {
  cat <<'USAGE'
usage: ./dev build-library --vcpkg DIR

DIR is a clone of vcpkg. It builds what gdextension/vcpkg.json names, godot-cpp among it; CMake then builds the
library, in build/system, and installs it in addons/lobelight/bin. It needs git, CMake 3.22 and Python 3, and Ninja with GCC
or Clang on Linux, Xcode's tools on macOS, Visual Studio 2022 with its Clang on Windows.

On Linux ./dev setup does without all this, and ./dev package --all builds what is released, for every system: this is for
those who build on their own macOS or Windows, and for the workflows that check that it can be done.
USAGE
}

vcpkg=""
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --vcpkg)
      [[ -n ${2:-} ]] || die "build-library: --vcpkg needs a folder"
      vcpkg=$2
      shift
      ;;
    *) die "build-library: there is no option '$1'" ;;
  esac
  shift
done
[[ -n $vcpkg ]] || die "build-library: --vcpkg is missing"
toolchain=scripts/buildsystems/vcpkg.cmake
[[ -f $vcpkg/$toolchain ]] || die "build-library: $vcpkg is no clone of vcpkg, which has $toolchain"
vcpkg=$(cd "$vcpkg" && pwd)
system=$(host_system)
architecture=$(host_architecture)
root=$ROOT

arch=x64
[[ $architecture == x86_64 ]] || arch=arm64
options=(-DCMAKE_BUILD_TYPE=Release)
case $system in
  linux)
    triplet=$arch-linux
    options+=(-G Ninja)
    ;;
  macos)
    triplet=$arch-osx
    options+=(-G "Unix Makefiles")
    ;;
  windows)
    # As godot-cpp has it: the C++ runtime is linked into the library.
    triplet=$arch-windows-static
    [[ $arch == arm64 ]] && platform=ARM64 || platform=x64
    options+=(-G "Visual Studio 17 2022" -A "$platform" -T ClangCL -DCMAKE_MSVC_RUNTIME_LIBRARY=MultiThreaded)
    # CMake does not know the paths of Git's Bash.
    vcpkg=$(cygpath -m "$vcpkg")
    root=$(cygpath -m "$ROOT")
    ;;
esac

if [[ ! -x $vcpkg/vcpkg && ! -x $vcpkg/vcpkg.exe ]]; then
  say "Building vcpkg …"
  if [[ $system == windows ]]; then
    cmd.exe /c "$(cygpath -w "$vcpkg/bootstrap-vcpkg.bat")" -disableMetrics >&2
  else
    bash "$vcpkg/bootstrap-vcpkg.sh" -disableMetrics >&2
  fi
fi

build=$root/build/system
mkdir -p "$ROOT/build"
[[ -z ${VCPKG_DEFAULT_BINARY_CACHE:-} ]] || mkdir -p "$VCPKG_DEFAULT_BINARY_CACHE"
touch "$ROOT/build/.gdignore"
cmake -S "$root/gdextension" -B "$build" "${options[@]}" -DCMAKE_TOOLCHAIN_FILE="$vcpkg/$toolchain" \
  -DVCPKG_TARGET_TRIPLET="$triplet" -DVCPKG_INSTALLED_DIR="$build/packages"
cmake --build "$build" --config Release --target lobelight_library --parallel
cmake --install "$build" --config Release
say "The library is in addons/lobelight/bin."
