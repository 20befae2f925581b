@tool
extends VBoxContainer
## What a [LobeTable] is to be baked from, and the button that bakes it. It stands at the top of the
## table's inspector.

const BakeQueue := preload("bake_queue.gd")
const FileField := preload("file_field.gd")
const FormRow := preload("form_row.gd")
const NativeLibrary := preload("native_library.gd")
const Presets := preload("bake_presets.gd")
const Recipe := preload("bake_recipe.gd")

const _MODEL_NAMES: PackedStringArray = ["GGX", "Ward (1992)", "Ward, bounded (2010)"]
const _LOBES: PackedInt32Array = [4, 8, 16, 24, 32, Recipe.AUTOMATIC]
const _IMPORTED := "The table is imported: set Lobes in the Import dock and Reimport."
const _WARNING_COLOR := &"warning_color"
const _ERROR_COLOR := &"error_color"

## The table to be baked.
var table: LobeTable
## What it is baked from.
var recipe: Recipe

var _queue: BakeQueue
var _is_filling := false
var _is_refreshing := false
var _preset := FormRow.make_choice(PackedStringArray(["Preset …"]) + Presets.get_names())
var _brdf := FormRow.make_choice(_MODEL_NAMES + PackedStringArray(["Measured file …"]))
var _file := FileField.make("res://gold.binary", {"*.binary": "MERL BRDF", "*.bsdf": "RGL BRDF"})
var _roughness := FormRow.make_number(0.01, 1.0, 0.001)
var _anisotropy := FormRow.make_number(-1.0, 1.1, 0.001)
var _alpha_x := FormRow.make_number(0.0001, 2.0, 0.0001)
var _alpha_y := FormRow.make_number(0.0001, 2.0, 0.0001)
var _lobes := FormRow.make_choice(["4", "8", "16", "24", "32", "Automatic"])
var _target := FormRow.make_number(10.0, 46.0, 0.5, "dB")
var _environment := FileField.make("none", {"*.exr,*.hdr": "Panoramas"})
var _bake := Button.new()
var _status := Label.new()
var _file_row: Control
var _automatic_rows: Array[Control] = []
var _width_rows: Array[Control] = []


static func make(queue: BakeQueue, for_table: LobeTable) -> VBoxContainer:
	var panel := new()
	panel._queue = queue
	panel.table = for_table
	panel.recipe = Recipe.from_table(for_table)
	panel._build()
	panel._fill()
	return panel


func _build() -> void:
	_add("Preset", _preset, "Fills in what a material is commonly like.")
	_add("BRDF", _brdf, "The reflectance to be fitted: a model, or a file of measurements.")
	_file_row = _add("File", _file, "MERL's .binary, or an RGB .bsdf of RGL's.")
	_width_rows = [
		_add("Roughness", _roughness, "As LobeMaterial3D and StandardMaterial3D have it."),
		_add(
			"Anisotropy",
			_anisotropy,
			"How much wider highlights are along the tangent: 10:1 at 1, 100:1 at 1.1."
		),
		_add("Alpha X", _alpha_x, "The microfacets' width along the tangent, as papers have it."),
		_add("Alpha Y", _alpha_y, "The microfacets' width along the bitangent."),
	]
	_add("Lobes", _lobes, "Texture fetches a pixel. Automatic takes the fewest that do.")
	_automatic_rows = [
		_add("Target", _target, "The PSNR to be reached, in decibels."),
		_add(
			"Environment",
			_environment,
			"A panorama in which the target is to be reached, besides a built-in one of small lamps."
		),
	]
	_bake.text = "Bake"
	_bake.tooltip_text = "Fits the lobes. Undo brings the table back that was there before."
	_status.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	_status.visible = false
	add_child(_bake)
	add_child(_status)
	# After changes, the same preset is another choice.
	_preset.allow_reselect = true
	_preset.item_selected.connect(_on_preset)
	_brdf.item_selected.connect(_on_brdf)
	_file.chosen.connect(_on_file)
	_roughness.value_changed.connect(_on_roughness.unbind(1))
	_anisotropy.value_changed.connect(_on_roughness.unbind(1))
	_alpha_x.value_changed.connect(_on_alpha.unbind(1))
	_alpha_y.value_changed.connect(_on_alpha.unbind(1))
	_lobes.item_selected.connect(_on_lobes)
	_target.value_changed.connect(_on_target)
	_environment.chosen.connect(_on_environment)
	_bake.pressed.connect(bake)


func _enter_tree() -> void:
	_queue.changed.connect(_update_state)
	_queue.failed.connect(_on_failed)
	_queue.baked.connect(_on_baked)
	_queue.cancelled.connect(_on_cancelled)
	table.changed.connect(_on_table_changed)
	_update_state()


func _exit_tree() -> void:
	_queue.changed.disconnect(_update_state)
	_queue.failed.disconnect(_on_failed)
	_queue.baked.disconnect(_on_baked)
	_queue.cancelled.disconnect(_on_cancelled)
	table.changed.disconnect(_on_table_changed)


## Starts the bake, as the button does.
func bake() -> void:
	_status.visible = false
	_queue.add(table, recipe)


## What the panel says of the last bake, or of what keeps it from baking; empty if there is nothing
## to say.
func get_status() -> String:
	return _status.text if _status.visible else ""


func _add(text: String, control: Control, tooltip: String) -> Control:
	var row := FormRow.make(text, control, tooltip)
	add_child(row)
	return row


# Shows the recipe.
func _fill() -> void:
	_is_filling = true
	var measured := recipe.is_measured()
	var widths := recipe.get_roughness()
	_brdf.selected = _MODEL_NAMES.size() if measured else Recipe.MODELS.find(recipe.brdf)
	_file.show_path(recipe.brdf if measured else "")
	_environment.show_path(recipe.environment)
	_roughness.value = widths.x
	_anisotropy.value = widths.y
	_alpha_x.value = recipe.alpha.x
	_alpha_y.value = recipe.alpha.y
	_target.value = recipe.target
	if recipe.lobes not in _LOBES:
		recipe.lobes = 8
	_lobes.selected = _LOBES.find(recipe.lobes)
	_file_row.visible = measured
	for row in _width_rows:
		row.visible = not measured
	for row in _automatic_rows:
		row.visible = recipe.lobes == Recipe.AUTOMATIC
	_is_filling = false


func _on_preset(index: int) -> void:
	if index > 0:
		recipe = Presets.make(index - 1)
		_fill()


func _on_brdf(index: int) -> void:
	recipe.brdf = Recipe.MODELS[index] if index < Recipe.MODELS.size() else ""
	_fill()


func _on_file(path: String) -> void:
	recipe.brdf = path
	_fill()


func _on_roughness() -> void:
	if not _is_filling:
		recipe.set_roughness(_roughness.value, _anisotropy.value)
		_fill_alpha()


func _fill_alpha() -> void:
	_is_filling = true
	_alpha_x.value = recipe.alpha.x
	_alpha_y.value = recipe.alpha.y
	_is_filling = false


func _on_alpha() -> void:
	if not _is_filling:
		recipe.alpha = Vector2(_alpha_x.value, _alpha_y.value)
		_is_filling = true
		_roughness.value = recipe.get_roughness().x
		_anisotropy.value = recipe.get_roughness().y
		_is_filling = false


func _on_lobes(index: int) -> void:
	recipe.lobes = _LOBES[index]
	_fill()


func _on_target(value: float) -> void:
	recipe.target = value


func _on_environment(path: String) -> void:
	recipe.environment = path


# Several properties change at once, by an undo for instance.
func _on_table_changed() -> void:
	if not _is_refreshing:
		_is_refreshing = true
		_refresh.call_deferred()


# The form shows what the table is made from.
func _refresh() -> void:
	_is_refreshing = false
	if is_inside_tree() and not _queue.is_baking(table):
		_preset.selected = 0
		recipe = Recipe.from_table(table)
		_fill()


func _update_state() -> void:
	var problem := NativeLibrary.get_problem()
	if Recipe.is_imported(table):
		problem = _IMPORTED
	var baking := _queue.is_baking(table)
	_bake.disabled = baking or not problem.is_empty()
	_bake.text = "Baking …" if baking else "Bake"
	if problem:
		_say(problem, _WARNING_COLOR)


func _on_failed(failed_table: LobeTable, message: String) -> void:
	if failed_table == table:
		_say(message, _ERROR_COLOR)


func _on_baked(baked_table: LobeTable) -> void:
	if baked_table == table:
		_status.visible = false


func _on_cancelled(cancelled_table: LobeTable) -> void:
	if cancelled_table == table:
		_say("Cancelled; the table is the one from before.", _WARNING_COLOR)


func _say(text: String, color: StringName) -> void:
	_status.text = text
	_status.visible = true
	_status.add_theme_color_override(&"font_color", get_theme_color(color, &"Editor"))
