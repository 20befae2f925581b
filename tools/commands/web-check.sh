#!/usr/bin/env bash
# opens the demo's page in a browser that draws in software, and writes what it shows and takes
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev web-check [--out DIR] [--json FILE]

--out DIR    where README.md, results.json and sheet.png go (docs/report/web)
--json FILE  a copy of results.json

Makes the page of ./dev web and opens it in a headless Chromium, which is installed where it is missing. Draws every
environment by every method, the scenes of tests/web beside Compatibility on this machine, and times both in one run.
The machine should have nothing else to do. ./dev test web is the short part of this.
USAGE
}

help_if_asked "$@"
out=$ROOT/docs/report/web
json=""
while (($# > 0)); do
  case $1 in
    --out | --json)
      [[ -n ${2:-} ]] || die "web-check: $1 needs a value"
      case $1 in
        --out) out=$(realpath -m -- "$2") ;;
        --json) json=$(realpath -m -- "$2") ;;
      esac
      shift
      ;;
    *) die "web-check: there is no option '$1'; ./dev web-check --help lists them" ;;
  esac
  shift
done
[[ ! -e $out || -d $out ]] || die "web-check: $out is not a folder"
[[ -z $json || -d $(dirname -- "$json") ]] || die "web-check: $json: its folder does not exist"

need_engine
need_display
need_library
need_import
need_web_template
need_browser
work=$ROOT/build/web-check
mkdir -p "$work" "$out"
bash "$ROOT/tools/commands/web.sh" --out "$work/page" --json "$work/page.json" >/dev/null
"$PYTHON" "$ROOT/tools/web/check.py" --work "$work" --out "$out"
[[ -z $json ]] || cp "$out/results.json" "$json"
