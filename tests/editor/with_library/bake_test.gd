@tool
extends GdUnitTestSuite
## The inspector of a LobeTable in the running editor: bake, cancel, undo, redo and errors.

const BakePanel := preload("res://addons/lobelight/editor/bake/bake_panel.gd")
const BakeQueue := preload("res://addons/lobelight/editor/bake/bake_queue.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")
const Presets := preload("res://addons/lobelight/editor/bake/bake_presets.gd")
const Recipe := preload("res://addons/lobelight/editor/bake/bake_recipe.gd")
const TableState := preload("res://addons/lobelight/editor/bake/table_state.gd")
const CASES := [
	["", "Choose a file"],
	["res://missing.binary", "there is no such file"],
	["user://damaged.binary", "damaged.binary"],
]

var _bakes: BakeQueue
var _failures: PackedStringArray = []


func before() -> void:
	_bakes = Kit.get_plugin(get_tree()).get_bakes()
	_bakes.failed.connect(_on_failed)


func after() -> void:
	_bakes.failed.disconnect(_on_failed)
	EditorInterface.inspect_object(null)


func before_test() -> void:
	_failures.clear()


func _on_failed(_table: LobeTable, message: String) -> void:
	_failures.append(message)


func _recipe(alpha := Vector2(0.3, 0.3), lobes := 2) -> Recipe:
	var recipe := Recipe.new()
	recipe.alpha = alpha
	recipe.lobes = lobes
	return recipe


# The panel in the inspector, as a user has it.
func _inspect(table: LobeTable) -> BakePanel:
	EditorInterface.inspect_object(table)
	await await_idle_frame()
	await await_idle_frame()
	var panels := Kit.find_all(EditorInterface.get_inspector(), BakePanel)
	return panels[0] if panels.size() == 1 else null


func _bake(table: LobeTable, recipe: Recipe) -> bool:
	_bakes.add(table, recipe)
	return await _ends(table)


func _ends(table: LobeTable) -> bool:
	return await Kit.wait_until(get_tree(), func() -> bool: return not _bakes.is_baking(table))


func test_the_inspector_bakes_and_undoes_and_redoes() -> void:
	var table := LobeTable.new()
	var empty := TableState.of_table(table)
	var panel := await _inspect(table)
	assert_object(panel).is_not_null()
	panel.recipe = _recipe(Vector2(0.2, 0.4), 3)
	panel.bake()
	assert_bool(await _ends(table)).is_true()
	assert_array(_failures).is_empty()
	assert_str(table.get_problem()).is_empty()
	assert_str(table.brdf).is_equal("ggx")
	assert_int(table.lobe_count).is_equal(3)
	assert_bool(table.alpha.is_equal_approx(Vector2(0.2, 0.4))).is_true()
	var baked := TableState.of_table(table)
	var history := Kit.get_history(table)
	assert_str(history.get_current_action_name()).is_equal("Bake LobeTable")
	history.undo()
	assert_dict(TableState.of_table(table)).is_equal(empty)
	assert_bool(table.has_meta(Recipe.META)).is_false()
	history.redo()
	assert_dict(TableState.of_table(table)).is_equal(baked)
	assert_object(table.image).is_same(baked[&"image"])


func test_a_second_bake_is_undone_to_the_first() -> void:
	var table := LobeTable.new()
	await _bake(table, _recipe(Vector2(0.3, 0.3)))
	var first := TableState.of_table(table)
	var bytes := table.image.get_data()
	await _bake(table, _recipe(Vector2(0.5, 0.5), 4))
	assert_int(table.lobe_count).is_equal(4)
	Kit.get_history(table).undo()
	assert_dict(TableState.of_table(table)).is_equal(first)
	assert_array(table.image.get_data()).is_equal(bytes)


func test_the_same_recipe_gives_what_the_library_gives() -> void:
	var table := LobeTable.new()
	var recipe := _recipe()
	await _bake(table, recipe)
	var expected: Dictionary = LobeBaker.new().bake(recipe.to_request())
	assert_array(table.image.get_data()).is_equal(expected["data"])
	var report: Dictionary = table.get_meta(Recipe.REPORT_META)
	assert_int((report["errors"] as PackedFloat32Array).size()).is_equal(16)
	assert_int((report["first_view_curve"] as PackedFloat32Array).size()).is_greater(1)


func test_a_cancelled_bake_leaves_the_table() -> void:
	var table := LobeTable.new()
	await _bake(table, _recipe())
	var before_bake := TableState.of_table(table)
	var version := Kit.get_history(table).get_version()
	_bakes.add(table, _recipe(Vector2(0.05, 0.4), 32))
	await await_idle_frame()
	assert_bool(_bakes.is_baking(table)).is_true()
	_bakes.cancel_all()
	assert_bool(await _ends(table)).is_true()
	assert_array(_failures).is_empty()
	assert_dict(TableState.of_table(table)).is_equal(before_bake)
	assert_int(Kit.get_history(table).get_version()).is_equal(version)


func test_the_editor_goes_on_while_a_bake_runs() -> void:
	var table := LobeTable.new()
	_bakes.add(table, _recipe(Vector2(0.05, 0.4), 32))
	for frame in 3:
		await await_idle_frame()
	assert_bool(_bakes.is_baking(table)).is_true()
	assert_float(_bakes.get_running().get_progress()).is_between(0.0, 1.0)
	_bakes.cancel_all()
	await _ends(table)


func test_tables_wait_for_each_other_and_are_not_baked_twice() -> void:
	var tables: Array[LobeTable] = [LobeTable.new(), LobeTable.new()]
	for table in tables:
		_bakes.add(table, _recipe())
		_bakes.add(table, _recipe())
	assert_int(_bakes.get_waiting_count()).is_equal(1)
	for table in tables:
		await _ends(table)
		assert_str(table.get_problem()).is_empty()
		Kit.get_history(table).undo()


func test_what_cannot_be_baked_is_said_in_a_sentence(
	brdf: String, text: String, _test_parameters := CASES
) -> void:
	var table := LobeTable.new()
	var empty := TableState.of_table(table)
	var panel := await _inspect(table)
	panel.recipe = _recipe()
	panel.recipe.brdf = brdf
	if brdf.ends_with("damaged.binary"):
		var file := FileAccess.open(brdf, FileAccess.WRITE)
		file.store_string("not a measurement")
		file.close()
	panel.bake()
	await _ends(table)
	assert_int(_failures.size()).is_equal(1)
	assert_str(_failures[0]).contains(text)
	assert_str(panel.get_status()).is_equal(_failures[0])
	assert_dict(TableState.of_table(table)).is_equal(empty)


func test_a_target_that_is_out_of_reach_is_said() -> void:
	var table := LobeTable.new()
	var recipe := _recipe(Vector2(0.4, 0.4), Recipe.AUTOMATIC)
	recipe.target = 8.0
	await _bake(table, recipe)
	assert_array(_failures).is_empty()
	assert_int(table.lobe_count).is_equal(1)
	recipe.target = 99.0
	await _bake(table, recipe)
	assert_int(_failures.size()).is_equal(1)
	assert_str(_failures[0]).contains("target")
	assert_int(table.lobe_count).is_equal(1)


func test_imported_tables_are_baked_by_their_importer() -> void:
	var table := LobeTable.new()
	table.take_over_path("res://imported.bsdf")
	var panel := await _inspect(table)
	assert_bool(panel._bake.disabled).is_true()
	assert_str(panel.get_status()).contains("Reimport")
	table.take_over_path("")
	panel = await _inspect(LobeTable.new())
	assert_bool(panel._bake.disabled).is_false()
	assert_str(panel.get_status()).is_empty()


func test_presets_are_recipes_that_the_library_takes() -> void:
	for index in Presets.LIST.size():
		var recipe := Presets.make(index)
		assert_str(recipe.get_problem()).is_empty()
		var baker := LobeBaker.new()
		assert_bool(baker.start(recipe.to_request())).is_true()
		baker.cancel()


func test_roughness_and_widths_go_together() -> void:
	var recipe := Recipe.new()
	recipe.set_roughness(0.4, 0.9)
	assert_vector(recipe.get_roughness()).is_equal_approx(Vector2(0.4, 0.9), Vector2(1e-4, 1e-4))
	assert_vector(recipe.alpha).is_equal_approx(
		LobeMaterial3D.widths_of(0.4, 0.9), Vector2(1e-6, 1e-6)
	)
