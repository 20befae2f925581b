#!/usr/bin/env bash
# ./dev engine: which of the official builds it takes, and what it does where something is wrong. A program in the place of
# GitHub's gh answers, from a folder.
set -uo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0

# expect NAME COMMAND…: one check.
expect() {
  local name=$1
  shift
  if ("$@") >"$work/check.log" 2>&1; then
    passed=$((passed + 1))
    echo "  $name: passed"
  else
    failed=$((failed + 1))
    echo "  $name: FAILED"
    sed 's/^/    | /' "$work/check.log"
  fi
}

mkdir -p "$work/bin" "$work/releases"
cat >"$work/bin/gh" <<'FAKE'
#!/usr/bin/env bash
set -eu
if [[ $1 == api ]]; then
  cat "$FAKE_RELEASES/tags"
else
  tag=$3
  while (($# > 0)); do
    case $1 in
      --pattern) cp "$FAKE_RELEASES/$tag/$2" . ;;
    esac
    shift
  done
  echo "$tag" >>"$FAKE_RELEASES/downloads"
fi
FAKE
chmod +x "$work/bin/gh"
export PATH=$work/bin:$PATH FAKE_RELEASES=$work/releases LOBELIGHT_CACHE=$work/cache

# publish TAG: an engine of that version, for Linux on this machine's processor.
architecture=$(uname -m)
[[ $architecture != aarch64 ]] || architecture=arm64
publish() {
  local name=Godot_v$1_linux.$architecture
  mkdir -p "$work/releases/$1"
  python3 - "$work/releases/$1/$name.zip" "$name" "$1" <<'PYTHON_END'
import sys
import zipfile

with zipfile.ZipFile(sys.argv[1], "w") as archive:
    archive.writestr(sys.argv[2], f"#!/bin/sh\necho {sys.argv[3]}\n")
PYTHON_END
  (cd "$work/releases/$1" && sha512sum "$name.zip" >SHA512-SUMS.txt)
}
for tag in 4.6-stable 4.6.2-stable 4.6.10-stable 4.7-beta2 4.7-beta1; do
  publish "$tag"
done
printf '%s\n' 4.7-beta2 4.6.10-stable 4.7-beta1 4.6.2-stable 4.6-stable 4.5.1-stable >"$work/releases/tags"

# gives VERSION TAG: ./dev engine VERSION prints the path of a program of that version.
gives() {
  local program
  program=$("$root/dev" engine "$1") && [[ $("$program") == "$2" ]]
}
expect "the newest stable version of a series" gives 4.6 4.6.10-stable
expect "one version" gives 4.6.2 4.6.2-stable
expect "a series without a stable version: its newest preview" gives 4.7 4.7-beta2

downloads() {
  rm -f "$work/releases/downloads"
  "$root/dev" engine 4.6 && [[ ! -e $work/releases/downloads ]]
}
expect "what is in the cache is not downloaded again" downloads

# refuses TEXT VERSION…: ends with one sentence that has TEXT.
refuses() {
  local text=$1 said
  shift
  said=$("$root/dev" engine "$@" 2>&1 >"$work/stdout") && return 1
  echo "$said"
  [[ ! -s $work/stdout ]] && [[ $(tail -n 1 <<<"$said") == "lobelight: engine: "*"$text"* ]]
}
expect "no version" refuses "name one version"
expect "a version that is none" refuses "must be such as 4.6" newest
expect "a version that is not there" refuses "there is no Godot 4.9" 4.9
expect "a version that is listed and cannot be downloaded" refuses "cannot be downloaded" 4.5
echo "damaged" >>"$work/releases/4.6-stable/Godot_v4.6-stable_linux.$architecture.zip"
printf '%s\n' 4.6-stable >"$work/releases/tags"
expect "a damaged archive" refuses "does not have the checksum" 4.6

echo "engine: $passed passed, $failed failed"
((failed == 0))
