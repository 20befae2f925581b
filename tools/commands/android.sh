#!/usr/bin/env bash
# exports the demo for Android and checks it: the pack, which is run on x86-64 and on an emulated arm64 ([--out DIR])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/demo_tables.sh
source "$ROOT/tools/lib/demo_tables.sh"
# shellcheck source=tools/lib/export.sh
source "$ROOT/tools/lib/export.sh"

# Frames that the exported demo runs for; it takes the light of its environment in the first.
FRAMES=30

usage() {
  cat <<USAGE
usage: ./dev android [--out DIR] [--json FILE]

--out DIR      where lobelight.pck goes (default: build/android)
--json FILE    what was checked, and how many bytes of the pack are the addon's

Exports the demo with the preset "Android" of export_presets.cfg, passing the engine's output through. A line of error
or warning, from the export or from the pack as it runs, is a failure; so is a file in the pack that a player does not
need. Emulation (qemu) covers the processor, not a phone's GPU: the demo runs without a renderer. No APK is made yet.
USAGE
}

out=$ROOT/build/android
json=""
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
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
[[ -z $json || -d $(dirname -- "$json") ]] || die "android: $json: its folder does not exist"
[[ ! -e $out || -d $out ]] || die "android: $out is not a folder"

need_engine
need_python
need_library
need_import
mkdir -p "$out" || die "android: $out: the folder cannot be made"
bake_demo_tables 4 8 16

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
  quiet_engine "$GODOT" --headless --path "$ROOT" --export-pack Android "$out/lobelight.pck"
}

list_pack() {
  expect_pack "$out/lobelight.pck" --present 'demo/demo.tscn' --present 'demo/build/tables/brushed_ward_8.res' \
    --absent 'bake/*' --absent 'tests/*' --absent 'tools/*' --absent 'demo/render_pictures*' --sizes "$out/sizes.json"
}

# run_demo ARCHITECTURE: the pack alone. Without its tables the demo goes on, and says so.
run_demo() {
  run_exported "$1" "$out/lobelight.pck" --quit-after "$FRAMES" | tee "$out/run_$1.log" || return 1
  ! grep -q "Tables are missing" "$out/run_$1.log"
}

check "the export writes no error and no warning" export_pack
if ((failed == 0)); then
  check "the pack has what the demo needs, and nothing of the editor" list_pack
  check "it runs on x86-64" run_demo x86_64
  check "it runs on arm64, emulated" run_demo arm64
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
echo "$out/lobelight.pck"
echo "android: $((${#results[@]} - failed)) passed, $failed failed"
((failed == 0))
