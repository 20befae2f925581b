@tool
extends GdUnitTestSuite
## Environment maps imported as baked lights in the running editor.

const Kit := preload("res://tests/editor/editor_kit.gd")
const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const LightImporter := preload("res://addons/lobelight/editor/import/light_importer.gd")
const PanoramaImporter := preload("res://addons/lobelight/editor/import/panorama_importer.gd")
const Progress := preload("res://addons/lobelight/editor/import/import_progress.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")

const FILES := "res://data"
const FOLDER := "res://lights"
const OPTIONS := {
	"size": 0,
	"filter": Pyramid.Filter.DISC,
	"format": LightFormats.Format.SHARED_EXPONENT,
	"layer": "",
	"exposure": 0.0,
	"max_sources": 4,
}
## File, options, texels along a face, the light's colour.
const GOOD := [
	["layers.exr", {}, 8, Color(10, 11, 12)],
	["layers.exr", {"format": LightFormats.Format.SHARED_EXPONENT}, 8, Color(10, 11, 12)],
	["layers.exr", {"layer": "key", "size": 32}, 32, Color(1, 2, 3)],
	["parts.exr", {"exposure": 1.0, "filter": Pyramid.Filter.GAUSSIAN}, 8, Color(4, 4, 4)],
]
const BAD := ["alpha.exr", "cut.exr", "text.exr", "missing.exr"]


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


# Hands a file to the importer, as the import dock does.
func _reimport(file: String, options: Dictionary) -> String:
	var path := FOLDER.path_join(file)
	var config := ConfigFile.new()
	config.set_value("remap", "importer", LightImporter.NAME)
	for option: String in options:
		config.set_value("params", option, options[option])
	config.save(path + ".import")
	DirAccess.copy_absolute(FILES.path_join(file), path)
	EditorInterface.get_resource_filesystem().update_file(path)
	EditorInterface.get_resource_filesystem().reimport_files([path])
	return path


func _get_bytes(path: String) -> PackedByteArray:
	var config := ConfigFile.new()
	config.load(path + ".import")
	return FileAccess.get_file_as_bytes(config.get_value("remap", "path", "") as String)


func _get_colour(light: LobeLight) -> Color:
	var face: Image = light.faces[2].duplicate()
	if face.is_compressed():
		face.decompress()
	return face.get_pixel(1, 1)


func test_panoramas_are_imported_as_lights() -> void:
	for case: Array in GOOD:
		var path := _reimport(case[0], case[1])
		var light: LobeLight = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
		assert_object(light).append_failure_message(str(case)).is_not_null()
		assert_str(light.get_problem()).is_empty()
		assert_int(light.size).is_equal(case[2])
		var format: LightFormats.Format = (case[1] as Dictionary).get(
			"format", LightFormats.Format.BPTC
		)
		assert_int(light.faces[0].get_format()).is_equal(LightFormats.IMAGE_FORMATS[format])
		assert_bool(light.is_of_world).is_false()
		for channel in 3:
			var expected: float = (case[3] as Color)[channel]
			(
				assert_float(_get_colour(light)[channel])
				. append_failure_message(str(case))
				. is_equal_approx(expected, 0.03 * expected)
			)
		# An import is the same whenever it is made.
		var bytes := _get_bytes(path)
		assert_int(bytes.size()).is_greater(100)
		_reimport(case[0], case[1])
		assert_bool(_get_bytes(path) == bytes).is_true()


func test_nodes_show_what_is_imported_anew() -> void:
	var path := _reimport("parts.exr", {"layer": "left"})
	var environment: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	environment.light = load(path)
	var before := environment.get_light()
	assert_float(_get_colour(before).r).is_equal_approx(2.0, 0.02)
	_reimport("parts.exr", {"layer": "right", "size": 16})
	assert_object(load(path)).is_same(environment.light)
	assert_float(_get_colour(environment.get_light()).r).is_equal_approx(4.0, 0.04)
	assert_int(environment.get_cubemap().get_width()).is_equal(16)


func test_bad_files_are_refused_in_a_sentence() -> void:
	for file: String in BAD:
		var path := FILES.path_join(file)
		var sentence: String = PanoramaImporter.read_file(path, OPTIONS)["error"]
		assert_str(sentence).starts_with("res://data/")
		var import := func() -> void:
			(
				assert_int(LightImporter.new()._import(path, "user://bad", OPTIONS, [], []))
				. is_not_equal(OK)
			)
		await assert_error(import).is_push_error(sentence)
		assert_bool(FileAccess.file_exists("user://bad.res")).is_false()


# Without a window the output says how far it is.
class OneStep:
	extends Progress

	func step(fraction: float, seconds_left: float) -> void:
		super(fraction, seconds_left)
		is_cancelled = true


func test_a_cancelled_import_makes_nothing() -> void:
	var read := LightImporter.read_file(FILES.path_join("layers.exr"), OPTIONS)
	var options := OPTIONS.merged({"size": 2048}, true)
	var made: Variant = LightImporter.filter(read, options, OneStep.new("layers"))
	assert_bool(made is LobeLight).is_false()


func test_other_importers_stay_what_files_get_by_default() -> void:
	assert_float(LightImporter.new()._get_priority()).is_less(
		PanoramaImporter.new()._get_priority()
	)
