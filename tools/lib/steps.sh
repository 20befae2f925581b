# shellcheck shell=bash
# Long work: steps with a progress line and a log, locks between concurrent runs, fingerprints of files.

# step [--advice SENTENCE] TITLE COMMAND…
# Runs COMMAND with its output in a log below $CACHE/log. On a terminal a line shows how far it is; elsewhere one
# line says that it starts and one that it ended. A failure shows the log's end, says what to do, and exits 1.
# Never call it in a condition: `set -e` would be off inside COMMAND.
step() {
  local advice="" title log status=0 watcher="" started=$SECONDS
  if [[ $1 == --advice ]]; then
    advice=$2
    shift 2
  fi
  title=$1
  shift
  log=$CACHE/log/$(tr -cs 'A-Za-z0-9.\n' '-' <<<"$title").log
  mkdir -p "$CACHE/log"
  : >"$log"
  if [[ -t 2 ]]; then
    watch_log "$title" "$log" &
    watcher=$!
  else
    say "$title …"
  fi
  set +e
  (
    set -e
    "$@"
  ) >"$log" 2>&1 </dev/null
  status=$?
  set -e
  if [[ -n $watcher ]]; then
    kill "$watcher" 2>/dev/null || true
    wait "$watcher" 2>/dev/null || true
    printf '\r\033[K' >&2
  fi
  if ((status != 0)); then
    tail -n 15 "$log" | sed 's/^/  | /' >&2
    die "$title: failed (status $status). The whole output: $log.${advice:+ $advice}"
  fi
  if [[ -n $watcher ]]; then
    say "$title: done ($((SECONDS - started)) s)"
  else
    say "  done ($((SECONDS - started)) s)"
  fi
}

# watch_log TITLE LOG: redraws one line on stderr until it is killed; reads "[done/all]" or "NN%" from the log's end.
watch_log() {
  local title=$1 log=$2 started=$SECONDS last bar done_count all_count width
  while :; do
    last=$(tail -c 400 "$log" 2>/dev/null | tr '\r' '\n' | tr -d '\0' | grep -oE '\[[0-9]+/[0-9]+\]|[0-9]+%' \
      | tail -n 1) || last=""
    bar=""
    if [[ $last =~ ^\[([0-9]+)/([0-9]+)\]$ || $last =~ ^([0-9]+)(%)$ ]]; then
      done_count=${BASH_REMATCH[1]}
      all_count=${BASH_REMATCH[2]/\%/100}
      width=$((all_count > 0 ? done_count * 20 / all_count : 0))
      bar=$(printf '[%-20s] %s ' "$(printf '%*s' "$width" '' | tr ' ' '#')" "${last//[\[\]]/}")
    fi
    printf '\r\033[K%s  %s%d s' "$title" "$bar" "$((SECONDS - started))" >&2
    sleep 0.5
  done
}

# locked LOCKFILE COMMAND…: runs COMMAND while no other run holds LOCKFILE. COMMAND is a program, not a function, and
# looks again whether its work is still to do.
locked() {
  local file=$1
  shift
  mkdir -p "$(dirname "$file")"
  if ! flock --close --nonblock --conflict-exit-code 75 "$file" true; then
    say "Waiting for another run of ./dev to finish its set-up …"
  fi
  flock --close "$file" "$@"
}

# fingerprint PATH…: one hash over names, sizes and times of all files below, generated folders left out.
fingerprint() {
  find "$@" \( -name .git -o -name .godot -o -name build -o -name __pycache__ \) -prune \
    -o -type f -printf '%p %s %T@\n' 2>/dev/null | LC_ALL=C sort | sha256sum | cut -c 1-16
}

# content_hash FILE…: one hash over the contents of files.
content_hash() {
  cat -- "$@" | sha256sum | cut -c 1-16
}

# stamp_is FILE TEXT: whether the stamp FILE says TEXT.
stamp_is() {
  [[ -f $1 && $(<"$1") == "$2" ]]
}

# write_stamp FILE TEXT
write_stamp() {
  mkdir -p "$(dirname "$1")"
  printf '%s\n' "$2" >"$1.$$"
  mv -f "$1.$$" "$1"
}
