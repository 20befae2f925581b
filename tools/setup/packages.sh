#!/usr/bin/env bash
# Installs the system packages that are missing, by apt, with sudo where that is needed: packages.sh PROBE…
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

mapfile -t packages < <(missing_packages "$@")
((${#packages[@]} > 0)) || exit 0

say "Missing system packages: ${packages[*]}"
command -v apt-get >/dev/null \
  || die "there is no apt-get here; install what Debian calls ${packages[*]}, then run this again"

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null \
    || die "installing packages needs root and there is no sudo; run as root: apt-get install ${packages[*]}"
  say "They are installed with sudo apt-get; you may be asked for your password."
  sudo -v || die "without sudo, have an administrator run: apt-get install ${packages[*]}"
  as_root=(sudo)
fi

apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --option DPkg::Lock::Timeout=300 "$@"
}
# The lists of packages may be absent, as in containers, or too old to find the files. Reading them anew is left for
# that case, because it also fails for reasons that do not matter here, such as another source that is gone.
install_missing() {
  local install=(install --yes --no-install-recommends "${packages[@]}")
  apt_get "${install[@]}" && return
  apt_get update || true
  apt_get "${install[@]}"
}
step --advice "Run apt-get install ${packages[*]} by hand to see what is wrong, then run this again." \
  "Installing ${#packages[@]} system packages" install_missing

mapfile -t packages < <(missing_packages "$@")
((${#packages[@]} == 0)) || die "still missing after the installation: ${packages[*]}"
