@tool
extends GdUnitTestSuite
## Warnings about scenes, and the menu for them, in the running editor.

const BakeQueue := preload("res://addons/lobelight/editor/bake/bake_queue.gd")
const Kit := preload("res://tests/editor/editor_kit.gd")
const Recipe := preload("res://addons/lobelight/editor/bake/bake_recipe.gd")
const SceneReport := preload("res://addons/lobelight/editor/menu/scene_report.gd")
const SceneUsage := preload("res://addons/lobelight/editor/menu/scene_usage.gd")
const SceneWarnings := preload("res://addons/lobelight/editor/warnings/scene_warnings.gd")
const ToolsMenu := preload("res://addons/lobelight/editor/menu/tools_menu.gd")
const WarningRefresh := preload("res://addons/lobelight/editor/warnings/warning_refresh.gd")
const WarningLabel := preload("res://addons/lobelight/editor/warnings/warning_label.gd")
const WarningList := preload("res://addons/lobelight/editor/warnings/warning_list.gd")


# A sphere with a material that has a table of its own.
func _make_scene() -> Node3D:
	var root: Node3D = auto_free(Node3D.new())
	var sphere := MeshInstance3D.new()
	sphere.mesh = SphereMesh.new()
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.resource_name = "steel"
	material.table = LobeTable.new()
	sphere.material_override = material
	root.add_child(sphere)
	return root


func _add_sky(root: Node) -> void:
	var world := WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_SKY
	world.environment.sky = Sky.new()
	root.add_child(world)


func test_a_scene_without_an_environment_is_told_so() -> void:
	var root := _make_scene()
	assert_str("\n".join(SceneWarnings.of_scene(root))).contains("has no LobeEnvironment3D")
	var environment := LobeEnvironment3D.new()
	root.add_child(environment)
	var text := "\n".join(SceneWarnings.of_scene(root))
	assert_str(text).not_contains("has no LobeEnvironment3D")
	assert_str(text).contains("has no sky")
	_add_sky(root)
	assert_array(SceneWarnings.of_environment(environment, root)).is_empty()


func test_a_table_without_lobes_is_told_so() -> void:
	var root := _make_scene()
	var material: LobeMaterial3D = (root.get_child(0) as MeshInstance3D).material_override
	var text := "\n".join(SceneWarnings.of_material(material, null))
	assert_str(text).contains("press Bake")
	material.table = LobeTable.make_single_lobe()
	assert_array(SceneWarnings.of_material(material, null)).is_empty()


func test_poor_panoramas_are_told_so() -> void:
	var environment: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	var image := Image.create_empty(64, 32, false, Image.FORMAT_RGB8)
	environment.panorama = ImageTexture.create_from_image(image)
	var text := "\n".join(SceneWarnings.of_environment(environment, null))
	assert_str(text).contains("only 64 texels")
	assert_str(text).contains("no values above 1")
	image = Image.create_empty(1024, 512, false, Image.FORMAT_RGBAH)
	environment.panorama = ImageTexture.create_from_image(image)
	assert_array(SceneWarnings.of_environment(environment, null)).is_empty()


func test_skies_are_looked_at_too() -> void:
	var root := _make_scene()
	var environment := LobeEnvironment3D.new()
	root.add_child(environment)
	_add_sky(root)
	var world: WorldEnvironment = root.get_child(2)
	var material := PanoramaSkyMaterial.new()
	world.environment.sky.sky_material = material
	var text := "\n".join(SceneWarnings.of_environment(environment, root))
	assert_str(text).contains("sky's panorama is not set")
	var image := Image.create_empty(64, 32, false, Image.FORMAT_RGB8)
	material.panorama = ImageTexture.create_from_image(image)
	text = "\n".join(SceneWarnings.of_environment(environment, root))
	assert_str(text).contains("sky's panorama is only 64").contains("no values above 1")
	# The node's own panorama counts instead.
	image = Image.create_empty(1024, 512, false, Image.FORMAT_RGBAH)
	environment.panorama = ImageTexture.create_from_image(image)
	assert_array(SceneWarnings.of_environment(environment, root)).is_empty()


func test_skies_that_change_unseen_are_told_so() -> void:
	var root := _make_scene()
	var environment := LobeEnvironment3D.new()
	root.add_child(environment)
	_add_sky(root)
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	(root.get_child(2) as WorldEnvironment).environment.sky.sky_material = material
	for global: bool in [false, true]:
		var kind := "global uniform" if global else "uniform"
		material.shader.code = "shader_type sky;\n%s vec4 colour;\nvoid sky() {}" % kind
		var text := "\n".join(SceneWarnings.of_environment(environment, root))
		assert_bool(text.contains("reads a global uniform")).is_equal(global)
	environment.update_mode = LobeEnvironment3D.UpdateMode.EVERY_FRAME
	var text := "\n".join(SceneWarnings.of_environment(environment, root))
	assert_str(text).not_contains("global uniform")


func test_sets_that_textures_cannot_use_are_told_so() -> void:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.4
	material.roughness_texture = ImageTexture.new()
	material.anisotropy = 0.5
	material.anisotropy_enabled = true
	assert_array(SceneWarnings.of_material(material, null)).is_empty()
	var tables := LobeTableSet.new()
	tables.lobe_count = 1
	tables.views = Vector2i(2, 2)
	for i in 23:
		tables.widths.append(0.01 * pow(1.2, i))
	tables.image = Image.create_empty(2, 2 * 276 + 23, false, Image.FORMAT_RGBAH)
	material.table_set = tables
	var text := "\n".join(SceneWarnings.of_material(material, null))
	assert_str(text).contains("do not change its lobes").contains("256 layers")


func test_captures_of_nothing_are_told_so() -> void:
	var root := _make_scene()
	var environment := LobeEnvironment3D.new()
	environment.source = LobeEnvironment3D.Source.CAPTURE
	root.add_child(environment)
	assert_array(SceneWarnings.of_environment(environment, root)).is_empty()
	environment.capture_cull_mask = 2
	var text := "\n".join(SceneWarnings.of_environment(environment, root))
	assert_str(text).contains("nothing to capture")
	_add_sky(root)
	assert_array(SceneWarnings.of_environment(environment, root)).is_empty()
	environment.capture_near = 2.0
	environment.capture_far = 1.0
	text = "\n".join(SceneWarnings.of_environment(environment, root))
	assert_str(text).contains("not beyond Near")


func test_what_leaves_no_light_is_told() -> void:
	var environment: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	environment.source = LobeEnvironment3D.Source.PANORAMA
	assert_str(environment._get_configuration_warnings()[0]).contains("Set a panorama")
	environment.panorama = ImageTexture.new()
	assert_str(environment._get_configuration_warnings()[0]).contains("panorama is empty")
	var image := Image.create_empty(1024, 512, false, Image.FORMAT_RGBAH)
	environment.panorama = ImageTexture.create_from_image(image)
	assert_array(environment._get_configuration_warnings()).is_empty()
	environment.energy = 0.0
	environment.size = 32
	assert_str(environment._get_configuration_warnings()[0]).contains("Energy is 0")
	assert_str(environment._get_configuration_warnings()[1]).contains("only 32 texels")


# As the scene tree of the editor has them.
func test_the_scene_tree_warns_and_follows_the_sky() -> void:
	var plugin := Kit.get_plugin(get_tree())
	var refresh: WarningRefresh = Kit.find_all(plugin, WarningRefresh)[0]
	var packed := PackedScene.new()
	var empty: Node3D = auto_free(Node3D.new())
	empty.name = "Scene"
	packed.pack(empty)
	ResourceSaver.save(packed, "res://warned.tscn")
	EditorInterface.open_scene_from_path("res://warned.tscn")
	await await_idle_frame()
	var root := EditorInterface.get_edited_scene_root()
	var environment := LobeEnvironment3D.new()
	root.add_child(environment)
	environment.owner = root
	var told := [0]
	var tell := func(node: Node) -> void: told[0] += int(node == environment)
	get_tree().node_configuration_warning_changed.connect(tell)
	assert_str("\n".join(environment._get_configuration_warnings())).contains("has no sky")
	assert_int(refresh.refresh()).is_equal(1)
	assert_int(refresh.refresh()).is_equal(0)
	_add_sky(root)
	assert_array(environment._get_configuration_warnings()).is_empty()
	assert_int(refresh.refresh()).is_equal(1)
	assert_int(told[0]).is_greater_equal(2)
	told[0] = 0
	environment.energy = 0.0
	assert_int(told[0]).is_equal(1)
	get_tree().node_configuration_warning_changed.disconnect(tell)
	EditorInterface.close_scene()
	await await_idle_frame()
	DirAccess.remove_absolute("res://warned.tscn")


func test_warnings_are_in_the_inspector() -> void:
	Kit.get_plugin(get_tree())
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.new()
	EditorInterface.inspect_object(material)
	await await_idle_frame()
	await await_idle_frame()
	var lists := Kit.find_all(EditorInterface.get_inspector(), WarningList)
	assert_int(lists.size()).is_equal(1)
	var list: WarningList = lists[0]
	assert_str("\n".join(list.get_warnings())).contains("press Bake")
	EditorInterface.inspect_object(null)
	await await_idle_frame()


func test_a_mesh_without_tangents_is_told_so_in_the_theme_s_colour() -> void:
	Kit.get_plugin(get_tree())
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array([Vector3.ZERO, Vector3.RIGHT, Vector3.UP])
	arrays[Mesh.ARRAY_NORMAL] = PackedVector3Array([Vector3.BACK, Vector3.BACK, Vector3.BACK])
	var sphere: MeshInstance3D = _make_scene().get_child(0)
	sphere.mesh = ArrayMesh.new()
	sphere.mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var material: LobeMaterial3D = sphere.material_override
	material.table = null
	material.anisotropy = 0.5
	material.anisotropy_enabled = true
	EditorInterface.inspect_object(sphere)
	await await_idle_frame()
	await await_idle_frame()
	var labels := Kit.find_all(EditorInterface.get_inspector(), WarningLabel)
	assert_int(labels.size()).is_equal(1)
	assert_str(labels[0].text).contains("no tangents on surface 0")
	var color := EditorInterface.get_editor_theme().get_color(&"warning_color", &"Editor")
	assert_that(labels[0].get_theme_color(&"font_color")).is_equal(color)
	EditorInterface.inspect_object(null)


func test_environments_are_found_in_the_tree_and_outside() -> void:
	var root := _make_scene()
	var environment := LobeEnvironment3D.new()
	root.get_child(0).add_child(environment)
	var other: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	for is_in_tree: bool in [false, true]:
		if is_in_tree:
			# Two in one world: the second says that it waits.
			other.visible = false
			add_child(root)
			add_child(other)
		assert_array(SceneUsage.find_environments(root)).contains_exactly([environment])
		assert_array(SceneUsage.find_environments(other)).contains_exactly([other])
		assert_array(SceneUsage.find_environments(environment.get_parent())).is_not_empty()
	remove_child(root)
	remove_child(other)


func test_the_report_names_what_the_scene_uses() -> void:
	var root := _make_scene()
	root.add_child(LobeEnvironment3D.new())
	var probe := LobeProbe3D.new()
	probe.name = "Hall"
	probe.size.y = 0.05
	root.add_child(probe)
	var report := SceneReport.describe(root)
	assert_str(report).contains("Materials: 1")
	assert_str(report).contains("steel: 1 fetch of the environment")
	assert_str(report).contains("on 1 node")
	assert_str(report).contains("Environments: 1")
	assert_str(report).contains("Probes: 1").contains("Hall: captured live")
	assert_str(report).contains("To be looked at:").contains("Hall: The box is only 0.05 m thick")
	probe.light = LobeLight.make_dark(true)
	assert_str(SceneReport.describe(root)).contains("Hall: baked, 1 texels, 64 B")
	var sphere: MeshInstance3D = root.get_child(0)
	sphere.name = "Ball"
	sphere.material_override.resource_name = ""
	assert_str(SceneReport.describe(root)).contains("of Ball: 1 fetch")
	assert_str(SceneReport.describe(null)).is_equal("No scene is open.")


func test_all_tables_of_a_scene_are_baked() -> void:
	var plugin := Kit.get_plugin(get_tree())
	var bakes: BakeQueue = plugin.get_bakes()
	var menu: ToolsMenu = plugin.get_tools_menu()
	var root := _make_scene()
	var usage: SceneUsage = SceneUsage.of(root)
	var table := usage.tables[0]
	# Of an empty table nothing is known.
	assert_int(menu.bake_all(root)).is_equal(0)
	var recipe := Recipe.new()
	recipe.alpha = Vector2(0.3, 0.3)
	recipe.lobes = 2
	table.set_meta(Recipe.META, recipe.to_dictionary())
	assert_int(menu.bake_all(root)).is_equal(1)
	var is_over := func() -> bool: return not bakes.is_baking(table)
	assert_bool(await Kit.wait_until(get_tree(), is_over)).is_true()
	assert_int(table.lobe_count).is_equal(2)


func test_the_menu_is_under_tools_once() -> void:
	Kit.get_plugin(get_tree())
	var menus := Kit.find_all(EditorInterface.get_base_control(), ToolsMenu)
	assert_int(menus.size()).is_equal(1)
	assert_int((menus[0] as PopupMenu).item_count).is_equal(7)


func test_the_resources_are_offered_where_the_guide_says() -> void:
	Kit.get_plugin(get_tree())
	for wanted: Array in [
		["BaseMaterial3D,ShaderMaterial", "LobeMaterial3D"], ["LobeTable", "LobeTable"]
	]:
		# One picker looks only once.
		var picker: EditorResourcePicker = auto_free(EditorResourcePicker.new())
		picker.base_type = wanted[0]
		assert_array(Array(picker.get_allowed_types())).contains(wanted[1])
