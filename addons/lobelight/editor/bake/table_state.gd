@tool
extends Object
## What a bake replaces in a [LobeTable]: properties and their values.

const Recipe := preload("bake_recipe.gd")

## In the order in which they are set.
const PROPERTIES: Array[StringName] = [
	&"brdf",
	&"alpha",
	&"lobe_count",
	&"views",
	&"method",
	&"seed",
	&"image",
	&"format",
	&"checksum",
]
const METADATA: Array[StringName] = [Recipe.META, Recipe.REPORT_META]
# Figures of the bake that the inspector draws.
const _FIGURES: PackedStringArray = [
	"errors",
	"log_likelihood",
	"iterations",
	"first_view_curve",
	"seconds",
	"predicted_psnr",
	"target",
	"clamped",
	"asymmetry",
]


static func of_table(table: LobeTable) -> Dictionary[StringName, Variant]:
	var state: Dictionary[StringName, Variant] = {}
	for meta in METADATA:
		state[meta] = table.get_meta(meta) if table.has_meta(meta) else null
	for property in PROPERTIES:
		state[property] = table.get(property)
	return state


## Adds the way from one state to another to an action.
static func add_change(
	undo_redo: EditorUndoRedoManager,
	table: LobeTable,
	before: Dictionary[StringName, Variant],
	after: Dictionary[StringName, Variant]
) -> void:
	# Metadata come first: who listens to the properties looks at them. Set to null, they go.
	for meta in METADATA:
		undo_redo.add_do_method(table, &"set_meta", meta, after[meta])
		undo_redo.add_undo_method(table, &"set_meta", meta, before[meta])
	for property in PROPERTIES:
		undo_redo.add_do_property(table, property, after[property])
		undo_redo.add_undo_property(table, property, before[property])


## The state that a result of [LobeBaker] means.
static func of_result(result: Dictionary, recipe: Recipe) -> Dictionary[StringName, Variant]:
	var table := LobeTable.from_baked(result)
	describe(table, result, recipe)
	return of_table(table)


## Keeps in the table's metadata what it was baked from and how that went.
static func describe(table: LobeTable, result: Dictionary, recipe: Recipe) -> void:
	var report := {}
	for key in _FIGURES:
		if result.has(key):
			report[key] = result[key]
	table.set_meta(Recipe.META, recipe.to_dictionary())
	table.set_meta(Recipe.REPORT_META, report)
