# shellcheck shell=bash
# Sourced by every command and set-up script: paths, messages, steps, locks and the need_… functions.
#
# Results go to stdout; what is being done and what went wrong goes to stderr.

set -euo pipefail

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if [[ -z ${LOBELIGHT_CACHE:-}${XDG_CACHE_HOME:-}${HOME:-} ]]; then
  echo "lobelight: set HOME or LOBELIGHT_CACHE, so that there is a place for the cache" >&2
  exit 1
fi
CACHE=${LOBELIGHT_CACHE:-${XDG_CACHE_HOME:-${HOME:-}/.cache}/lobelight}
JOBS=${LOBELIGHT_JOBS:-$(nproc)}
export LOBELIGHT_CACHE=$CACHE LOBELIGHT_JOBS=$JOBS

say() {
  printf '%s\n' "$*" >&2
}

# die SENTENCE: one line to stderr, exit 1.
die() {
  printf 'lobelight: %s\n' "$*" >&2
  exit 1
}

# is_one_of VALUE WORD…: whether VALUE is one of the words.
is_one_of() {
  local value=$1 word
  shift
  for word in "$@"; do
    [[ $value != "$word" ]] || return 0
  done
  return 1
}

# help_if_asked ARGUMENT…: usage() and the end, if one of them asks for help.
help_if_asked() {
  local argument
  for argument in "$@"; do
    case $argument in
      -h | --help)
        usage
        exit 0
        ;;
    esac
  done
}

# shellcheck source=tools/lib/steps.sh
source "$ROOT/tools/lib/steps.sh"
# shellcheck source=tools/lib/needs.sh
source "$ROOT/tools/lib/needs.sh"
# shellcheck source=tools/lib/engine.sh
source "$ROOT/tools/lib/engine.sh"
