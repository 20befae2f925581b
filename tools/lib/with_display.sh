#!/usr/bin/env bash
# Runs COMMAND on an X server of its own that draws in memory; ends with its status: with_display.sh COMMAND…
#
# Unlike xvfb-run, it lets the server choose its number, so that many may start at once.
set -euo pipefail

work=$(mktemp -d)
server=""
command=""
# shellcheck disable=SC2317 # called by the trap
stop() {
  trap - EXIT
  [[ -z $command ]] || kill "$command" 2>/dev/null || true
  [[ -z $server ]] || kill "$server" 2>/dev/null || true
  wait || true
  rm -rf "$work"
}
trap stop EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

cookie=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
xauth -q -f "$work/server" add :0 . "$cookie" 2>/dev/null
mkfifo "$work/number"
# The server does not outlive this script, however that ends.
setpriv --pdeathsig TERM Xvfb -displayfd 3 -auth "$work/server" -screen 0 1920x1080x24 -nolisten tcp \
  3>"$work/number" >"$work/log" 2>&1 </dev/null &
server=$!
if ! read -r -t 60 number <"$work/number"; then
  sed 's/^/  | /' "$work/log" >&2
  echo "lobelight: the X server Xvfb does not start" >&2
  exit 1
fi
xauth -q -f "$work/client" add ":$number" . "$cookie" 2>/dev/null

# In the background, so that a signal to this script is handled at once.
DISPLAY=:$number XAUTHORITY=$work/client "$@" <&0 &
command=$!
status=0
wait "$command" || status=$?
command=""
exit "$status"
