#!/usr/bin/env bash
# downloads an official build of Godot for this system and prints its path (VERSION; also on macOS and Windows)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/portable.sh"

usage() {
  cat <<'USAGE'
usage: ./dev engine VERSION

VERSION is 4.6, the newest of that series, or 4.6.3, just that one. Where a series has no stable version yet, its newest
preview is taken. The program is kept in the cache; its path is all that is written to the standard output:

    GODOT=$(./dev engine 4.7) ./dev test native runtime

GitHub's program gh downloads it; the checksums that lie beside it there are compared. The other commands need none of
this: on Linux they get an engine by themselves.
USAGE
}

case ${1:-} in
  -h | --help)
    usage
    exit 0
    ;;
esac
(($# == 1)) || die "engine: name one version, such as 4.6 or 4.6.3"
version=$1
[[ $version =~ ^4\.[0-9]+(\.[0-9]+)?$ ]] || die "engine: the version is '$version', but must be such as 4.6 or 4.6.3"
repository=godotengine/godot-builds
system=$(host_system)
architecture=$(host_architecture)
command -v gh >/dev/null || die "engine: GitHub's program gh, which downloads Godot, is not installed"
command -v unzip >/dev/null || die "engine: unzip, which unpacks Godot, is not installed"

# newest_tag SERIES: of the tags on stdin, newest first, that of the newest stable version, else of the newest preview.
newest_tag() {
  local series=${1//./\\.} tags stable
  tags=$(cat)
  stable=$(grep -E "^$series(\.[0-9]+)?-stable$" <<<"$tags" | sort -V | tail -n 1) || true
  [[ -n $stable ]] || stable=$(grep -E "^$series(\.[0-9]+)?-" <<<"$tags" | head -n 1) || true
  printf '%s\n' "$stable"
}

tags=$(gh api --paginate "repos/$repository/releases?per_page=100" --jq '.[].tag_name') \
  || die "engine: the list of versions cannot be read from $repository"
tag=$(newest_tag "$version" <<<"$tags")
[[ -n $tag ]] || die "engine: there is no Godot $version in $repository"

case $system.$architecture in
  linux.*) asset=Godot_v${tag}_linux.$architecture.zip program=Godot_v${tag}_linux.$architecture ;;
  macos.*) asset=Godot_v${tag}_macos.universal.zip program=Godot.app/Contents/MacOS/Godot ;;
  windows.x86_64) asset=Godot_v${tag}_win64.exe.zip program=Godot_v${tag}_win64_console.exe ;;
  windows.arm64) asset=Godot_v${tag}_windows_arm64.exe.zip program=Godot_v${tag}_windows_arm64_console.exe ;;
esac
folder=${LOBELIGHT_CACHE:-${XDG_CACHE_HOME:-${HOME:-}/.cache}/lobelight}/official/$tag-$system.$architecture

check_sum() {
  if command -v sha512sum >/dev/null; then sha512sum --check --status; else shasum -a 512 --check --status; fi
}

if [[ ! -f $folder/complete ]]; then
  rm -rf "$folder"
  mkdir -p "$folder"
  say "Downloading Godot $tag …"
  # In the folder, since gh does not know the paths of Git's Bash on Windows.
  (cd "$folder" && gh release download "$tag" --repo "$repository" --pattern "$asset" --pattern SHA512-SUMS.txt >&2) \
    || die "engine: $asset of $tag cannot be downloaded"
  (cd "$folder" && grep -E "[ *]$asset\$" SHA512-SUMS.txt | check_sum) \
    || die "engine: what was downloaded for $asset does not have the checksum in SHA512-SUMS.txt"
  unzip -q "$folder/$asset" -d "$folder"
  rm -f "$folder/$asset"
  [[ -f $folder/$program ]] || die "engine: there is no $program in $asset"
  chmod +x "$folder/$program"
  touch "$folder/complete"
fi
printf '%s\n' "$folder/$program"
