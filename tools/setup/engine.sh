#!/usr/bin/env bash
# Godot from Debian, unpacked in the cache and made to run on this system: engine.sh
#
# The packages need a newer C library than most systems have. They are not installed: the whole closure, C library
# included, is unpacked, and the program's loader and library path are patched to it. So no root is needed, and what
# the engine starts runs with the system's own libraries, because no LD_LIBRARY_PATH is set.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$ROOT/tools/lib/debian.sh"

engine=$CACHE/engine
key=$(engine_key)
if [[ -x $engine/godot ]] && stamp_is "$engine/key" "$key"; then
  exit 0
fi

advice="LOBELIGHT_DEBIAN_MIRROR can name another mirror; or install Godot $GODOT_WANTED and set GODOT to its path."
work=$CACHE/engine.new
[[ -n $(command -v apt-get) && -n $(command -v dpkg-deb) ]] \
  || die "no Godot $GODOT_WANTED was found and there is no apt-get to fetch it; install it and set GODOT to its path"
if other=$(command -v godot); then
  say "$other is version $(godot_version "$other"), not $GODOT_WANTED: Debian's package is used."
fi
rm -rf "$work"

# Software drivers for both graphics interfaces: lavapipe (Vulkan) and llvmpipe (OpenGL).
packages=("godot=$GODOT_WANTED*" mesa-vulkan-drivers libgl1-mesa-dri libglx-mesa0 libegl-mesa0 libegl1 libgl1
  libvulkan1 fontconfig-config)

unpack() {
  local archives=("$work"/apt/cache/archives/*.deb) number=0 archive
  for archive in "${archives[@]}"; do
    number=$((number + 1))
    dpkg-deb --extract "$archive" "$work/root"
    rm "$archive"
    echo "[$number/${#archives[@]}] $(basename "$archive")"
  done
  rm -rf "$work/root/usr/share"/{doc,man,locale,lintian,info} "$work/apt"
}

# The program's RPATH (not RUNPATH) also holds for what its libraries load in turn, drivers included, unless one of
# them has a path of its own. Those few lose theirs; the folders below the library folder that they name (PulseAudio
# has one) join the program's.
patch_program() {
  local triplet library path folder search
  triplet=$(basename "$work/root/usr/lib"/*-linux-gnu*)
  folder=usr/lib/$triplet
  search=$engine/root/$folder
  for library in "$work/root/$folder"/*.so*; do
    [[ -f $library && ! -L $library ]] || continue
    path=$(patchelf --print-rpath "$library" 2>/dev/null) || continue
    [[ -n $path ]] || continue
    patchelf --remove-rpath "$library"
    if [[ $path == "/$folder/"* && $search != *"$path"* ]]; then
      search+=:$engine/root$path
    fi
  done
  patchelf --force-rpath --set-rpath "$search" \
    --set-interpreter "$engine/root/$folder/$(basename "$work/root/$folder"/ld-linux*.so.*)" \
    "$work/root/usr/bin/godot"
}

write_wrapper() {
  cat >"$work/godot" <<WRAPPER
#!/bin/sh
# Runs the unpacked Godot with the drivers that came with it: in software, unless LOBELIGHT_DISPLAY=real.
root='$engine/root'
WRAPPER
  cat >>"$work/godot" <<'WRAPPER'
if [ "${LOBELIGHT_DISPLAY:-own}" = real ]; then
  drivers=$(printf '%s:' "$root"/usr/share/vulkan/icd.d/*.json)
else
  drivers=$(echo "$root"/usr/share/vulkan/icd.d/lvp_icd*.json)
  export LIBGL_ALWAYS_SOFTWARE="${LIBGL_ALWAYS_SOFTWARE:-1}"
fi
export VK_DRIVER_FILES="${VK_DRIVER_FILES:-${drivers%:}}"
export __EGL_VENDOR_LIBRARY_DIRS="${__EGL_VENDOR_LIBRARY_DIRS:-$root/usr/share/glvnd/egl_vendor.d}"
export LIBGL_DRIVERS_PATH="${LIBGL_DRIVERS_PATH:-$(echo "$root"/usr/lib/*/dri)}"
if [ ! -e /etc/fonts/fonts.conf ]; then
  export FONTCONFIG_FILE="${FONTCONFIG_FILE:-$root/etc/fonts/fonts.conf}"
fi
exec "$root/usr/bin/godot" "$@"
WRAPPER
  chmod +x "$work/godot"
}

step --advice "$advice" "Looking for Godot $GODOT_WANTED in Debian" \
  use_suite_with "$work/apt" godot "$GODOT_WANTED" "${GODOT_SUITES[@]}"
export APT_CONFIG=$work/apt/apt.conf
cp "$work/apt/suite" "$work/suite"
step --advice "$advice" "Downloading Godot $GODOT_WANTED and what it needs (170 MB)" \
  apt-get install --yes --download-only "${packages[@]}"
step --advice "$advice" "Unpacking Godot" unpack
step --advice "$advice" "Pointing Godot at its own libraries" patch_program
write_wrapper

rm -rf "$engine"
mv "$work" "$engine"
version=$(godot_version "$engine/godot")
[[ $version == "$GODOT_WANTED".* ]] \
  || die "the unpacked Godot does not run here: $("$engine/godot" --version 2>&1 | tail -n 1). $advice"
write_stamp "$engine/key" "$key"
say "Godot $version is in $engine"
