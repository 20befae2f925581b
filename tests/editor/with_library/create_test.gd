@tool
extends GdUnitTestSuite
## What Lobelight > Create adds to scenes in the running editor: which nodes, in one step that can
## be undone, and nothing twice.

const CreateButton := preload("res://addons/lobelight/editor/create/create_button.gd")
const CreateMenu := preload("res://addons/lobelight/editor/create/create_menu.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")
const MaterialPresets := preload("res://addons/lobelight/editor/presets/material_presets.gd")
const SceneParts := preload("res://addons/lobelight/editor/create/scene_parts.gd")
const View3D := preload("res://addons/lobelight/editor/create/view_3d.gd")

const SCENE := "res://created.tscn"
const HEIR := "res://created_heir.tscn"
const ALL := ["WorldEnvironment", "DirectionalLight3D", "LobeEnvironment3D", "BrushedSphere"]
const TOLERANCE := 1e-4

var _menu: CreateMenu


func before_test() -> void:
	_menu = Kit.get_plugin(get_tree()).get_create_menu()
	assert_object(EditorInterface.get_edited_scene_root()).is_null()


func after_test() -> void:
	EditorInterface.get_selection().clear()
	EditorInterface.edit_resource(null)
	while EditorInterface.get_edited_scene_root() != null:
		EditorInterface.close_scene()
		await await_idle_frame()
	for path: String in [SCENE, HEIR]:
		if FileAccess.file_exists(path):
			DirAccess.remove_absolute(path)


# Saves a scene and opens it; its nodes are freed.
func _open(root: Node) -> Node:
	for node in root.find_children("*", "", true, false):
		node.owner = root
	var packed := PackedScene.new()
	packed.pack(root)
	root.free()
	ResourceSaver.save(packed, SCENE)
	EditorInterface.open_scene_from_path(SCENE)
	await await_idle_frame()
	return EditorInterface.get_edited_scene_root()


func _make_root(children: Array[Node] = []) -> Node3D:
	var root := Node3D.new()
	root.name = "Level"
	for child in children:
		root.add_child(child, true)
	return root


func _make_box(size: Vector3, place: Vector3) -> MeshInstance3D:
	var box := MeshInstance3D.new()
	box.name = "Box"
	box.mesh = BoxMesh.new()
	(box.mesh as BoxMesh).size = size
	box.position = place
	return box


func _get_names(root: Node) -> Array:
	return root.get_children().map(func(node: Node) -> String: return node.name)


func _assert_selected(node: Node) -> void:
	assert_bool(EditorInterface.get_selection().get_selected_nodes() == [node]).is_true()


func _get_history() -> UndoRedo:
	# A resource without a file belongs to the scene of the current tab.
	return Kit.get_history(Resource.new())


func test_an_empty_editor_gets_a_scene_in_one_step() -> void:
	_menu.choose(CreateMenu.Item.SPHERE)
	var root := EditorInterface.get_edited_scene_root()
	assert_str(root.get_class()).is_equal("Node3D")
	assert_array(_get_names(root)).is_equal(ALL)
	for node in root.get_children():
		assert_object(node.owner).is_same(root)
	var world: WorldEnvironment = root.get_node("WorldEnvironment")
	assert_int(world.environment.background_mode).is_equal(Environment.BG_SKY)
	assert_str(world.environment.sky.sky_material.get_class()).is_equal("ProceduralSkyMaterial")
	(
		assert_bool((root.get_node("DirectionalLight3D") as DirectionalLight3D).shadow_enabled)
		. is_true()
	)
	assert_bool(root.get_node("LobeEnvironment3D") is LobeEnvironment3D).is_true()
	var sphere: MeshInstance3D = root.get_node("BrushedSphere")
	var arrays := sphere.mesh.surface_get_arrays(0)
	assert_int((arrays[Mesh.ARRAY_TANGENT] as PackedFloat32Array).size()).is_greater(0)
	var look := MaterialPresets.find_name(sphere.material_override)
	assert_str(look).is_equal("Brushed Metal")
	var history := _get_history()
	assert_int(history.get_history_count()).is_equal(1)
	history.undo()
	assert_object(EditorInterface.get_edited_scene_root()).is_null()
	history.redo()
	assert_object(EditorInterface.get_edited_scene_root()).is_same(root)
	assert_array(_get_names(root)).is_equal(ALL)
	assert_object(sphere.owner).is_same(root)
	_assert_selected(sphere)


func test_the_sphere_is_selected_and_seen_and_its_material_shown() -> void:
	_menu.choose(CreateMenu.Item.SPHERE)
	var sphere: MeshInstance3D = EditorInterface.get_edited_scene_root().get_node("BrushedSphere")
	_assert_selected(sphere)
	var is_shown := func() -> bool:
		return EditorInterface.get_inspector().get_edited_object() == sphere.material_override
	assert_bool(await Kit.wait_until(get_tree(), is_shown)).is_true()
	var camera := EditorInterface.get_editor_viewport_3d(0).get_camera_3d()
	# The view glides there.
	var is_seen := func() -> bool:
		var way := camera.global_position.direction_to(sphere.global_position)
		return way.dot(-camera.global_basis.z) > 1.0 - TOLERANCE
	assert_bool(await Kit.wait_until(get_tree(), is_seen)).is_true()


func test_a_scene_gets_them_below_its_root_in_one_step() -> void:
	var root := await _open(_make_root([_make_box(Vector3.ONE, Vector3(5, 0, 0))]))
	var history := Kit.get_history(root)
	EditorInterface.get_selection().add_node(root.get_child(0))
	_menu.choose(CreateMenu.Item.SPHERE)
	var all := ALL.slice(0, 3) + ["Box"] + ALL.slice(3)
	assert_array(_get_names(root)).is_equal(all)
	var made := root.get_children()
	for node in made:
		assert_object(node.owner).is_same(root)
	assert_int(history.get_history_count()).is_equal(1)
	history.undo()
	assert_array(_get_names(root)).is_equal(["Box"])
	assert_object(root.get_child(0).owner).is_same(root)
	history.redo()
	assert_bool(root.get_children() == made).is_true()
	for node in made:
		assert_object(node.owner).is_same(root)


func test_nothing_comes_twice() -> void:
	_menu.choose(CreateMenu.Item.ENVIRONMENT)
	var root := EditorInterface.get_edited_scene_root()
	assert_array(_get_names(root)).is_equal(ALL.slice(0, 3))
	assert_str(CreateMenu.find_problem(CreateMenu.Item.ENVIRONMENT)).contains("already")
	_menu.choose(CreateMenu.Item.ENVIRONMENT)
	assert_int(root.get_child_count()).is_equal(3)
	_menu.choose(CreateMenu.Item.SPHERE)
	_menu.choose(CreateMenu.Item.SPHERE)
	assert_array(_get_names(root)).is_equal(ALL + ["BrushedSphere2"])
	var spheres := root.find_children("BrushedSphere*", "MeshInstance3D", false)
	assert_int(spheres.size()).is_equal(2)
	var distance := (spheres[0] as Node3D).position.distance_to((spheres[1] as Node3D).position)
	assert_float(distance).is_greater(1.0)
	assert_int(_get_history().get_history_count()).is_equal(3)


func test_light_that_a_scene_has_stays_the_only_one() -> void:
	var painted := WorldEnvironment.new()
	painted.environment = Environment.new()
	painted.environment.sky = Sky.new()
	painted.environment.sky.sky_material = PanoramaSkyMaterial.new()
	var blue := painted.duplicate() as WorldEnvironment
	blue.environment = Environment.new()
	blue.environment.sky = Sky.new()
	blue.environment.sky.sky_material = ProceduralSkyMaterial.new()
	# What the scene has, and what it lacks.
	var cases: Array[Array] = [
		[Node.new(), ["WorldEnvironment", "DirectionalLight3D", "LobeEnvironment3D"]],
		[painted, ["LobeEnvironment3D"]],
		[blue, ["DirectionalLight3D", "LobeEnvironment3D"]],
		[OmniLight3D.new(), ["WorldEnvironment", "LobeEnvironment3D"]],
		[LobeEnvironment3D.new(), ["WorldEnvironment", "DirectionalLight3D"]],
	]
	for case in cases:
		var has: Node = case[0]
		var lacks := PackedStringArray(case[1] as Array)
		assert_array(SceneParts.find_missing_light(has)).is_equal(lacks)
		var root: Node = auto_free(Node.new())
		var middle := Node.new()
		root.add_child(middle)
		middle.add_child(has)
		assert_array(SceneParts.find_missing_light(root)).is_equal(lacks)


func test_the_scene_looks_as_the_view_did() -> void:
	# It comes back when a scene with one of its own has been closed.
	var is_there := func() -> bool: return View3D.find_preview_environment() != null
	assert_bool(await Kit.wait_until(get_tree(), is_there)).is_true()
	var sky: ProceduralSkyMaterial = View3D.find_preview_environment().environment.sky.sky_material
	var colour := sky.sky_horizon_color
	var basis := View3D.find_preview_sun().basis
	_menu.choose(CreateMenu.Item.ENVIRONMENT)
	var root := EditorInterface.get_edited_scene_root()
	var world: WorldEnvironment = root.get_node("WorldEnvironment")
	var made: ProceduralSkyMaterial = world.environment.sky.sky_material
	assert_object(made).is_not_same(sky)
	assert_bool(made.sky_horizon_color == colour).is_true()
	assert_bool((root.get_node("DirectionalLight3D") as Node3D).basis == basis).is_true()
	# With a sun and a sky of its own, a scene is shown without the editor's.
	var is_gone := func() -> bool: return View3D.find_preview_environment() == null
	assert_bool(await Kit.wait_until(get_tree(), is_gone)).is_true()
	assert_object(View3D.find_preview_sun()).is_null()
	_get_history().undo()
	_menu.choose(CreateMenu.Item.ENVIRONMENT)
	world = EditorInterface.get_edited_scene_root().get_node("WorldEnvironment")
	assert_int(world.environment.background_mode).is_equal(Environment.BG_SKY)


func test_names_are_free_and_as_the_project_wants_them() -> void:
	const SETTING := "editor/naming/node_name_casing"
	var taken := Node.new()
	taken.name = "brushed_sphere"
	var root := await _open(_make_root([taken]))
	ProjectSettings.set_setting(SETTING, 2)
	_menu.choose(CreateMenu.Item.SPHERE)
	ProjectSettings.set_setting(SETTING, 0)
	assert_array(_get_names(root).slice(2)).is_equal(
		["lobe_environment_3d", "brushed_sphere", "brushed_sphere2"]
	)


func test_inherited_scenes_get_them_and_keep_their_base() -> void:
	await _open(_make_root([_make_box(Vector3.ONE, Vector3.ZERO)]))
	EditorInterface.close_scene()
	await await_idle_frame()
	EditorInterface.open_scene_from_path(SCENE, true)
	await await_idle_frame()
	var root := EditorInterface.get_edited_scene_root()
	_menu.choose(CreateMenu.Item.SPHERE)
	assert_int(root.get_child_count()).is_equal(5)
	EditorInterface.save_scene_as(HEIR, false)
	await await_idle_frame()
	assert_str(FileAccess.get_file_as_string(HEIR)).not_contains("BoxMesh").contains(SCENE)
	var loaded: PackedScene = ResourceLoader.load(HEIR, "", ResourceLoader.CACHE_MODE_IGNORE)
	var heir: Node = auto_free(loaded.instantiate())
	assert_array(_get_names(heir)).is_equal(_get_names(root))
	var sphere: MeshInstance3D = heir.get_node("BrushedSphere")
	var look := MaterialPresets.find_name(sphere.material_override)
	assert_str(look).is_equal("Brushed Metal")


func test_a_probe_fits_the_selected_room() -> void:
	var room := Node3D.new()
	room.name = "Room"
	room.add_child(_make_box(Vector3(6, 0.2, 8), Vector3(0, -1.4, 0)), true)
	room.add_child(_make_box(Vector3(6, 0.2, 8), Vector3(0, 1.4, 0)), true)
	var hidden := _make_box(Vector3(50, 1, 1), Vector3.ZERO)
	hidden.hide()
	room.add_child(hidden, true)
	room.add_child(GPUParticles3D.new(), true)
	room.rotation.y = 0.6
	room.position = Vector3(3, 1, 2)
	var root := await _open(_make_root([room])) as Node3D
	root.rotation = Vector3(0.0, 0.3, 0.0)
	root.position = Vector3(-7, 0, 4)
	assert_str(CreateMenu.find_problem(CreateMenu.Item.PROBE)).contains("Select")
	_menu.choose(CreateMenu.Item.PROBE)
	assert_int(root.get_child_count()).is_equal(1)
	EditorInterface.get_selection().add_node(root.get_child(0))
	assert_str(CreateMenu.find_problem(CreateMenu.Item.PROBE)).is_empty()
	_menu.choose(CreateMenu.Item.PROBE)
	var probe: LobeProbe3D = root.get_node("LobeProbe3D")
	assert_vector(probe.size).is_equal_approx(Vector3(6, 3, 8), TOLERANCE * Vector3.ONE)
	var place := (root.get_child(0) as Node3D).global_transform
	assert_bool(probe.get_box().is_equal_approx(place)).is_true()
	assert_object(probe.owner).is_same(root)
	_assert_selected(probe)
	var history := Kit.get_history(root)
	assert_int(history.get_history_count()).is_equal(1)
	history.undo()
	assert_array(_get_names(root)).is_equal(["Room"])


func test_the_menus_say_what_they_cannot_do() -> void:
	var buttons := Kit.find_all(EditorInterface.get_base_control(), CreateButton)
	assert_int(buttons.size()).is_equal(1)
	var button: MenuButton = buttons[0]
	assert_str(button.text).is_equal("Lobelight")
	var is_in_view := func() -> bool:
		var node: Node = button
		while node != null and not node.is_class("Node3DEditor"):
			node = node.get_parent()
		return node != null
	assert_bool(is_in_view.call()).is_true()
	var menu := button.get_popup()
	menu.about_to_popup.emit()
	assert_bool(menu.is_item_disabled(CreateMenu.Item.SPHERE)).is_false()
	assert_str(menu.get_item_tooltip(CreateMenu.Item.SPHERE)).contains("sphere")
	assert_bool(menu.is_item_disabled(CreateMenu.Item.PROBE)).is_true()
	assert_str(menu.get_item_tooltip(CreateMenu.Item.PROBE)).contains("Select")
	for index in menu.item_count:
		assert_object(menu.get_item_icon(index)).is_not_null()
	menu.id_pressed.emit(CreateMenu.Item.ENVIRONMENT)
	assert_int(EditorInterface.get_edited_scene_root().get_child_count()).is_equal(3)
	menu.about_to_popup.emit()
	assert_bool(menu.is_item_disabled(CreateMenu.Item.ENVIRONMENT)).is_true()
	assert_str(menu.get_item_tooltip(CreateMenu.Item.ENVIRONMENT)).contains("already")
	# The same items below Project > Tools.
	var tools: PopupMenu = Kit.get_plugin(get_tree()).get_tools_menu()
	var created := tools.get_item_submenu_node(0)
	for index in menu.item_count:
		assert_str(created.get_item_text(index)).is_equal(menu.get_item_text(index))
	assert_int(created.item_count).is_equal(menu.item_count)
