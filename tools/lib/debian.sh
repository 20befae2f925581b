# shellcheck shell=bash
# Packages of other Debian suites through apt with state directories of its own: no root, no change to the system.

DEBIAN_KEYRING=/usr/share/keyrings/debian-archive-keyring.gpg

# debian_mirror: prints the address of a Debian mirror: LOBELIGHT_DEBIAN_MIRROR, else the one this machine's own apt
# uses if it is Debian's, else the one debootstrap has built in. Prints nothing when there is none of these.
debian_mirror() {
  local id="" codename="" fields mirror=""
  if [[ -n ${LOBELIGHT_DEBIAN_MIRROR:-} ]]; then
    printf '%s\n' "${LOBELIGHT_DEBIAN_MIRROR%/}"
    return
  fi
  # shellcheck disable=SC1091 # the system's file
  [[ ! -r /etc/os-release ]] || read -r id codename < <(source /etc/os-release && echo "$ID ${VERSION_CODENAME:-sid}")
  # The origin is known only once the lists have been fetched; until then the suite's name has to tell.
  # shellcheck disable=SC2016 # apt's own placeholders
  fields='$(REPO_URI)|$(RELEASE)|$(COMPONENT)|$(ORIGIN)|$(LABEL)'
  mirror=$(apt-get indextargets --format "$fields" 'Created-By: Packages' 2>/dev/null \
    | awk -F'|' -v id="$id" -v codename="$codename" '
      $3 == "main" && (($4 == "Debian" && $5 == "Debian") || ($4 == "" && id == "debian" && $2 == codename)) {
        sub(/\/$/, "", $1); print $1; exit
      }') || true
  if [[ -z $mirror ]]; then
    mirror=$(sed -n 's/^DEF_MIRROR="\(.*\)"$/\1/p' /usr/sbin/debootstrap 2>/dev/null) || true
  fi
  [[ -z $mirror ]] || printf '%s\n' "$mirror"
}

# private_apt DIRECTORY LINE…: points apt at DIRECTORY (by APT_CONFIG, for this process and its children). Each LINE
# is "deb SUITE" or "deb-src SUITE". The package database is empty: every dependency counts as missing.
private_apt() {
  local directory=$1 mirror line
  shift
  mirror=$(debian_mirror)
  [[ -n $mirror ]] || die "no Debian mirror is known on this machine; set LOBELIGHT_DEBIAN_MIRROR to the address of one"
  [[ -r $DEBIAN_KEYRING ]] || die "$DEBIAN_KEYRING is missing; install the package debian-archive-keyring"
  mkdir -p "$directory"/{state/lists/partial,cache/archives/partial,parts,log}
  : >"$directory/state/status"
  for line in "$@"; do
    echo "${line% *} [signed-by=$DEBIAN_KEYRING] $mirror ${line#* } main"
  done >"$directory/sources.list"
  {
    # Proxies and certificates as the system has them; none of its hooks, pins, sources or further indexes.
    apt-config dump | grep -E '^Acquire::' | grep -v '^Acquire::IndexTargets' || true
    cat <<CONFIG
Dir::State "$directory/state";
Dir::State::status "$directory/state/status";
Dir::Cache "$directory/cache";
Dir::Log "$directory/log";
Dir::Etc::main "/dev/null";
Dir::Etc::parts "$directory/parts";
Dir::Etc::sourcelist "$directory/sources.list";
Dir::Etc::sourceparts "$directory/parts";
Dir::Etc::preferences "/dev/null";
Dir::Etc::preferencesparts "$directory/parts";
APT::Sandbox::User "root";
APT::Install-Recommends "false";
Acquire::Languages "none";
Acquire::Check-Valid-Until "false";
APT::Update::Error-Mode "any";
CONFIG
  } >"$directory/apt.conf"
  export APT_CONFIG=$directory/apt.conf
}

# use_suite_with DIRECTORY PACKAGE VERSION SUITE…: private_apt, with fresh lists, for the first SUITE that has PACKAGE in a
# version that begins with VERSION; DIRECTORY/suite names it. Fails, saying so, where none has.
use_suite_with() {
  local directory=$1 package=$2 version=$3 suite
  shift 3
  for suite in "$@"; do
    rm -rf "$directory"
    private_apt "$directory" "deb $suite"
    apt-get update || continue
    # Not grep -q, which would stop apt-cache in the middle.
    if apt-cache madison "$package" | grep -E "^ *$package *\| *([0-9]+:)?${version//./\\.}[.~+-]"; then
      echo "$suite" >"$directory/suite"
      return
    fi
  done
  echo "No suite of $* has $package $version."
  return 1
}
