#!/usr/bin/env bash
# Fetches the engine's export template for Linux: template.sh x86_64|arm64 DIRECTORY
#
# x86_64: runs with the libraries that came with the engine in the cache. arm64: with libraries of its own and an
# emulator, which show that an exported project runs on a phone's kind of processor. Nothing is installed; apt checks
# what it fetches against Debian's signatures.
#
# The debug template, because it checks more, and because Debian's release template of 4.6.3 reports an error for every
# child of every Container at its end, in a project of one Label too.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$ROOT/tools/lib/debian.sh"

(($# == 2)) || die "template.sh takes x86_64 or arm64, and a directory"
architecture=$1
target=$2
[[ ! -f $target/complete ]] || exit 0

advice="LOBELIGHT_DEBIAN_MIRROR can name another mirror."
[[ -n $(command -v apt-get) && -n $(command -v dpkg-deb) ]] \
  || die "there is no apt-get to fetch the engine's export template with"
work=$target.new
rm -rf "$work"
mkdir -p "$work"

# use_suite NAME [ARCHITECTURE]: a private apt below $work for the suite that the engine is from; sets APT_CACHE.
use_suite() {
  private_apt "$work/apt-$1" "deb $(<"$CACHE/engine/suite")"
  [[ -z ${2:-} ]] || echo "APT::Architecture \"$2\"; APT::Architectures { \"$2\"; };" >>"$APT_CONFIG"
  APT_CACHE=$work/apt-$1/cache/archives
}

# fetch_alone PACKAGE: nothing that it depends on.
fetch_alone() {
  apt-get update
  cd "$APT_CACHE"
  apt-get download "$1"
  unpack "$APT_CACHE"/*.deb
}

fetch_all() {
  apt-get update
  apt-get install --yes --download-only "$1"
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

if [[ $architecture == x86_64 ]]; then
  use_suite template amd64
  step --advice "$advice" "Fetching the export template (22 MB)" fetch_alone "godot-template-debug=$GODOT_WANTED*"
  engine=$CACHE/engine/root/usr/bin/godot
  patchelf --force-rpath --set-rpath "$(patchelf --print-rpath "$engine")" \
    --set-interpreter "$(patchelf --print-interpreter "$engine")" "$work/root/usr/bin/godot-template-debug"
elif [[ $architecture == arm64 ]]; then
  use_suite template arm64
  step --advice "$advice" "Fetching an export template for arm64 (93 MB)" \
    fetch_all "godot-template-debug=$GODOT_WANTED*"
  # Debian's package for the root's own links is not among them.
  [[ -e $work/root/lib ]] || ln -s usr/lib "$work/root/lib"
  use_suite emulator
  step --advice "$advice" "Fetching an emulator (73 MB)" fetch_alone qemu-user
  mv "$work/root/usr/bin/qemu-aarch64" "$work/root/qemu"
  rm -f "$work/root/usr/bin"/qemu-*
else
  die "there is no export template for '$architecture'; take x86_64 or arm64"
fi
rm -rf "$work"/apt-* "$target"
mv "$work" "$target"
touch "$target/complete"
