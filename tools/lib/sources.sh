# shellcheck shell=bash
# Sources of Debian's packages by what is in them: any revision in any suite will do whose archive is the wanted one.

# fetch_source FOLDER PACKAGE ARCHIVE SHA256 SUITE…: ARCHIVE of the source package PACKAGE, into FOLDER, from the first
# SUITE that has one with this checksum. Fails, saying so, where none has.
fetch_source() {
  local folder=$1 package=$2 archive=$3 checksum=$4 suite version
  local apt=$folder/apt-$package
  shift 4
  for suite in "$@"; do
    rm -rf "$apt"
    private_apt "$apt" "deb-src $suite"
    apt-get update || continue
    version=$(apt-cache showsrc "$package" | version_with "$checksum") || continue
    [[ -n $version ]] || continue
    echo "$package $version of $suite has the archive."
    (cd "$apt" && apt-get source --download-only --tar-only "$package=$version") || continue
    sha256sum --check --status <<<"$checksum  $apt/$archive" || continue
    mv "$apt/$archive" "$folder/$archive"
    rm -rf "$apt"
    return
  done
  rm -rf "$apt"
  echo "No suite of $* has $archive with the SHA-256 $checksum."
  return 1
}

# version_with SHA256: of the descriptions of source packages on stdin, the version of the first with this checksum.
version_with() {
  awk -v RS= -v FS='\n' -v checksum="$1" '
    found == "" && index($0, checksum) {
      for (i = 1; i <= NF; i++) if ($i ~ /^Version: /) found = substr($i, 10)
    }
    END { if (found != "") print found }'
}
