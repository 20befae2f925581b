@tool
extends GdUnitTestSuite
## Lights of probes that are baked and saved beside their scene. The captures are made up here, as
## an editor without a screen draws nothing; tests/render has real ones.

const Kit := preload("res://tests/editor/editor_kit.gd")
const LightBakes := preload("res://addons/lobelight/editor/light/light_bakes.gd")
const LightDialog := preload("res://addons/lobelight/editor/light/light_dialog.gd")
const LightFile := preload("res://addons/lobelight/editor/light/light_file.gd")
const LightPanel := preload("res://addons/lobelight/editor/light/light_panel.gd")
const ToolsMenu := preload("res://addons/lobelight/editor/menu/tools_menu.gd")

const FOLDER := "res://probes"
const SCENE := "res://probes/house.tscn"
const LIGHT := "res://probes/house.Hall.res"

var _bakes: LightBakes
var _root: Node3D
var _probe: LobeProbe3D
var _messages: PackedStringArray = []
var _shade := 0.0


# An open scene that is saved, with a probe.
func before_test() -> void:
	DirAccess.make_dir_absolute(FOLDER)
	EditorInterface.get_resource_filesystem().scan()
	await Kit.wait_for_scan(get_tree())
	_bakes = Kit.get_plugin(get_tree()).get_light_bakes()
	_bakes.capture = _capture
	_bakes.failed.connect(_on_failed)
	_messages = []
	_root = await _open(SCENE)
	_probe = _add_probe("Hall", _root)


func after_test() -> void:
	_bakes.capture = _bakes._capture
	_bakes.failed.disconnect(_on_failed)
	EditorInterface.close_scene()
	await await_idle_frame()
	# A scan under way reads the scenes that are to go.
	await Kit.wait_for_scan(get_tree())
	for file in DirAccess.get_files_at(FOLDER):
		DirAccess.remove_absolute(FOLDER.path_join(file))
	for folder in DirAccess.get_directories_at(FOLDER):
		DirAccess.remove_absolute(FOLDER.path_join(folder))
	DirAccess.remove_absolute(FOLDER)


func _on_failed(_failed: LobeProbe3D, message: String) -> void:
	_messages.append(message)


func _open(path: String) -> Node3D:
	var room := Node3D.new()
	room.name = path.get_file().get_basename().capitalize()
	var packed := PackedScene.new()
	packed.pack(room)
	room.free()
	ResourceSaver.save(packed, path)
	EditorInterface.open_scene_from_path(path)
	await await_idle_frame()
	return EditorInterface.get_edited_scene_root()


func _add_probe(name: String, parent: Node) -> LobeProbe3D:
	var probe := LobeProbe3D.new()
	probe.name = name
	parent.add_child(probe)
	probe.owner = _root
	return probe


# A light whose faces tell of the bake that it is from.
func _make_light(shade: float) -> LobeLight:
	var light := LobeLight.new()
	var faces: Array[Image] = []
	for face in 6:
		var image := Image.create_empty(8, 8, true, Image.FORMAT_RGBAH)
		image.fill(Color(shade, 0.25 * face, 100.0))
		image.generate_mipmaps()
		faces.append(image)
	light.faces = faces
	light.size = 8
	light.is_even = true
	light.base_variance = 0.5
	return light


func _capture(_captured: LobeProbe3D) -> Variant:
	_shade += 1.0
	var light := _make_light(_shade)
	await await_idle_frame()
	await await_idle_frame()
	return light


func _bake(probe: LobeProbe3D) -> void:
	_bakes.add(probe)
	await Kit.wait_until(get_tree(), func() -> bool: return _bakes.get_running() == null)


# Of a file, as a game that is started now would load it.
func _read_shade(path: String) -> float:
	var light: LobeLight = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	assert_str(light.get_problem()).is_empty()
	return light.faces[0].get_pixel(0, 0).r


func test_a_light_is_saved_beside_the_scene_and_shown() -> void:
	await _bake(_probe)
	assert_array(Array(_messages)).is_empty()
	assert_str(_probe.light.resource_path).is_equal(LIGHT)
	var light: LobeLight = ResourceLoader.load(LIGHT, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	var made := _make_light(_shade)
	for face in 6:
		assert_array(Array(light.faces[face].get_data())).is_equal(
			Array(made.faces[face].get_data())
		)
	assert_int(light.size).is_equal(8)
	assert_bool(light.is_even).is_true()
	assert_float(light.base_variance).is_equal(0.5)
	# No temporary file is left, nor does the editor list one.
	var files := ["house.tscn", "house.Hall.res"]
	assert_array(Array(DirAccess.get_files_at(FOLDER))).contains_exactly_in_any_order(files)
	var listed := EditorInterface.get_resource_filesystem().get_filesystem_path(FOLDER)
	var names: Array[String] = []
	for index in listed.get_file_count() if listed != null else 0:
		names.append(listed.get_file(index))
	assert_array(names).contains(["house.Hall.res"])
	assert_array(names).not_contains([".house.Hall.res"])


func test_a_scene_is_saved_with_its_light() -> void:
	await _bake(_probe)
	EditorInterface.save_scene_as(SCENE, false)
	await await_idle_frame()
	var text := FileAccess.get_file_as_string(SCENE)
	assert_str(text).contains('path="%s"' % LIGHT)
	var loaded := ResourceLoader.load(SCENE, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	var instance: Node = auto_free((loaded as PackedScene).instantiate())
	var light: LobeLight = (instance.get_node("Hall") as LobeProbe3D).light
	assert_float(light.faces[0].get_pixel(0, 0).r).is_equal(_shade)


func test_undo_and_redo_of_bakes_change_the_file_too() -> void:
	var history := Kit.get_history(_probe)
	await _bake(_probe)
	var first := _probe.light
	await _bake(_probe)
	var second := _probe.light
	assert_object(second).is_not_same(first)
	assert_float(_read_shade(LIGHT)).is_equal(_shade)
	var uid := ResourceLoader.get_resource_uid(LIGHT)
	for round in 2:
		history.undo()
		assert_object(_probe.light).is_same(first)
		assert_float(_read_shade(LIGHT)).is_equal(_shade - 1.0)
		history.undo()
		assert_object(_probe.light).is_null()
		history.redo()
		assert_object(_probe.light).is_same(first)
		assert_float(_read_shade(LIGHT)).is_equal(_shade - 1.0)
		history.redo()
		assert_object(_probe.light).is_same(second)
		assert_float(_read_shade(LIGHT)).is_equal(_shade)
	# Scenes refer to it by this as well.
	assert_int(ResourceLoader.get_resource_uid(LIGHT)).is_equal(uid)


func test_clearing_goes_back_to_captures_and_can_be_undone() -> void:
	var history := Kit.get_history(_probe)
	await _bake(_probe)
	var light := _probe.light
	_bakes.clear(_probe)
	assert_object(_probe.light).is_null()
	history.undo()
	assert_object(_probe.light).is_same(light)
	history.redo()
	assert_object(_probe.light).is_null()
	assert_float(_read_shade(LIGHT)).is_equal(_shade)
	# There is nothing to clear, and no step.
	var version := history.get_version()
	_bakes.clear(_probe)
	assert_int(history.get_version()).is_equal(version)


func test_a_failed_capture_loses_nothing() -> void:
	await _bake(_probe)
	var light := _probe.light
	var version := Kit.get_history(_probe).get_version()
	_bakes.capture = func(_captured: LobeProbe3D) -> Variant: return "The lamp is out."
	await _bake(_probe)
	assert_array(Array(_messages)).contains_exactly(["The lamp is out."])
	assert_object(_probe.light).is_same(light)
	assert_float(_read_shade(LIGHT)).is_equal(_shade)
	assert_int(Kit.get_history(_probe).get_version()).is_equal(version)


func test_a_file_that_cannot_be_written_loses_nothing() -> void:
	DirAccess.make_dir_absolute(LIGHT)
	await _bake(_probe)
	assert_int(_messages.size()).is_equal(1)
	assert_str(_messages[0]).starts_with(LIGHT + " cannot be written: ")
	assert_object(_probe.light).is_null()
	assert_array(Array(DirAccess.get_files_at(FOLDER))).contains_exactly(["house.tscn"])


func test_a_cancelled_bake_loses_nothing() -> void:
	await _bake(_probe)
	var light := _probe.light
	var version := Kit.get_history(_probe).get_version()
	var other := _add_probe("Yard", _root)
	var told: Array[LobeProbe3D] = []
	var tell := func(probe: LobeProbe3D) -> void: told.append(probe)
	_bakes.cancelled.connect(tell)
	_bakes.add(_probe)
	_bakes.add(other)
	assert_that(_bakes.get_progress()).is_equal(Vector2i(0, 2))
	_bakes.cancel_all()
	await Kit.wait_until(get_tree(), func() -> bool: return _bakes.get_running() == null)
	_bakes.cancelled.disconnect(tell)
	assert_array(told).contains_exactly_in_any_order([other, _probe])
	assert_object(_probe.light).is_same(light)
	assert_object(other.light).is_null()
	assert_float(_read_shade(LIGHT)).is_equal(_shade - 1.0)
	assert_int(Kit.get_history(_probe).get_version()).is_equal(version)
	assert_array(Array(_messages)).is_empty()


func test_a_scene_that_was_never_saved_is_told_so() -> void:
	_root.scene_file_path = ""
	await _bake(_probe)
	assert_int(_messages.size()).is_equal(1)
	assert_str(_messages[0]).contains("Save the scene first")
	var menu: ToolsMenu = Kit.get_plugin(get_tree()).get_tools_menu()
	assert_str(menu.bake_probes(_root)).contains("Save the scene first")
	assert_object(_probe.light).is_null()
	_root.scene_file_path = SCENE


func test_a_probe_that_goes_while_it_is_captured_is_let_go() -> void:
	_bakes.add(_probe)
	var other := _add_probe("Yard", _root)
	_bakes.add(other)
	other.free()
	_probe.free()
	for frame in 5:
		await await_idle_frame()
	assert_that(_bakes.get_progress()).is_equal(Vector2i(2, 2))
	assert_array(Array(_messages)).is_empty()


func test_copies_of_a_probe_have_files_of_their_own() -> void:
	await _bake(_probe)
	var copy: LobeProbe3D = _probe.duplicate()
	copy.name = "Copy"
	_root.add_child(copy)
	copy.owner = _root
	assert_object(copy.light).is_same(_probe.light)
	await _bake(copy)
	assert_str(copy.light.resource_path).is_equal("res://probes/house.Copy.res")
	# A name that was another's before, as that one keeps its file.
	_probe.name = "Lobby"
	copy.name = "Hall"
	_bakes.clear(copy)
	await _bake(_probe)
	assert_str(_probe.light.resource_path).is_equal(LIGHT)
	await _bake(copy)
	assert_str(copy.light.resource_path).is_equal("res://probes/house.Hall_2.res")


func test_files_have_names_that_every_system_takes() -> void:
	await _bake(_probe)
	var other := _add_probe("hall", _root)
	await _bake(other)
	assert_str(other.light.resource_path).is_equal("res://probes/house.hall_2.res")
	other = _add_probe("Why?", _root)
	assert_str(LightFile.choose_path(other, _root)).is_equal("res://probes/house.Why_.res")


func test_a_long_bake_shows_a_dialog_that_cancels_it() -> void:
	var state := {"ends": false}
	_bakes.capture = func(_captured: LobeProbe3D) -> Variant:
		while not state["ends"]:
			await await_idle_frame()
		return _make_light(1.0)
	_bakes.add(_probe)
	_bakes.add(_add_probe("Yard", _root))
	var base := EditorInterface.get_base_control()
	var dialog: LightDialog = Kit.find_all(base, LightDialog)[0]
	assert_bool(await Kit.wait_until(get_tree(), func() -> bool: return dialog.visible)).is_true()
	assert_str(dialog._what.text).is_equal("Capturing Hall, 1 of 2")
	dialog.custom_action.emit(&"cancel_bake")
	state["ends"] = true
	var is_over := func() -> bool: return _bakes.get_running() == null and not dialog.visible
	assert_bool(await Kit.wait_until(get_tree(), is_over)).is_true()
	assert_object(_probe.light).is_null()
	assert_bool(FileAccess.file_exists(LIGHT)).is_false()


func test_disabling_the_addon_ends_a_bake() -> void:
	var was_frugal := OS.low_processor_usage_mode
	_bakes.add(_probe)
	assert_bool(OS.low_processor_usage_mode).is_false()
	EditorInterface.set_plugin_enabled(Kit.ADDON, false)
	for frame in 6:
		await await_idle_frame()
	assert_bool(OS.low_processor_usage_mode).is_equal(was_frugal)
	assert_object(_probe.light).is_null()
	assert_bool(FileAccess.file_exists(LIGHT)).is_false()
	assert_array(_probe.get_gizmos()).is_empty()
	# What the suite goes on with.
	Kit.get_plugin(get_tree())


func test_the_menu_bakes_all_that_the_scene_saves() -> void:
	var menu: ToolsMenu = Kit.get_plugin(get_tree()).get_tools_menu()
	var floor_one := Node3D.new()
	floor_one.name = "Floor"
	_root.add_child(floor_one)
	floor_one.owner = _root
	var deep := _add_probe("Hall", floor_one)
	# Another scene with a probe, as an instance.
	var shed := Node3D.new()
	shed.name = "Shed"
	var inner := LobeProbe3D.new()
	inner.name = "Inside"
	shed.add_child(inner)
	inner.owner = shed
	var packed := PackedScene.new()
	packed.pack(shed)
	shed.free()
	ResourceSaver.save(packed, FOLDER.path_join("shed.tscn"))
	packed.take_over_path(FOLDER.path_join("shed.tscn"))
	var instance := packed.instantiate()
	_root.add_child(instance)
	instance.owner = _root
	var text := menu.bake_probes(_root)
	assert_str(text).contains("2 probes").contains("1 probe of instanced scenes")
	await Kit.wait_until(get_tree(), func() -> bool: return _bakes.get_running() == null)
	assert_str(_probe.light.resource_path).is_equal(LIGHT)
	assert_str(deep.light.resource_path).is_equal("res://probes/house.Floor_Hall.res")
	inner = instance.get_node("Inside")
	assert_object(inner.light).is_null()
	await _bake(inner)
	assert_str(_messages[0]).contains("instanced scene")
	_root.set_editable_instance(instance, true)
	await _bake(inner)
	assert_str(inner.light.resource_path).is_equal("res://probes/house.Shed_Inside.res")
	var empty: Node3D = auto_free(Node3D.new())
	assert_str(menu.bake_probes(empty)).contains("no LobeProbe3D")


func test_the_inspector_bakes_and_clears() -> void:
	EditorInterface.inspect_object(_probe)
	var panel := await _find_panel()
	assert_str(panel.get_source()).contains("Live")
	panel.press_bake()
	await Kit.wait_until(get_tree(), func() -> bool: return _bakes.get_running() == null)
	panel = await _find_panel()
	assert_str(panel.get_status()).is_empty()
	assert_str(panel.get_source()).contains("8 texels").contains("house.Hall.res")
	_bakes.capture = func(_captured: LobeProbe3D) -> Variant: return "The lamp is out."
	panel.press_bake()
	assert_str(panel.get_status()).is_equal("The lamp is out.")
	panel.press_clear()
	assert_object(_probe.light).is_null()
	panel = await _find_panel()
	assert_str(panel.get_source()).contains("Live")
	EditorInterface.inspect_object(null)
	await await_idle_frame()


# The inspector makes another one when the probe's properties change.
func _find_panel() -> LightPanel:
	for frame in 3:
		await await_idle_frame()
	var panels := Kit.find_all(EditorInterface.get_inspector(), LightPanel)
	assert_int(panels.size()).is_equal(1)
	return panels[0]
