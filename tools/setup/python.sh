#!/usr/bin/env bash
# Makes the virtual environment in the cache and installs the pinned Python tools: python.sh [EXTRA]
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

extra=${1:-}
venv=$CACHE/python
requirements=("$ROOT/tools/requirements.txt")
name=base
if [[ -n $extra ]]; then
  requirements+=("$ROOT/tools/requirements-$extra.txt")
  name=$extra
fi
key=$(content_hash "${requirements[@]}")
if [[ -x $venv/bin/python3 ]] && stamp_is "$venv/lobelight-$name" "$key"; then
  exit 0
fi

# The system's own interpreter first: one from a version manager may vanish under the environment.
python=/usr/bin/python3
[[ -x $python ]] || python=$(command -v python3) || die "there is no python3 here"

make_environment() {
  "$python" -m venv "$venv"
}
install_requirements() {
  local file arguments=()
  for file in "${requirements[@]}"; do
    arguments+=(--requirement "$file")
  done
  "$venv/bin/python3" -m pip install --disable-pip-version-check --only-binary :all: "${arguments[@]}"
}

if ! "$venv/bin/python3" -c '' 2>/dev/null; then
  rm -rf "$venv"
  step --advice "On Debian: apt-get install python3-venv." "Making a Python environment" make_environment
fi
step --advice "Is the Python package index reachable?" "Installing Python tools" install_requirements
write_stamp "$venv/lobelight-$name" "$key"
