#!/usr/bin/env bash
# builds the documentation as a folder of pages, with the class reference, and checks it ([--out DIR] [--check] [--json FILE] [--serve [PORT]])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

DEFAULT_PORT=8061

usage() {
  cat <<USAGE
usage: ./dev docs [--out DIR] [--check] [--json FILE] [--serve [PORT]]

--out DIR       where the site goes (default: build/docs); what an earlier call put there is replaced
--check         also opens every page in Chromium, as wide as a phone, and asks that the navigation is complete
--json FILE     counts, and what is wrong: the place and the reason of each finding
--serve [PORT]  then serves it at http://localhost:PORT/ ($DEFAULT_PORT if none is given; 0 for any free one) until Ctrl-C

The pages are those of docs/, CHANGELOG.md and CONTRIBUTING.md, and one of each public class, made of the comments in
the sources. The site is static files: any host serves them, and it loads nothing from other hosts.
One sentence, with file and line, is written for each dead link or anchor, missing picture, picture that no command draws,
command or option that ./dev does not have, path that is not in the repository, and member without description. Then the
command ends with 1; the site is built all the same. Links to other hosts are not followed.
USAGE
}

out=$ROOT/build/docs
json=""
port=""
check=()
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
          die "docs: --serve takes a port from 0 to 65535, not '$2'"
        fi
        port=$((10#$2))
        shift
      fi
      ;;
    --check) check=(--check) ;;
    --out | --json)
      [[ -n ${2:-} ]] || die "docs: $1 needs a value"
      case $1 in
        --out) out=$(realpath -m -- "$2") ;;
        --json) json=$(realpath -m -- "$2") ;;
      esac
      shift
      ;;
    *) die "docs: there is no option '$1'; ./dev docs --help lists them" ;;
  esac
  shift
done
[[ -z $json || -d $(dirname -- "$json") ]] || die "docs: $json: its folder does not exist"
[[ ! -e $out || -d $out ]] || die "docs: $out is not a folder"
if [[ -d $out && -n $(ls -A "$out") && ! -f $out/search/search_index.json ]]; then
  die "docs: $out holds something else than a site; give an empty folder, or one that is not there"
fi

need_engine
need_class_xml
need_maths_font
if ((${#check[@]} > 0)); then need_browser; fi
need_python docs
export PYTHONDONTWRITEBYTECODE=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
"$PYTHON" "$ROOT/tools/docs/docs.py" --xml "$CLASS_XML" --work "$work/site" --fonts "${MATHS_FONT[@]}" --out "$out" \
  ${json:+--json "$json"} "${check[@]}" || status=$?
if [[ -n $port && -d $out ]]; then
  rm -rf "$work"
  trap - EXIT
  exec "$PYTHON" "$ROOT/tools/web/serve.py" "$out" "$port"
fi
exit "$status"
