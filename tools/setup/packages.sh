#!/usr/bin/env bash
# Installs the system packages that are missing, by apt, with sudo where that is needed: packages.sh PROBE…
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

mapfile -t packages < <(missing_packages "$@")
((${#packages[@]} > 0)) || exit 0

say "Missing system packages: ${packages[*]}"
command -v apt-get >/dev/null \
  || die "there is no apt-get here; install what Debian calls ${packages[*]} with your system's package manager, then run this again"

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null \
    || die "installing packages needs root and there is no sudo; run as root: apt-get install ${packages[*]}"
  say "They are installed with sudo apt-get; you may be asked for your password."
  sudo -v || die "without sudo, have an administrator run: apt-get install ${packages[*]}"
  as_root=(sudo)
fi

run_install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --option DPkg::Lock::Timeout=300 --yes --no-install-recommends "${packages[@]}"
}
# The lists may be absent, as in containers, or too old to find the files.
update_lists() {
  "${as_root[@]}" apt-get --option DPkg::Lock::Timeout=300 update
}
advice="Run apt-get install ${packages[*]} by hand to see what is wrong, then run this again."
step --advice "$advice" "Updating the list of packages" update_lists
step --advice "$advice" "Installing ${#packages[@]} system packages" run_install

mapfile -t packages < <(missing_packages "$@")
((${#packages[@]} == 0)) || die "still missing after the installation: ${packages[*]}"
