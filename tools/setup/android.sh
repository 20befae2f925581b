#!/usr/bin/env bash
# Puts together what an APK is exported with, the engine's template and the tools: android.sh DIRECTORY
#
# From published packages: the engine's library for Android and what it needs through Maven, the app's sources and
# aapt2 and apksigner from Debian forky (bookworm's aapt2 crashes on these resources). Nothing of them is installed.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$ROOT/tools/lib/debian.sh"
# shellcheck source=tools/lib/sources.sh
source "$ROOT/tools/lib/sources.sh"

# Of the version of the engine's library in tools/android/artefacts.txt.
GODOT_SOURCE=godot_4.6.3+ds.orig.tar.xz
GODOT_SOURCE_SHA256=2c7f6b7b2566182869d3f50829b8260179137ff169c34026640f9e8f9c3c0506

(($# == 1)) || die "android.sh takes the directory to put things into"
target=$1
[[ ! -f $target/complete ]] || exit 0
need_python ""
need_java

work=$target.new
rm -rf "$work"
mkdir -p "$work/packages"
libraries=$target/tools/usr/lib/$(uname -m)-linux-gnu
build_tools=$work/sdk/build-tools/debian
private_apt "$work/apt" "deb forky"

fetch_tools() {
  local archive number=0 archives
  apt-get update
  apt-get install --yes --download-only aapt
  cd "$work/apt/cache/archives"
  apt-get download apksigner
  archives=(./*.deb)
  for archive in "${archives[@]}"; do
    number=$((number + 1))
    dpkg-deb --extract "$archive" "$work/tools"
    rm "$archive"
    echo "[$number/${#archives[@]}]"
  done
  rm -rf "$work/tools/usr/share"/{doc,man,locale,lintian,info}
}

fetch_app() {
  fetch_source "$work" godot "$GODOT_SOURCE" "$GODOT_SOURCE_SHA256" forky sid trixie trixie-backports
  mkdir "$work/source"
  tar --extract --file "$work/$GODOT_SOURCE" --directory "$work/source" --strip-components 1 \
    --wildcards '*/platform/android/java/app/*'
  mv "$work/source/platform/android/java/app" "$work/app"
  rm -rf "$work/source" "${work:?}/$GODOT_SOURCE"
}

# The folders that the engine looks for. adb is only asked for devices, and there is none.
make_sdk() {
  local aapt2 library
  # A library with a search path of its own does not look at the program's.
  for library in "$work/tools/usr/lib"/*-linux-gnu/*.so* "$work/tools/usr/lib"/*-linux-gnu/android/*.so*; do
    [[ ! -f $library || -L $library ]] || patchelf --remove-rpath "$library" 2>/dev/null || true
  done
  aapt2=$work/tools/usr/lib/android-sdk/build-tools/debian/aapt2
  patchelf --force-rpath --set-rpath "$libraries:$libraries/android:$target/tools/usr/lib/7zip" \
    --set-interpreter "$(compgen -G "$work/tools/usr/lib/*-linux-gnu/ld-linux*.so.*" | head -n 1 \
      | sed "s|^$work|$target|")" "$aapt2"
  mkdir -p "$build_tools" "$work/sdk/platform-tools"
  mv "$aapt2" "$build_tools/aapt2"
  cp -L "$work/tools/usr/share/java/apksigner.jar" "$build_tools/apksigner.jar"
  cat >"$build_tools/apksigner" <<'WRAPPER'
#!/bin/sh
exec "${JAVA_HOME:+$JAVA_HOME/bin/}java" -jar "$(dirname "$0")/apksigner.jar" "$@"
WRAPPER
  printf '#!/bin/sh\necho "List of devices attached"\n' >"$work/sdk/platform-tools/adb"
  chmod +x "$build_tools/apksigner" "$work/sdk/platform-tools/adb"
}

fetch_packages() {
  "$PYTHON" "$ROOT/tools/android/fetch_artefacts.py" "$work/packages"
}

build_template() {
  "$PYTHON" "$ROOT/tools/android/build_template.py" --packages "$target/packages" --app "$target/app" \
    --aapt2 "$target/sdk/build-tools/debian/aapt2" --java "$JAVA_HOME" --work "$target/build" \
    --out "$target/android_release.apk"
}

step --advice "LOBELIGHT_DEBIAN_MIRROR can name another mirror." "Fetching aapt2 and apksigner" fetch_tools
step --advice "LOBELIGHT_DEBIAN_MIRROR can name another mirror." "Fetching the app's sources (34 MB)" fetch_app
step --advice "LOBELIGHT_MAVEN_SETTINGS can name a settings.xml with a mirror." \
  "Fetching the engine for Android (270 MB)" fetch_packages
step "Setting up the tools" make_sdk
rm -rf "$work/apt" "$target"
# aapt2 has its libraries' final place written into it.
mv "$work" "$target"
step "Building the Android template" build_template
rm -rf "$target/packages" "$target/app"
# As the engine names its folder of templates.
sed -n 's/.*org.godotengine:godot:\(.*\):aar$/\1/p' "$ROOT/tools/android/artefacts.txt" >"$target/version"
touch "$target/complete"
