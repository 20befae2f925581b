#!/usr/bin/env bash
# feeds damaged files and recipes to the core under sanitizers (--minutes N [--json FILE] [--seed N] [--reader R])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev fuzz --minutes N [--json FILE] [--seed N] [--reader R]…

Mutates small files and has the readers read them, with the C++ core under the address and
undefined-behaviour sanitizers. An input that crashes a reader, hangs it, takes too much memory or
breaks a promise (a refusal is one line that names the file, a picture has its size and no texel that
is no light, a table's weights are numbers that add up to the light) is kept in build/fuzz, named in
one sentence, and makes the exit status 1. To read it again: build/cmake/fuzz/lobelight_fuzz_READER FILE.

exr, hdr   pictures
merl, rgl  files of measurements; those of merl are abridged
measured   both, and what is made of them: a material, and a small table of it
recipe     recipes of tables and sets, and small tables

--minutes N  for all readers together, for example 0.5
--json FILE  {"seed", "readers": [{"reader", "inputs", "accepted", "refused", "blocks", "seconds",
             "failure", "input"}]}; blocks: basic blocks of the core that the inputs reached
--seed N     of the mutations (default: 1); the same one gives the same inputs
--reader R   only this one

The last line is "fuzz: N passed, N failed", readers; the exit status is 1 if one failed.
USAGE
}

help_if_asked "$@"
known=(exr hdr merl rgl measured recipe)
readers=()
minutes="" json="" seed=1
while (($# > 0)); do
  case $1 in
    --minutes | --json | --seed | --reader) [[ -n ${2:-} ]] || die "fuzz: $1 needs a value" ;;
    *) die "fuzz: there is no option '$1'; ./dev fuzz --help lists them" ;;
  esac
  case $1 in
    --minutes)
      [[ $2 =~ ^[0-9]{1,6}(\.[0-9]{1,6})?$ && ! $2 =~ ^[0.]+$ ]] \
        || die "fuzz: --minutes is '$2', but must be a number above 0"
      minutes=$2
      ;;
    --json)
      [[ -d $(dirname -- "$2") && ! -d $2 ]] || die "fuzz: $2: its folder does not exist, or it is one"
      json=$2
      ;;
    --seed)
      [[ $2 =~ ^[0-9]{1,18}$ ]] || die "fuzz: --seed is '$2', but must be a whole number of at most 18 digits"
      seed=$2
      ;;
    --reader)
      is_one_of "$2" "${known[@]}" || die "fuzz: there is no reader '$2'; the readers are ${known[*]}"
      readers+=("$2")
      ;;
  esac
  shift 2
done
[[ -n $minutes ]] || die "fuzz: say for how long, for example --minutes 1"
((${#readers[@]} > 0)) || readers=("${known[@]}")

bash "$ROOT/tools/setup/fuzz.sh" lobelight_fuzz
build=$ROOT/build/cmake

# OpenJPH, within OpenEXR, prints each fault that it finds in a file: errors here, remarks to stdout.
quiet() {
  grep --line-buffered -av -e '^ojph ' -e '^$' || true
}

seconds=$(awk -v minutes="$minutes" -v count="${#readers[@]}" 'BEGIN { printf "%.3f", minutes * 60 / count }')
work=$(mktemp -d "${TMPDIR:-/tmp}/lobelight-fuzz.XXXXXX")
trap 'rm -rf "$work"' EXIT
failed=0
summary=()
rows=()
for reader in "${readers[@]}"; do
  status=0
  LOBELIGHT_FUZZ_SCRATCH=$work/scratch "$build/fuzz/lobelight_fuzz_$reader" --seconds "$seconds" --seed "$seed" \
    --keep "$ROOT/build/fuzz" --json "$work/row" >"$work/line" 2> >(quiet >&2) || status=$?
  if ((status != 0)); then
    failed=$((failed + 1))
    summary+=("$reader: stopped, as said above (status $status)")
  else
    summary+=("$(tail -n 1 "$work/line")")
  fi
  [[ -f $work/row ]] || printf '{"reader": "%s", "failure": "ended with status %d"}' "$reader" "$status" >"$work/row"
  rows+=("$(<"$work/row")")
  rm -f "$work/row"
done

printf '%s\n' "${summary[@]}"
echo "fuzz: $((${#readers[@]} - failed)) passed, $failed failed"
if [[ -n $json ]]; then
  {
    printf '{"seed": %s, "readers": [\n' "$seed"
    printf '  %s' "${rows[0]}"
    (("${#rows[@]}" < 2)) || printf ',\n  %s' "${rows[@]:1}"
    printf '\n]}\n'
  } >"$json.tmp-$$"
  mv "$json.tmp-$$" "$json"
fi
((failed == 0))
