# shellcheck shell=bash
# The tables of the demo's materials, where demo/demo_tables.gd looks for them.

DEMO_TABLES=$ROOT/demo/build/tables
DEMO_RECIPES=(polished_ward satin_ward brushed_ward satin_ggx)

# bake_demo_table RECIPE LOBES: bakes a table unless it is there, made from the same recipe by the same library.
bake_demo_table() {
  local recipe=$ROOT/bake/recipes/$1.json table=$DEMO_TABLES/$1_$2.res key
  key="$(content_hash "$recipe") $(library_key)"
  if [[ ! -f $table ]] || ! stamp_is "$table.key" "$key"; then
    bash "$ROOT/tools/commands/bake.sh" --recipe "$recipe" --lobes "$2" --out "$table" >&2
    write_stamp "$table.key" "$key"
  fi
}

# bake_demo_tables LOBES…
bake_demo_tables() {
  local recipe lobes
  mkdir -p "$DEMO_TABLES"
  for recipe in "${DEMO_RECIPES[@]}"; do
    for lobes in "$@"; do
      bake_demo_table "$recipe" "$lobes"
    done
  done
}
