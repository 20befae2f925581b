@tool
extends GdUnitTestSuite
## Bake Light of environments in the running editor. Without a screen only panoramas can be baked;
## tests/render has skies. What probes and environments have in common, probe_bake_test.gd has.

const Kit := preload("res://tests/editor/editor_kit.gd")
const LightBakes := preload("res://addons/lobelight/editor/light/light_bakes.gd")
const LightPanel := preload("res://addons/lobelight/editor/light/light_panel.gd")
const PanoramaImporter := preload("res://addons/lobelight/editor/import/panorama_importer.gd")

const FOLDER := "res://environments"
const SCENE := "res://environments/yard.tscn"
const LIGHT := "res://environments/yard.Sun.res"

var _bakes: LightBakes
var _root: Node3D
var _environment: LobeEnvironment3D
var _messages: PackedStringArray = []


# An open scene that is saved, with an environment.
func before_test() -> void:
	DirAccess.make_dir_absolute(FOLDER)
	EditorInterface.get_resource_filesystem().scan()
	await Kit.wait_for_scan(get_tree())
	_bakes = Kit.get_plugin(get_tree()).get_light_bakes()
	_bakes.failed.connect(_on_failed)
	_messages = []
	var yard := Node3D.new()
	yard.name = "Yard"
	var packed := PackedScene.new()
	packed.pack(yard)
	yard.free()
	ResourceSaver.save(packed, SCENE)
	EditorInterface.open_scene_from_path(SCENE)
	await await_idle_frame()
	_root = EditorInterface.get_edited_scene_root()
	_environment = LobeEnvironment3D.new()
	_environment.name = "Sun"
	_environment.panorama = _make_panorama(1.0)
	_root.add_child(_environment)
	_environment.owner = _root


func after_test() -> void:
	_bakes.failed.disconnect(_on_failed)
	EditorInterface.close_scene()
	await await_idle_frame()
	await Kit.wait_for_scan(get_tree())
	for file in DirAccess.get_files_at(FOLDER):
		DirAccess.remove_absolute(FOLDER.path_join(file))
	DirAccess.remove_absolute(FOLDER)


func _make_panorama(value: float) -> ImageTexture:
	var image := Image.create_empty(16, 8, false, Image.FORMAT_RGBAF)
	image.fill(Color(value, 2.0 * value, 0.5))
	return ImageTexture.create_from_image(image)


func _on_failed(_failed: Node3D, message: String) -> void:
	_messages.append(message)


func _bake() -> void:
	_bakes.add(_environment)
	await Kit.wait_until(get_tree(), func() -> bool: return _bakes.get_running() == null)


# Of a file, as a game that is started now would load it.
func _read() -> Color:
	var light: LobeLight = ResourceLoader.load(LIGHT, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	assert_str(light.get_problem()).is_empty()
	var face: Image = light.faces[0].duplicate()
	if face.is_compressed():
		face.decompress()
	return face.get_pixel(3, 3)


# As the import dock does it.
func _import_sun(path: String, exposure: float) -> void:
	var pixels := PackedFloat32Array()
	pixels.resize(256 * 128 * 3)
	pixels.fill(1.0)
	for texel: int in [64 * 256 + 30, 64 * 256 + 31, 65 * 256 + 30, 65 * 256 + 31]:
		for channel in 3:
			pixels[3 * texel + channel] = 1e6
	assert_str(LobeImageFile.save_exr(path, 256, 128, pixels)).is_empty()
	var config := ConfigFile.new()
	config.set_value("remap", "importer", PanoramaImporter.NAME)
	config.set_value("params", "exposure", exposure)
	config.save(path + ".import")
	EditorInterface.get_resource_filesystem().update_file(path)
	EditorInterface.get_resource_filesystem().reimport_files([path])


func test_a_sun_has_all_of_its_light_whatever_the_texture_holds() -> void:
	var path := FOLDER.path_join("sun.exr")
	_import_sun(path, -1.0)
	_environment.panorama = load(path)
	_environment.size = 32
	var half := _environment.panorama.get_image().get_pixel(30, 64)
	assert_float(half.r).is_equal(65504.0)
	await _bake()
	assert_array(_messages).is_empty()
	var light: LobeLight = ResourceLoader.load(LIGHT, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	assert_str(light.get_problem()).is_empty()
	assert_int(light.count_sources()).is_equal(1)
	var texel := PI / 128.0 * PI / 128.0
	assert_float(light.source_texels[16] / (4.0 * 0.5e6 * texel)).is_between(0.999, 1.001)
	var panel := LightPanel.make(_bakes, _environment)
	add_child(panel)
	assert_str(panel.get_source()).contains("32 texels and a sun or lamp")
	panel.free()
	_environment.max_sources = 0
	await _bake()
	light = ResourceLoader.load(LIGHT, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	assert_int(light.count_sources()).is_equal(0)


func test_a_panorama_is_baked_saved_undone_and_redone() -> void:
	var history := Kit.get_history(_environment)
	await _bake()
	assert_array(Array(_messages)).is_empty()
	var first := _environment.light
	assert_str(first.resource_path).is_equal(LIGHT)
	assert_int(first.size).is_equal(16)
	assert_bool(first.is_of_world).is_false()
	assert_float(_read().g).is_equal_approx(2.0, 0.01)
	assert_object(_environment.get_light()).is_not_null()
	_environment.panorama = _make_panorama(3.0)
	await _bake()
	var second := _environment.light
	assert_float(_read().g).is_equal_approx(6.0, 0.03)
	history.undo()
	assert_object(_environment.light).is_same(first)
	assert_float(_read().g).is_equal_approx(2.0, 0.01)
	history.redo()
	assert_object(_environment.light).is_same(second)
	assert_float(_read().g).is_equal_approx(6.0, 0.03)
	_bakes.clear(_environment)
	assert_object(_environment.light).is_null()
	history.undo()
	assert_object(_environment.light).is_same(second)


func test_baking_twice_gives_the_same_light() -> void:
	await _bake()
	var first := _environment.light
	await _bake()
	assert_object(_environment.light).is_not_same(first)
	for face in 6:
		var data := _environment.light.faces[face].get_data()
		assert_bool(data == first.faces[face].get_data()).is_true()


func test_what_cannot_be_baked_leaves_the_light_from_before() -> void:
	await _bake()
	var light := _environment.light
	var bytes := FileAccess.get_file_as_bytes(LIGHT)
	_environment.source = LobeEnvironment3D.Source.SKY
	await _bake()
	assert_int(_messages.size()).is_equal(1)
	assert_str(_messages[0]).contains("no renderer")
	assert_object(_environment.light).is_same(light)
	assert_bool(FileAccess.get_file_as_bytes(LIGHT) == bytes).is_true()


func test_a_cancelled_bake_leaves_the_light_from_before() -> void:
	_environment.size = 1024
	_bakes.add(_environment)
	_bakes.cancel_all()
	await Kit.wait_until(get_tree(), func() -> bool: return _bakes.get_running() == null)
	assert_object(_environment.light).is_null()
	assert_bool(FileAccess.file_exists(LIGHT)).is_false()
	assert_array(Array(_messages)).is_empty()


func test_an_environment_that_goes_while_it_is_baked_is_let_go() -> void:
	_environment.size = 256
	_bakes.add(_environment)
	_environment.free()
	var is_over := func() -> bool: return _bakes._itself == null
	assert_bool(await Kit.wait_until(get_tree(), is_over)).is_true()
	assert_array(Array(_messages)).is_empty()


func test_the_inspector_bakes_and_clears() -> void:
	EditorInterface.inspect_object(_environment)
	var panel := await _find_panel()
	assert_str(panel.get_source()).contains("Live: the light is filtered when the game runs.")
	panel.press_bake()
	await Kit.wait_until(get_tree(), func() -> bool: return _bakes.get_running() == null)
	panel = await _find_panel()
	assert_str(panel.get_source()).contains("16 texels").contains("yard.Sun.res")
	panel.press_clear()
	assert_object(_environment.light).is_null()
	EditorInterface.inspect_object(null)
	await await_idle_frame()


# The inspector makes another one when the node's properties change.
func _find_panel() -> LightPanel:
	for frame in 3:
		await await_idle_frame()
	var panels := Kit.find_all(EditorInterface.get_inspector(), LightPanel)
	assert_int(panels.size()).is_equal(1)
	return panels[0]
