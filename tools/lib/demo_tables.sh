# shellcheck shell=bash
# The sets of tables that the demo draws besides the ready ones, where demo/demo_tables.gd looks for them.

DEMO_TABLES=$ROOT/demo/build/tables
# shellcheck disable=SC2034 # used by those who source this file
DEMO_SETS=(ggx_4 ggx_16 thesis_8)

# What tests that do not look at how good the lobes are take: views of drafts.
DEMO_DRAFT_VIEWS=16,4

# bake_demo_tables SET…: bakes those sets, "${DEMO_SETS[@]}" being all, unless they are there, made from the same recipe by the
# same library. LOBELIGHT_DRAFT_TABLES=yes, which ./dev test sets: of few views, unless the usual ones are there.
bake_demo_tables() {
  local name file key own_key views=()
  key="$(content_hash "$ROOT/bake/bake_demo.gd") $(library_key)"
  own_key=$key
  if [[ ${LOBELIGHT_DRAFT_TABLES:-} == yes ]]; then
    views=(--views "$DEMO_DRAFT_VIEWS")
    own_key="$key ${views[*]}"
  fi
  mkdir -p "$DEMO_TABLES"
  for name in "$@"; do
    file=$DEMO_TABLES/$name.res
    if [[ ! -f $file ]] || ! { stamp_is "$file.key" "$key" || stamp_is "$file.key" "$own_key"; }; then
      say "Fitting the demo's tables $name (up to a minute) …"
      godot_headless --no-header --script res://bake/bake_demo.gd -- --set "$name" --out "$file" "${views[@]}" >&2
      write_stamp "$file.key" "$own_key"
    fi
  done
}
