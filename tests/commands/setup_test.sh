#!/usr/bin/env bash
# What the set-up does where the outside changes: other revisions and suites of Debian, an engine that is not there, an
# installed godot-cpp, a clone that was moved. Nothing is fetched, and nothing compiled but CMake's own checks.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/lib/common.sh"
source "$ROOT/tools/lib/debian.sh"
# shellcheck source=tools/lib/sources.sh
source "$ROOT/tools/lib/sources.sh"

need_packages
need_openexr
need_interface
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0

# expect NAME COMMAND…: one check, in a shell of its own; its output is shown only when it fails.
expect() {
  local name=$1 status=0
  shift
  ("$@") >"$work/check.log" 2>&1 || status=$?
  if ((status == 0)); then
    passed=$((passed + 1))
    echo "  $name: passed"
  else
    failed=$((failed + 1))
    echo "  $name: FAILED"
    tail -n 20 "$work/check.log" | sed 's/^/    | /'
  fi
}

# Programs in apt's place: a folder of $mirror is a suite, with Packages, Sources and for each version the archive.
mirror=$work/mirror
mkdir "$work/bin"
cat >"$work/bin/apt-get" <<'FAKE'
#!/usr/bin/env bash
set -eu
[[ $1 != indextargets ]] || exit 0
suite=$FAKE_MIRROR/$(awk '{ print $4 }' "$(dirname "$APT_CONFIG")/sources.list")
case $1 in
  update) [[ -d $suite ]] ;;
  source) cp "$suite/${*: -1}"/* . ;;
  *) exit 1 ;;
esac
FAKE
cat >"$work/bin/apt-cache" <<'FAKE'
#!/usr/bin/env bash
suite=$FAKE_MIRROR/$(awk '{ print $4 }' "$(dirname "$APT_CONFIG")/sources.list")
case $1 in
  showsrc) cat "$suite/Sources" ;;
  madison) cat "$suite/Packages" ;;
esac
FAKE
chmod +x "$work/bin"/apt-*

# publish SUITE VERSION CONTENT [SHA256]: the package "lamp" in that version, with what its description says of it.
publish() {
  local folder=$mirror/$1/lamp=$2 checksum
  mkdir -p "$folder"
  printf '%s' "$3" >"$folder/lamp_1.orig.tar.gz"
  checksum=${4:-$(sha256sum "$folder/lamp_1.orig.tar.gz" | cut -d ' ' -f 1)}
  printf 'Package: lamp\nBinary: lamp, lamp-dev\nVersion: %s\nChecksums-Sha256:\n %s 7 lamp_1.orig.tar.gz\n\n' \
    "$2" "$checksum" >>"$mirror/$1/Sources"
}
wanted=$(printf 'wanted' | sha256sum | cut -d ' ' -f 1)

# use_fakes: what follows in this shell gets Debian from $mirror.
use_fakes() {
  export PATH=$work/bin:$PATH FAKE_MIRROR=$mirror LOBELIGHT_DEBIAN_MIRROR=http://mirror.invalid/debian
}

# fetch SUITE…: as the set-up does; the archive then lies in $work/got.
fetch() {
  rm -rf "$work/got"
  mkdir "$work/got"
  use_fakes
  fetch_source "$work/got" lamp lamp_1.orig.tar.gz "$wanted" "$@"
}
fetched() {
  fetch "$@" && [[ $(ls "$work/got") == lamp_1.orig.tar.gz && $(<"$work/got/lamp_1.orig.tar.gz") == wanted ]]
}
not_fetched() {
  local said
  said=$(fetch "$@") && return 1
  grep -qF "No suite of $* has lamp_1.orig.tar.gz with the SHA-256 $wanted." <<<"$said" && [[ -z $(ls "$work/got") ]]
}

publish old 1-1 wanted
publish moved 1-2 other
publish moved 1-7~bpo1 wanted
publish newer 2-1 other
publish liar 1-1 other "$wanted"
expect "an archive of the first suite" fetched old
expect "an archive of another revision" fetched moved
expect "an archive of another suite" fetched newer moved
expect "a suite that is gone is passed over" fetched gone old
expect "an archive that is not what is said of it is passed over" fetched liar old
expect "no suite has it: a sentence, and nothing is left" not_fetched gone newer liar

# offer SUITE VERSION: the program "lantern" in that version, as apt-cache madison lists it.
offer() {
  mkdir -p "$mirror/$1"
  printf '   lantern | %s | http://mirror.invalid/debian %s/main amd64 Packages\n' "$2" "$1" >>"$mirror/$1/Packages"
}
# suite_with WANTED SUITE…: version 4.6 of the program is taken from the suite WANTED.
suite_with() {
  local wanted=$1
  shift
  use_fakes
  use_suite_with "$work/apt" lantern 4.6 "$@" && [[ $(<"$work/apt/suite") == "$wanted" ]] \
    && grep -q " $wanted main$" "$work/apt/sources.list"
}
no_suite() {
  local said
  use_fakes
  said=$(use_suite_with "$work/apt" lantern 4.6 "$@") && return 1
  grep -qxF "No suite of $* has lantern 4.6." <<<"$said"
}
offer testing 4.6.3+ds-2
offer later 4.7.1+ds-1
offer later 4.60-1
offer unstable 4.7.1+ds-2
offer unstable 1:4.6.5+ds-1
expect "a program of the first suite" suite_with testing testing unstable
expect "a suite that has moved on is passed over" suite_with unstable later unstable
expect "no suite has the version: a sentence" no_suite later gone

# engine VERSION: a program that reports it.
engine() {
  printf '#!/bin/sh\necho %s\n' "$1" >"$work/bin/engine-$1"
  chmod +x "$work/bin/engine-$1"
  echo "$work/bin/engine-$1"
}
# takes_engine VERSION: as GODOT, which is set by hand.
takes_engine() {
  GODOT=$(engine "$1") LOBELIGHT_ENGINE_READY="" LOBELIGHT_CACHE=$work/cache \
    bash -c 'source "$1/tools/lib/common.sh"; need_engine' - "$ROOT"
}
refuses_engine() {
  local said
  said=$(takes_engine "$1" 2>&1) && return 1
  grep -F "reports version '$1', but this project needs Godot 4.6 or later" <<<"$said"
}
expect "an engine of the wanted version" takes_engine 4.6.5.stable
expect "a later one, where it is set by hand" takes_engine 4.10.beta1
expect "an engine that is too old is refused" refuses_engine 4.5.1.stable
expect "one of the next generation is refused" refuses_engine 5.0.stable

# configure FOLDER OPTION…: CMake alone, without ./dev.
configure() {
  local build=$1
  shift
  cmake -S "$ROOT/gdextension" -B "$build" -G Ninja -DLOBELIGHT_DEPS_DIR="$OPENEXR_DIR" "$@"
}

# A godot-cpp as a package manager installs it.
package=$work/installed/lib/cmake/godot-cpp
mkdir -p "$package"
echo 'add_library(godot-cpp::godot-cpp INTERFACE IMPORTED)' >"$package/godot-cppConfig.cmake"
interface=-DLOBELIGHT_GDEXTENSION_INTERFACE=$GODOT_INTERFACE
cross=(-DCMAKE_SYSTEM_NAME=Linux "-DCMAKE_SYSTEM_PROCESSOR=$(uname -m)")

takes_package() {
  configure "$work/native" "-DCMAKE_PREFIX_PATH=$work/installed" "$interface" | grep -F -- "-- godot-cpp: package in $package"
}
takes_subset() {
  configure "$work/cross" "${cross[@]}" "-DCMAKE_PREFIX_PATH=$work/installed" "$interface" \
    | grep -F -- "-- godot-cpp: the subset in"
}
expect "an installed godot-cpp is used" takes_package
expect "builds for other systems do not use it" takes_subset

# Without an engine on the PATH, and without its interface.
configure_without_engine() {
  configure "$work/bare" "${cross[@]}" -DCMAKE_DISABLE_FIND_PACKAGE_godot-cpp=ON -DLOBELIGHT_GODOT=LOBELIGHT_GODOT-NOTFOUND \
    -DCMAKE_PROGRAM_PATH= -DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF "-DCMAKE_CXX_COMPILER=$(command -v g++)" \
    "-DCMAKE_C_COMPILER=$(command -v gcc)" "-DCMAKE_MAKE_PROGRAM=$(command -v ninja)"
}
says_how() {
  configure_without_engine | tee /dev/stderr | grep -F "godot --headless --dump-gdextension-interface"
}
library_is_refused() {
  local said
  said=$(cmake --build "$work/bare" --target lobelight_library) && return 1
  grep -F LOBELIGHT_GDEXTENSION_INTERFACE <<<"$said"
}
core_can_be_built() {
  ninja -C "$work/bare" -n lobelight_core lobelight_tests
}
wrong_interface() {
  local said
  said=$(configure "$work/wrong" "${cross[@]}" -DLOBELIGHT_GDEXTENSION_INTERFACE=/absent/gdextension_interface.h 2>&1) && return 1
  grep -F "/absent/gdextension_interface.h" <<<"$said"
}
expect "without an engine CMake says how to get its interface" says_how
expect "the library says so, too" library_is_refused
expect "the core and its tests do not need it" core_can_be_built
expect "an interface that is not there is named" wrong_interface

# A clone that was built in one place and then moved.
mkdir -p "$work/one/addons/lobelight"
cp -r "$ROOT/gdextension" "$ROOT/tools" "$work/one"
cp -r "$ROOT/addons/lobelight/doc_classes" "$work/one/addons/lobelight"
# build_files CLONE: configures as ./dev does.
build_files() {
  bash -c 'source "$1/tools/lib/common.sh"; need_openexr; configure_native "$ROOT/build/cmake"' - "$1" \
    && grep -qx "CMAKE_HOME_DIRECTORY:INTERNAL=$1/gdextension" "$1/build/cmake/CMakeCache.txt"
}
again_keeps() {
  touch "$work/one/build/cmake/kept"
  build_files "$work/one" && [[ -f $work/one/build/cmake/kept ]]
}
after_a_move() {
  mv "$work/one" "$work/two" && build_files "$work/two" && [[ ! -f $work/two/build/cmake/kept ]]
}
expect "a clone is configured" build_files "$work/one"
expect "a second time keeps what was built" again_keeps
expect "a clone that was moved begins anew" after_a_move

echo "setup: $passed passed, $failed failed"
((failed == 0))
