#!/usr/bin/env bash
# Fetches Mesa's no-op kernels, with which its drivers compile for GPUs that are not there:
# mobile_compilers.sh adreno|mali DIRECTORY
#
# adreno: for the drivers that came with the engine. mali: an arm64 Mesa, because only there are those for Mali, a Python
# to run in it, and an emulator. Nothing is installed; apt checks what it fetches against Debian's signatures.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$ROOT/tools/lib/debian.sh"

(($# == 2)) || die "mobile_compilers.sh takes adreno or mali, and a directory"
kind=$1
target=$2
[[ ! -f $target/complete ]] || exit 0

advice="LOBELIGHT_DEBIAN_MIRROR can name another mirror."
[[ -n $(command -v apt-get) && -n $(command -v dpkg-deb) ]] || die "there is no apt-get to fetch Mesa's no-op kernels with"
work=$target.new
rm -rf "$work"
mkdir -p "$work"

# fetch_all PACKAGE…: with all that they depend on, unpacked into $work.
fetch_all() {
  apt-get update
  apt-get install --yes --download-only "$@"
  unpack "$APT_CACHE"/*.deb
}

# fetch_alone PACKAGE…: nothing else.
fetch_alone() {
  apt-get update
  cd "$APT_CACHE"
  apt-get download "$@"
  unpack "$APT_CACHE"/*.deb
}

unpack() {
  local archive number=0
  for archive in "$@"; do
    number=$((number + 1))
    dpkg-deb --extract "$archive" "$work/root"
    rm "$archive"
    echo "[$number/$#] $(basename "$archive")"
  done
  rm -rf "$work/root/usr/share"/{doc,man,locale,lintian,info}
}

# use_suite NAME [ARCHITECTURE]: a private apt below $work; sets APT_CACHE.
use_suite() {
  private_apt "$work/apt-$1" "deb forky"
  [[ -z ${2:-} ]] || echo "APT::Architecture \"$2\"; APT::Architectures { \"$2\"; };" >>"$APT_CONFIG"
  APT_CACHE=$work/apt-$1/cache/archives
}

if [[ $kind == adreno ]]; then
  use_suite shim
  step --advice "$advice" "Fetching Mesa's no-op kernels" fetch_alone mesa-drm-shim
else
  use_suite arm64 arm64
  step --advice "$advice" "Fetching an arm64 Mesa (63 MB)" \
    fetch_all mesa-drm-shim libgl1-mesa-dri libegl-mesa0 libegl1 python3-minimal libpython3-stdlib
  # Debian's package for the root's own links is not among them.
  [[ -e $work/root/lib ]] || ln -s usr/lib "$work/root/lib"
  use_suite emulator
  step --advice "$advice" "Fetching an emulator (73 MB)" fetch_alone qemu-user
  mv "$work/root/usr/bin/qemu-aarch64" "$work/root/qemu"
  rm -f "$work/root/usr/bin"/qemu-*
fi
rm -rf "$work"/apt-* "$target"
mv "$work" "$target"
touch "$target/complete"
