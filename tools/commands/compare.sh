#!/usr/bin/env bash
# draws one sphere by several methods beside a reference (--env FILE --brdf B --alpha AX,AY --methods M,M --out DIR)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

renderer=mobile
json=""
out=""
arguments=()
while (($# > 0)); do
  case $1 in
    --renderer | --json | --out)
      (($# > 1)) || die "compare: $1 needs a value"
      case $1 in
        --renderer) renderer=$2 ;;
        --json) json=$(realpath -m -- "$2") ;;
        --out)
          out=$2
          arguments+=(--out "$2")
          ;;
      esac
      shift 2
      ;;
    *)
      arguments+=("$1")
      shift
      ;;
  esac
done
case $renderer in
  mobile | gl_compatibility | forward_plus) ;;
  *) die "compare: there is no renderer '$renderer'; take mobile, gl_compatibility or forward_plus" ;;
esac

need_engine
need_library
need_import
need_python
export LOBELIGHT_CWD=$PWD LOBELIGHT_TERMINAL=0
if [[ -t 1 ]]; then LOBELIGHT_TERMINAL=1; fi
godot_rendered "$renderer" --no-header --script res://bake/compare.gd -- "${arguments[@]}"
"$PYTHON" "$ROOT/tools/compare/metrics.py" "$out" ${json:+--json "$json"}
