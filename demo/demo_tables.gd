## The tables that [code]./dev demo[/code] bakes for the demo.

const FOLDER := "res://demo/build/tables"
const RECIPES := "res://bake/recipes"


## The file of the table that a recipe gives with a number of lobes.
static func path_of(recipe: String, lobe_count: int) -> String:
	return "%s/%s_%d.res" % [FOLDER, recipe, lobe_count]


## The table of a recipe; [code]null[/code] if it has not been baked.
static func load_table(recipe: String, lobe_count: int) -> LobeTable:
	var path := path_of(recipe, lobe_count)
	return load(path) as LobeTable if FileAccess.file_exists(path) else null
