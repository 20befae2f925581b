#!/usr/bin/env bash
# exports the demo for Android and checks it: a pack, run on x86-64 and emulated arm64, and a signed APK ([--out DIR])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/demo_tables.sh
source "$ROOT/tools/lib/demo_tables.sh"
# shellcheck source=tools/lib/export.sh
source "$ROOT/tools/lib/export.sh"

# Frames that the exported demo runs for; it takes the light of its environment in the first.
FRAMES=30

usage() {
  cat <<USAGE
usage: ./dev android [--out DIR] [--pack-only] [--json FILE]

--out DIR      where lobelight.pck and lobelight.apk go (default: build/android)
--pack-only    no APK
--json FILE    what was checked, and how many bytes of the pack are the addon's

Exports the demo with the preset "Android" of export_presets.cfg, passing the engine's output through. A line of error
or warning, from the export or from the pack as it runs, is a failure; so is a file in the pack that a player does not
need. Emulation (qemu) covers the processor, not a phone's GPU: the demo runs without a renderer.

The APK is made with a template put together from published packages, whose checksums are pinned, in the cache, with
no Android SDK. Checked are its signature, manifest, processor, alignment and pages of 16 KB; it has never been
launched. The first time fetches 400 MB. It is signed with the key that GODOT_ANDROID_KEYSTORE_RELEASE_PATH, _USER and
_PASSWORD name, otherwise with one that is made in the cache, for trying out only.
LOBELIGHT_MAVEN_SETTINGS names another settings.xml for Maven.
USAGE
}

out=$ROOT/build/android
json=""
with_apk=true
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --pack-only) with_apk=false ;;
    --out | --json)
      [[ -n ${2:-} ]] || die "android: $1 needs a value"
      case $1 in
        --out) out=$(realpath -m -- "$2") ;;
        --json) json=$(realpath -m -- "$2") ;;
      esac
      shift
      ;;
    *) die "android: there is no option '$1'; ./dev android --help lists them" ;;
  esac
  shift
done
prepare_export android "$out" "$json"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check NAME COMMAND…: one check, with its output passed through. `set -e` is off inside COMMAND.
results=()
failed=0
check() {
  local name=$1 passed=true
  shift
  say "== $name"
  "$@" || passed=false
  $passed || failed=$((failed + 1))
  results+=("{\"name\": \"$name\", \"passed\": $passed}")
}

export_pack() {
  rm -f "$out/lobelight.pck"
  quiet_engine flock --close "$EXPORT_LOCK" "$GODOT" --headless --path "$ROOT" --export-pack Android "$out/lobelight.pck"
}

list_pack() {
  expect_pack "$out/lobelight.pck" --present 'demo/demo.tscn' --present 'demo/build/tables/thesis_8.res' \
    --present 'bake/comparators/toral.gdshaderinc' --absent 'bake/*.gd' --absent 'bake/*.gdc' --absent 'bake/*.gd.remap' \
    --absent 'bake/*.json' --absent 'tests/*' --absent 'tools/*' --absent 'demo/commands/*' --sizes "$out/sizes.json"
}

# run_demo ARCHITECTURE: the pack alone. Without its tables the demo goes on, and says so.
run_demo() {
  run_exported "$1" "$out/lobelight.pck" --quit-after "$FRAMES" | tee "$out/run_$1.log" || return 1
  ! grep -q "Tables are missing" "$out/run_$1.log"
}

# The key is for trying out: whoever has the cache can sign with it.
use_keystore() {
  [[ -z ${GODOT_ANDROID_KEYSTORE_RELEASE_PATH:-} ]] || return 0
  export GODOT_ANDROID_KEYSTORE_RELEASE_PATH=$CACHE/android/trial.keystore
  export GODOT_ANDROID_KEYSTORE_RELEASE_USER=lobelight GODOT_ANDROID_KEYSTORE_RELEASE_PASSWORD=lobelight
  [[ -f $GODOT_ANDROID_KEYSTORE_RELEASE_PATH ]] || "$JAVA_HOME/bin/keytool" -genkeypair -alias lobelight \
    -keystore "$GODOT_ANDROID_KEYSTORE_RELEASE_PATH" -storepass lobelight -keyalg RSA -keysize 3072 -validity 10000 \
    -dname "CN=Lobelight trial key" 2>/dev/null
}

# The engine finds the kit by settings and template folder of its own: the user's are left alone.
export_apk() {
  local home=$work/home version templates status=0
  version=$("$GODOT" --version | grep -oE '^[0-9.]+\.[a-z]+')
  [[ $version == "$(cat "$ANDROID_KIT/version")" ]] || {
    say "the template is Godot $(cat "$ANDROID_KIT/version")'s, but the engine is $version"
    return 1
  }
  templates=$home/data/godot/export_templates/$version
  mkdir -p "$templates" "$home/config/godot"
  ln -s "$ANDROID_KIT/android_release.apk" "$templates/android_release.apk"
  printf '[gd_resource type="EditorSettings" format=3]\n\n[resource]\n%s = "%s"\n%s = "%s"\n' \
    export/android/android_sdk_path "$ANDROID_KIT/sdk" export/android/java_sdk_path "$JAVA_HOME" \
    >"$home/config/godot/editor_settings-$GODOT_WANTED.tres"
  rm -f "$out/lobelight.apk" "$out/lobelight.apk.idsig"
  use_keystore
  XDG_CONFIG_HOME=$home/config XDG_DATA_HOME=$home/data \
    quiet_engine flock --close "$EXPORT_LOCK" "$GODOT" --headless --path "$ROOT" --export-release Android "$out/lobelight.apk" || status=$?
  return "$status"
}

list_apk() {
  expect_pack "$out/lobelight.apk" --present 'demo/demo.tscn' --absent 'bake/*.json' --absent 'tests/*'
}

check_apk() {
  "$PYTHON" "$ROOT/tools/android/check_apk.py" "$out/lobelight.apk" --sdk "$ANDROID_KIT/sdk" \
    --package org.lobelight.demo
}

check "the export writes no error and no warning" export_pack
if ((failed == 0)); then
  check "the pack has what the demo needs, and nothing of the editor" list_pack
  check "it runs on x86-64" run_demo x86_64
  check "it runs on arm64, emulated" run_demo arm64
fi
if $with_apk && ((failed == 0)); then
  need_android
  check "the APK is exported and signed" export_apk
  check "it has the same files" list_apk
  check "its signature, manifest, processor, alignment and pages are right" check_apk
fi

checks=$(printf '%s, ' "${results[@]}")
if [[ -n $json ]]; then
  printf '{"pack": "%s", "sizes": %s, "failed": %d, "checks": [%s]}\n' "$out/lobelight.pck" \
    "$(cat "$out/sizes.json" 2>/dev/null || echo null)" "$failed" "${checks%, }" >"$json.$$"
  mv -f "$json.$$" "$json"
fi
for result in "${results[@]}"; do
  sed -E 's/.*"name": "(.*)", "passed": true.*/  \1: passed/; s/.*"name": "(.*)", "passed": false.*/  \1: FAILED/' \
    <<<"$result"
done
if $with_apk; then echo "$out/lobelight.apk"; else echo "$out/lobelight.pck"; fi
echo "android: $((${#results[@]} - failed)) passed, $failed failed"
((failed == 0))
