#!/usr/bin/env bash
# checks the form of C++, GDScript and shell code, who knows whom in the run time, and GitHub's workflows and forms ([--fix] [--json FILE])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev lint [--fix] [--json FILE]

--fix         formats C++ and GDScript first
--json FILE   {"passed", "failed", "tools": [{"name", "files", "passed"}]}
USAGE
}

help_if_asked "$@"
fix=false
json=""
while (($# > 0)); do
  case $1 in
    --fix) fix=true ;;
    --json)
      (($# >= 2)) || die "lint: --json needs a file"
      json=$2
      shift
      ;;
    *) die "lint: there is no option '$1'; lint [--fix] [--json FILE]" ;;
  esac
  shift
done

need_packages
need_python workflows
need_actionlint
bin=$(dirname "$PYTHON")
cd "$ROOT"

# files PATTERN…: our files that match, without what is generated or copied in; PATTERN as for find -name.
files() {
  local arguments=() pattern
  for pattern in "$@"; do
    arguments+=(-o -name "$pattern")
  done
  find . \( -name .git -o -name .godot -o -path ./build -o -path ./reports -o -path ./addons/gdUnit4 \) -prune \
    -o -type f \( "${arguments[@]:1}" \) -print | LC_ALL=C sort
}
mapfile -t cpp < <(files '*.cpp' '*.h' '*.hpp')
mapfile -t gdscript < <(files '*.gd')
mapfile -t shell < <(files '*.sh')
shell+=(dev .ci/run)

if $fix; then
  "$bin/clang-format" -i "${cpp[@]}"
  "$bin/gdformat" --line-length 100 "${gdscript[@]}"
fi

passed=0
failed=0
results=()
# check NAME COUNT COMMAND…: one test; its output is shown only when it fails. No file to check is a failure too.
check() {
  local name=$1 count=$2 output ok=true
  shift 2
  if ((count == 0)); then
    ok=false
    output="there is no file to check"
  else
    output=$("$@" 2>&1) || ok=false
  fi
  results+=("$(printf '{"name": "%s", "files": %d, "passed": %s}' "$name" "$count" "$ok")")
  if $ok; then
    passed=$((passed + 1))
    echo "ok      $name ($count files)"
  else
    failed=$((failed + 1))
    printf '%s\n' "$output"
    echo "FAILED  $name ($count files)"
  fi
}

# One line for each place; clang-format itself shows the source too.
clang_format() {
  local output
  output=$("$bin/clang-format" --dry-run -Werror "${cpp[@]}" 2>&1) || {
    sed -n 's/^\([^ ]*:[0-9]*\):[0-9]*: error: /\1: /p' <<<"$output" | LC_ALL=C sort -u
    return 1
  }
}

# What GitHub reads: workflows, issue forms and what keeps dependencies up to date.
actionlint() {
  "$ACTIONLINT" -no-color -shellcheck shellcheck "${workflows[@]}"
}
github_forms() {
  local schema="$bin/check-jsonschema --no-cache --builtin-schema" status=0
  $schema vendor.github-issue-forms "${forms[@]}" || status=1
  $schema vendor.github-issue-config .github/ISSUE_TEMPLATE/config.yml || status=1
  $schema vendor.dependabot .github/dependabot.yml || status=1
  # A job without one may hang for six hours.
  $schema custom.github-workflows-require-timeout "${workflows[@]}" || status=1
  return "$status"
}
mapfile -t workflows < <(files '*.yml' | grep '^./.github/workflows/')
mapfile -t forms < <(files '*.yml' | grep '^./.github/ISSUE_TEMPLATE/' | grep -v '/config.yml$')

check clang-format "${#cpp[@]}" clang_format
check gdformat "${#gdscript[@]}" "$bin/gdformat" --line-length 100 --check "${gdscript[@]}"
check gdlint "${#gdscript[@]}" "$bin/gdlint" "${gdscript[@]}"
check shellcheck "${#shell[@]}" shellcheck "${shell[@]}"
check actionlint "${#workflows[@]}" actionlint
check workflow_commands "${#workflows[@]}" "$PYTHON" tools/lint/workflow_commands.py
check github_forms "${#forms[@]}" github_forms
mapfile -t runtime < <(files '*.gd' | grep '^./addons/lobelight/runtime/')
check arrows "${#runtime[@]}" "$PYTHON" tools/lint/arrows.py
check house "$((${#cpp[@]} + ${#gdscript[@]} + ${#shell[@]}))" "$PYTHON" tools/house/house.py --quiet
mapfile -t includes < <(files '*.gdshaderinc' | grep '^./addons/lobelight/')
check shader_names "${#includes[@]}" "$PYTHON" tools/lint/shader_names.py

if [[ -n $json ]]; then
  list=$(printf '%s, ' "${results[@]}")
  printf '{"passed": %d, "failed": %d, "tools": [%s]}\n' "$passed" "$failed" "${list%, }" >"$json.$$" \
    || die "lint: $json cannot be written"
  mv -f "$json.$$" "$json"
fi
echo "lint: $passed passed, $failed failed"
if ((failed > 0)); then
  say "./dev lint --fix formats C++ and GDScript."
  exit 1
fi
