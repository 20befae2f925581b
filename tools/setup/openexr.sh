#!/usr/bin/env bash
# Builds static, position-independent OpenEXR and Imath from package sources: openexr.sh DIRECTORY [TARGET]
# They are installed into DIRECTORY; with TARGET (windows.x86_64, …) they are not for this system but for that one.
#
# Static, because neither the engine nor a user's machine can be expected to have them. Hidden, so that they cannot
# clash with another OpenEXR in the same process: "default visibility" drops their headers' export attributes, and
# CMake's preset then hides everything.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$ROOT/tools/lib/debian.sh"
# shellcheck source=tools/lib/sources.sh
source "$ROOT/tools/lib/sources.sh"

OPENEXR_VERSION=3.4.16
OPENEXR_SHA256=cc59a3ec182d0644e4ce99201d8ef1efcf64b0bdfdd0d49e87036457f1726f1d
IMATH_VERSION=3.1.12
IMATH_SHA256=8a1bc258f3149b5729c2f4f8ffd337c0e57f09096e4ba9784329f40c4a9035da

(($# == 1 || $# == 2)) || die "openexr.sh takes the directory to install into, and a system to build for"
target=$1
system=${2:-}
[[ ! -f $target/complete ]] || exit 0
downloads=$CACHE/downloads
openexr_archive=$downloads/openexr-$OPENEXR_VERSION.tar.gz
imath_archive=$downloads/imath_$IMATH_VERSION.orig.tar.gz
work=$CACHE/deps/build.$$
mkdir -p "$downloads" "$work"
trap 'rm -rf "$work"' EXIT
release=(-O2 -DNDEBUG)
options=()
if [[ -n $system ]]; then
  need_cross_compiler "$system"
  # Clang 20 wants another feature for the instructions of AVX-512 than these parts of libdeflate and OpenJPH name. The
  # folder's name must not get into the library, whose bytes are to be equal from build to build.
  release=(-DNDEBUG -DLIBDEFLATE_ASSEMBLER_DOES_NOT_SUPPORT_VPCLMULQDQ
    -DLIBDEFLATE_ASSEMBLER_DOES_NOT_SUPPORT_AVX512VNNI "-ffile-prefix-map=$work=.")
  options=("${CROSS[@]}" -DOJPH_DISABLE_AVX512=ON)
fi

# has_checksum FILE SHA256: a file that is there but differs is removed, so that it is fetched again.
has_checksum() {
  [[ -f $1 ]] || return 1
  if ! sha256sum --check --status <<<"$2  $1"; then
    rm -f "$1"
    return 1
  fi
}

# CMake, Ninja and the packages that pip runs on OpenEXR's archive, which are all pinned.
fetch_tools() {
  "$PYTHON" -m pip install --disable-pip-version-check --no-deps --only-binary :all: --require-hashes \
    --target "$work/tools" --requirement "$ROOT/tools/setup/openexr.txt"
  "$work/tools/cmake/data/bin/cmake" --version
}

fetch_openexr() {
  # pip asks the archive for its version on the way. Told so, the archive answers without running CMake, which would
  # look for Imath in the system and then on the net.
  echo "OpenEXR==$OPENEXR_VERSION --hash=sha256:$OPENEXR_SHA256" >"$work/openexr.txt"
  OPENEXR_RELEASE_CANDIDATE_TAG=v$OPENEXR_VERSION PYTHONPATH=$work/tools "$PYTHON" -m pip download \
    --disable-pip-version-check --no-deps --no-build-isolation --no-binary OpenEXR --require-hashes \
    --dest "$downloads" --requirement "$work/openexr.txt"
  has_checksum "$openexr_archive" "$OPENEXR_SHA256"
}

# Stable Debian has it for years; what is older or newer may have the same archive.
fetch_imath() {
  fetch_source "$downloads" imath "imath_$IMATH_VERSION.orig.tar.gz" "$IMATH_SHA256" \
    trixie forky sid bookworm-backports trixie-backports
}

# build NAME ARCHIVE OPTION…: unpack, configure, build, install below $work/installed.
build() {
  local name=$1 archive=$2
  shift 2
  mkdir "$work/$name"
  tar --extract --file "$archive" --directory "$work/$name" --strip-components 1
  cmake -S "$work/$name" -B "$work/$name-build" -G Ninja \
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS_RELEASE=${release[*]}" "-DCMAKE_CXX_FLAGS_RELEASE=${release[*]}" \
    -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
    -DCMAKE_C_VISIBILITY_PRESET=hidden -DCMAKE_CXX_VISIBILITY_PRESET=hidden -DCMAKE_VISIBILITY_INLINES_HIDDEN=ON \
    -DCMAKE_INSTALL_PREFIX="$target" -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_PREFIX_PATH="$work/installed$target" \
    "${options[@]}" "$@"
  cmake --build "$work/$name-build" --parallel "$JOBS"
  DESTDIR="$work/installed" cmake --install "$work/$name-build"
}

build_imath() {
  build imath "$imath_archive" -DIMATH_USE_DEFAULT_VISIBILITY=ON -DIMATH_INSTALL_PKG_CONFIG=OFF -DPYTHON=OFF
}

build_openexr() {
  build openexr "$openexr_archive" -DOPENEXR_USE_DEFAULT_VISIBILITY=ON -DOPENEXR_INSTALL_PKG_CONFIG=OFF \
    -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_TOOLS=OFF -DOPENEXR_BUILD_EXAMPLES=OFF -DOPENEXR_INSTALL_DOCS=OFF \
    -DOPENEXR_BUILD_PYTHON=OFF -DOPENEXR_TEST_LIBRARIES=OFF -DOPENEXR_TEST_TOOLS=OFF -DOPENEXR_TEST_PYTHON=OFF \
    -DOPENEXR_FORCE_INTERNAL_DEFLATE=ON -DOPENEXR_FORCE_INTERNAL_OPENJPH=ON \
    -DImath_DIR="$work/installed$target/lib/cmake/Imath"
}

need_python ""
step --advice "Is the Python package index reachable?" "Fetching CMake and Ninja (29 MB)" fetch_tools
export PATH=$work/tools/cmake/data/bin:$work/tools/bin:$PATH
offline="Or put that file, with SHA-256"
has_checksum "$openexr_archive" "$OPENEXR_SHA256" \
  || step --advice "$offline $OPENEXR_SHA256, at $openexr_archive." "Fetching the source of OpenEXR $OPENEXR_VERSION" \
    fetch_openexr
has_checksum "$imath_archive" "$IMATH_SHA256" \
  || step --advice "$offline $IMATH_SHA256, at $imath_archive." "Fetching the source of Imath $IMATH_VERSION" \
    fetch_imath
step "Building Imath $IMATH_VERSION${system:+ for $system}" build_imath
step "Building OpenEXR $OPENEXR_VERSION${system:+ for $system}" build_openexr

rm -rf "$target"
mkdir -p "$(dirname "$target")"
mv "$work/installed$target" "$target"
touch "$target/complete"
