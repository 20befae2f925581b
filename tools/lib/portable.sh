# shellcheck shell=bash
# For the few commands that run on macOS and Windows too: paths, messages and the names of this machine. Bash is of 2007 on
# macOS (3.2, without mapfile and wait -n), and Git's on Windows, so tools/lib/common.sh, which needs Linux, is left alone.

set -euo pipefail

# shellcheck disable=SC2034 # used by those who source this file
ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# Git's Bash would take arguments such as res://x for paths of its own.
export MSYS_NO_PATHCONV=1

say() {
  printf '%s\n' "$*" >&2
}

# die SENTENCE: one line to stderr, exit 1.
die() {
  printf 'lobelight: %s\n' "$*" >&2
  exit 1
}

# host_system: prints linux, macos or windows, as lobelight.gdextension names it.
host_system() {
  case $(uname -s) in
    Linux) echo linux ;;
    Darwin) echo macos ;;
    MINGW* | MSYS* | CYGWIN*) echo windows ;;
    *) die "there is no library for $(uname -s)" ;;
  esac
}

# host_architecture: prints x86_64 or arm64. Git's Bash is itself emulated on Windows for arm64, whose name it then has in
# that of the system.
host_architecture() {
  case "$(uname -s) $(uname -m)" in
    *ARM64* | *arm64* | *aarch64*) echo arm64 ;;
    *x86_64* | *amd64*) echo x86_64 ;;
    *) die "there is no library for the processor $(uname -m)" ;;
  esac
}

# absolute_path PATH: prints it; the file need not be there.
absolute_path() {
  case $1 in
    /* | [A-Za-z]:[/\\]*) printf '%s\n' "$1" ;;
    *) printf '%s\n' "$PWD/$1" ;;
  esac
}
