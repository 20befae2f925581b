@tool
extends GdUnitTestSuite
## The importers in the running editor, with good files and bad ones.

const Job := preload("res://addons/lobelight/editor/bake/bake_job.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")
const MeasuredImporter := preload("res://addons/lobelight/editor/import/measured_importer.gd")
const PanoramaImporter := preload("res://addons/lobelight/editor/import/panorama_importer.gd")
const Progress := preload("res://addons/lobelight/editor/import/import_progress.gd")
const ProgressPanel := preload("res://addons/lobelight/editor/import/progress_panel.gd")
const Recipe := preload("res://addons/lobelight/editor/bake/bake_recipe.gd")

const FILES := "res://data"
const FOLDER := "res://imported"
## File, options, the first texel.
const GOOD := [
	["layers.exr", {}, Color(10, 11, 12)],
	["layers.exr", {"layer": "key"}, Color(1, 2, 3)],
	["layers.exr", {"layer": "fill", "exposure": -1.0}, Color(5, 5.5, 6)],
	["parts.exr", {}, Color(2, 2, 2)],
	["parts.exr", {"layer": "right", "mipmaps": true}, Color(4, 4, 4)],
	["numbers.exr", {}, Color(1, 2, 3)],
	["wild.exr", {}, Color(0, 65504, 65504)],
]
const BAD := [
	["alpha.exr", {}, "alpha.exr: has none of the channels R, G, B and Y, but A"],
	["cut.exr", {}, "cut.exr: is damaged"],
	["text.exr", {}, "text.exr: is neither an OpenEXR nor a Radiance"],
	["missing.exr", {}, "missing.exr"],
	["layers.exr", {"layer": "rim"}, "layers.exr: has no layer 'rim'; its layers are fill, key"],
]


func before() -> void:
	Kit.get_plugin(get_tree())
	DirAccess.make_dir_absolute(FOLDER)
	await _scan(true)


func after() -> void:
	for file in DirAccess.get_files_at(FOLDER):
		DirAccess.remove_absolute(FOLDER.path_join(file))
	DirAccess.remove_absolute(FOLDER)
	await _scan(false)


# The scan begins and ends some frames later.
func _scan(is_there: bool) -> void:
	var files := EditorInterface.get_resource_filesystem()
	files.scan()
	var is_known := func() -> bool:
		var folder := files.get_filesystem_path(FOLDER)
		return not files.is_scanning() and (folder != null) == is_there
	await Kit.wait_until(get_tree(), is_known)


# Hands a file to an importer, as the import dock does.
func _reimport(file: String, importer: String, options: Dictionary) -> String:
	var path := FOLDER.path_join(file)
	var config := ConfigFile.new()
	config.set_value("remap", "importer", importer)
	for option: String in options:
		config.set_value("params", option, options[option])
	config.save(path + ".import")
	DirAccess.copy_absolute(FILES.path_join(file), path)
	EditorInterface.get_resource_filesystem().update_file(path)
	EditorInterface.get_resource_filesystem().reimport_files([path])
	return path


func test_panoramas_are_imported_as_textures() -> void:
	for case: Array in GOOD:
		var path := _reimport(case[0], PanoramaImporter.NAME, case[1])
		var texture := (
			ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP) as ImageTexture
		)
		assert_object(texture).append_failure_message(str(case)).is_not_null()
		var image := texture.get_image()
		assert_that(image.get_size()).is_equal(Vector2i(8, 4))
		assert_int(image.get_format()).is_equal(Image.FORMAT_RGBAH)
		assert_bool(image.has_mipmaps()).is_equal((case[1] as Dictionary).has("mipmaps"))
		var texel := image.get_pixel(0, 0)
		# DWAA keeps colours within some percent.
		for channel in 3:
			var expected: float = (case[2] as Color)[channel]
			assert_float(texel[channel]).append_failure_message(str(case)).is_equal_approx(
				expected, 0.02 * expected + 1e-6
			)


func test_bad_panoramas_are_refused_in_a_sentence(
	file: String, options: Dictionary, message: String, _test_parameters := BAD
) -> void:
	var importer := PanoramaImporter.new()
	var results: Array[Error] = []
	var path := FILES.path_join(file)
	var all := {"layer": "", "exposure": 0.0, "mipmaps": false}
	all.merge(options, true)
	var sentence: String = PanoramaImporter.read_file(path, all)["error"]
	assert_str(sentence).starts_with("res://data/").contains(message)
	var import := func() -> void: results.append(importer._import(path, "user://bad", all, [], []))
	await assert_error(import).is_push_error(sentence)
	assert_int(results[0]).is_not_equal(OK)
	assert_bool(FileAccess.file_exists("user://bad.res")).is_false()


func test_layers_are_offered_in_the_import_dock() -> void:
	var importer := PanoramaImporter.new()
	var options := importer._get_import_options(FILES.path_join("layers.exr"), 0)
	assert_str(options[0]["hint_string"]).is_equal("fill,key")
	var visible := func(file: String) -> bool:
		return importer._get_option_visibility(FILES.path_join(file), &"layer", {})
	assert_bool(visible.call("layers.exr")).is_true()
	assert_bool(visible.call("numbers.exr")).is_false()


func test_what_will_hardly_look_right_is_a_warning() -> void:
	var importer := PanoramaImporter.new()
	var options := {"layer": "", "exposure": 0.0, "mipmaps": false}
	var import := func() -> void:
		var path := FILES.path_join("square.exr")
		assert_int(importer._import(path, "user://square", options, [], [])).is_equal(OK)
	var warning: String = (
		PanoramaImporter.read_file(FILES.path_join("square.exr"), options)["warnings"][0]
	)
	assert_str(warning).contains("is 8 x 8 texels, but a panorama")
	await assert_error(import).is_push_warning("res://data/square.exr: %s." % warning)
	DirAccess.remove_absolute("user://square.res")


# Of the textures, pixels change with a renderer only: tests/render/held_panorama_test.gd.
func test_what_is_imported_anew_is_what_is_loaded() -> void:
	var path := _reimport("parts.exr", PanoramaImporter.NAME, {"layer": "left"})
	var held := load(path) as ImageTexture
	assert_float(held.get_image().get_pixel(0, 0).r).is_equal(2.0)
	var changes: Array[bool] = []
	held.changed.connect(func() -> void: changes.append(true))
	for case: Array in [["right", 1.0, 8.0], ["left", 0.0, 2.0]]:
		changes.clear()
		_reimport("parts.exr", PanoramaImporter.NAME, {"layer": case[0], "exposure": case[1]})
		assert_array(changes).is_not_empty()
		var loaded := load(path) as ImageTexture
		assert_str(loaded.resource_path).is_equal(path)
		assert_float(loaded.get_image().get_pixel(0, 0).r).is_equal(case[2])
		held = loaded
		held.changed.connect(func() -> void: changes.append(true))


func test_a_failed_import_keeps_the_texture() -> void:
	var path := _reimport("parts.exr", PanoramaImporter.NAME, {"layer": "left"})
	var held := load(path) as ImageTexture
	var importer := PanoramaImporter.new()
	var options := {"layer": "middle", "exposure": 0.0, "mipmaps": false}
	var import := func() -> void:
		assert_int(importer._import(path, "user://bad", options, [], [])).is_not_equal(OK)
	await assert_error(import).is_push_error(
		path + ": has no layer 'middle'; its layers are left, right"
	)
	importer.on_reimported([path])
	assert_object(load(path)).is_same(held)
	assert_float(held.get_image().get_pixel(0, 0).r).is_equal(2.0)


func test_the_engine_keeps_its_own_importer_by_default() -> void:
	assert_float(PanoramaImporter.new()._get_priority()).is_less(1.0)


func test_measurements_are_imported_as_tables() -> void:
	var path := _reimport("white.bsdf", MeasuredImporter.NAME, {"lobes": 4})
	var table := load(path) as LobeTable
	assert_object(table).is_not_null()
	assert_str(table.get_problem()).is_empty()
	assert_int(table.lobe_count).is_equal(4)
	assert_str(table.brdf).is_equal("white.bsdf")
	var recipe: Recipe = Recipe.from_table(table)
	assert_str(recipe.brdf).is_equal(path)
	var report: Dictionary = table.get_meta(Recipe.REPORT_META)
	assert_int(report["clamped"]).is_equal(1)


# Without a window the output says how far it is.
class OneStep:
	extends Progress
	var fractions: PackedFloat64Array = []

	func step(fraction: float, seconds_left: float) -> void:
		super(fraction, seconds_left)
		fractions.append(fraction)
		is_cancelled = true


func test_a_cancelled_import_keeps_the_table_from_before() -> void:
	var path := _reimport("white.bsdf", MeasuredImporter.NAME, {"lobes": 4})
	var recipe := Recipe.new()
	recipe.brdf = path
	recipe.lobes = 32
	var job := Job.new(null, recipe)
	var progress := OneStep.new("white")
	assert_dict(MeasuredImporter.bake(job, progress)).is_empty()
	assert_str(job.error).is_empty()
	assert_int(progress.fractions.size()).is_greater(0)
	var kept := "user://kept.res"
	assert_int(MeasuredImporter._end_without_result(path, kept, "")).is_equal(ERR_SKIP)
	ResourceSaver.save(load(path), kept)
	assert_int(MeasuredImporter._end_without_result(path, kept, "")).is_equal(OK)
	assert_int((load(kept) as LobeTable).lobe_count).is_equal(4)
	DirAccess.remove_absolute(kept)


func test_the_panel_takes_clicks_on_its_button_only() -> void:
	var panel: ProgressPanel = auto_free(ProgressPanel.new())
	# Its window is made as large as it says before it is in the tree.
	panel.size = panel.find_size()
	EditorInterface.get_base_control().add_child(panel)
	assert_vector(panel.find_size()).is_equal(panel.size)
	var row := EditorInterface.get_base_control().get_theme_font_size(&"font_size", &"Label")
	assert_float(panel.size.y).is_greater(5.0 * row)
	panel.draw_now(0.5, "half")
	var place := panel._find_button()
	assert_bool(Rect2(Vector2.ZERO, panel.size).encloses(place)).is_true()
	var click := func(at: Vector2) -> bool:
		var event := InputEventMouseButton.new()
		event.button_index = MOUSE_BUTTON_LEFT
		event.position = at
		event.pressed = true
		var is_cancelled := panel.is_cancelled_by(event)
		event.pressed = false
		return panel.is_cancelled_by(event) and not is_cancelled
	assert_bool(click.call(place.get_center())).is_true()
	assert_bool(click.call(Vector2.ONE)).is_false()


func test_automatic_lobes_look_at_the_chosen_panorama() -> void:
	var importer := MeasuredImporter.new()
	var shown := func(lobes: int) -> bool:
		return importer._get_option_visibility("", &"environment", {"lobes": lobes})
	assert_bool(shown.call(Recipe.AUTOMATIC)).is_true()
	assert_bool(shown.call(8)).is_false()
	var recipe := Recipe.new()
	recipe.lobes = Recipe.AUTOMATIC
	recipe.target = 12.0
	recipe.environment = FILES.path_join("layers.exr")
	assert_array(recipe.to_request()["environments"]).is_equal([recipe.environment])
	recipe.environment = "res://missing.exr"
	assert_str(recipe.get_problem()).contains("missing.exr: there is no such file")
	recipe.environment = FILES.path_join("text.exr")
	var job := Job.new(null, recipe)
	assert_dict(MeasuredImporter.bake(job, Progress.new("sphere"))).is_empty()
	assert_str(job.error).contains("text.exr: is neither an OpenEXR nor a Radiance")


func test_what_is_no_measurement_is_refused_in_a_sentence() -> void:
	var importer := MeasuredImporter.new()
	var results: Array[Error] = []
	var recipe := Recipe.new()
	recipe.brdf = FILES.path_join("text.binary")
	recipe.lobes = 4
	var job := Job.new(null, recipe)
	assert_dict(MeasuredImporter.bake(job, Progress.new("text"))).is_empty()
	var sentence := job.error
	assert_str(sentence).starts_with("res://data/text.binary: ")
	var options := {"lobes": 4, "target": 30.0, "environment": ""}
	var import := func() -> void:
		results.append(importer._import(recipe.brdf, "user://bad", options, [], []))
	await assert_error(import).is_push_error(sentence)
	assert_int(results[0]).is_not_equal(OK)
