# shellcheck shell=bash
# Jobs side by side: as many at once as there are cores to run them, each one's output shown when it has ended.

# Rendering takes memory, and more jobs than this would only wait for one another.
MOST_LANES=4

# run_side_by_side JOB…: runs the function run_JOB of each, in this order as lanes become free. A job that ends before it
# has judged what it ran is judged here, as one that failed.
run_side_by_side() {
  local lanes=$((JOBS < MOST_LANES ? JOBS : MOST_LANES)) waiting=("$@") pid status
  declare -gA RUNNING=()
  trap stop_jobs EXIT
  while ((${#waiting[@]} + ${#RUNNING[@]} > 0)); do
    while ((${#waiting[@]} > 0 && ${#RUNNING[@]} < lanes)); do
      start_job "${waiting[0]}"
      waiting=("${waiting[@]:1}")
    done
    status=0
    wait -n -p pid "${!RUNNING[@]}" || status=$?
    end_job "${RUNNING[$pid]}" "$status"
    unset "RUNNING[$pid]"
  done
  trap - EXIT
}

start_job() {
  say "$1 begins"
  "run_$1" >"$RESULTS/$1.output" 2>&1 </dev/null &
  RUNNING[$!]=$1
}

# end_job JOB STATUS
end_job() {
  cat "$RESULTS/$1.output"
  # A job's own failures are counted by its judge: it ends with 0.
  if (($2 != 0)); then
    status=$2
    # shellcheck disable=SC2034 # read by judge
    took=""
    cp "$RESULTS/$1.output" "$RESULTS/$1-job.log"
    judge "$1-job"
  fi
}

stop_jobs() {
  local pid
  for pid in "${!RUNNING[@]}"; do
    stop_tree "$pid"
  done
}

# stop_tree PID: the process and all that it started. A shell's own end would leave them running.
stop_tree() {
  local child children=""
  children=$(cat "/proc/$1/task/"*"/children" 2>/dev/null) || true
  kill "$1" 2>/dev/null || true
  for child in $children; do
    stop_tree "$child"
  done
}
