extends GdUnitTestSuite
## What a conversion of a scene finds and plans, without an editor.

const Converter := preload("res://addons/lobelight/editor/conversion/material_converter.gd")
const Plan := preload("res://addons/lobelight/editor/conversion/conversion_plan.gd")

const FOLDER := "user://conversion_plan"


func before() -> void:
	DirAccess.make_dir_recursive_absolute(FOLDER)


func after() -> void:
	for file in DirAccess.get_files_at(FOLDER):
		DirAccess.remove_absolute(FOLDER.path_join(file))
	DirAccess.remove_absolute(FOLDER)


func _material(name: String) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.resource_name = name
	return material


# A mesh of one triangle a material.
func _mesh(materials: Array) -> ArrayMesh:
	var mesh := ArrayMesh.new()
	for surface in materials.size():
		var arrays := []
		arrays.resize(Mesh.ARRAY_MAX)
		arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array([Vector3.ZERO, Vector3.UP, Vector3.RIGHT])
		mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
		mesh.surface_set_material(surface, materials[surface])
	return mesh


func _root() -> Node3D:
	var root: Node3D = auto_free(Node3D.new())
	root.name = "Root"
	return root


func _add(root: Node, node: Node, name: String) -> void:
	node.name = name
	root.add_child(node)
	node.owner = root


func _properties(plan: Plan) -> PackedStringArray:
	var found: PackedStringArray = []
	for change in plan.changes:
		found.append("%s.%s" % [change.node.name, change.property])
	return found


func test_what_nodes_draw_is_found_and_stays_shared() -> void:
	var shared := _material("shared")
	var root := _root()
	for i in 3:
		var instance := MeshInstance3D.new()
		instance.mesh = BoxMesh.new()
		_add(root, instance, "Box%d" % i)
	(root.get_child(0).mesh as BoxMesh).material = shared
	root.get_child(1).material_override = shared
	root.get_child(1).material_overlay = _material("overlay")
	(root.get_child(2).mesh as BoxMesh).material = LobeMaterial3D.new()
	# Once, though it is below the root too.
	var plan: Plan = Plan.make([root, root.get_child(0)], root)
	assert_array(Array(_properties(plan))).contains_exactly(
		["Box0.surface_material_override/0", "Box1.material_override", "Box1.material_overlay"]
	)
	assert_object(plan.changes[0].after).is_same(plan.changes[1].after)
	assert_object(plan.changes[0].before).is_null()
	assert_object(plan.changes[1].before).is_same(shared)
	assert_array(plan.instances).is_empty()
	# Nothing has been changed by looking.
	assert_object(root.get_child(1).material_override).is_same(shared)


func test_next_passes_are_converted_behind_any_material() -> void:
	var shader := ShaderMaterial.new()
	var last := _material("last")
	shader.next_pass = last
	var first := _material("first")
	first.next_pass = shader
	var converter: Converter = Converter.new()
	var made := converter.convert_material(first)
	assert_bool(made is LobeMaterial3D).is_true()
	assert_bool(made.next_pass is LobeMaterial3D).is_false()
	assert_bool(made.next_pass is ShaderMaterial).is_true()
	assert_bool(made.next_pass.next_pass is LobeMaterial3D).is_true()
	assert_object(shader.next_pass).is_same(last)
	assert_object(converter.convert_material(last)).is_same(made.next_pass.next_pass)
	assert_int(converter.get_made().size()).is_equal(2)


func test_what_is_not_lit_or_not_known_stays_and_is_named() -> void:
	var root := _root()
	var unshaded := _material("flat")
	unshaded.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	var overlays: Dictionary[String, Material] = {"Flat": unshaded, "Own": ShaderMaterial.new()}
	for name in overlays:
		var instance := MeshInstance3D.new()
		instance.material_overlay = overlays[name]
		_add(root, instance, name)
	_add(root, Sprite3D.new(), "Sprite")
	_add(root, Label3D.new(), "Label")
	var added := MeshInstance3D.new()
	added.name = "Added"
	added.material_override = _material("added")
	root.add_child(added)
	var plan: Plan = Plan.make([root], root)
	assert_bool(plan.is_empty()).is_true()
	assert_int(plan.left.size()).is_equal(5)
	for expected: Array in [
		["Flat", '"flat": it is unshaded: no light changes it'],
		["Own", "a material without a name: it is a ShaderMaterial, whose shader is its own"],
		["Sprite", "Sprite3Ds are drawn with a material of the engine's own"],
		["Label", "Label3Ds are drawn with a material of the engine's own"],
		["Added", "a script has added it: it is in no file"],
	]:
		assert_array(plan.left.get(expected[1], [])).contains_exactly([expected[0]])


func test_meshes_of_one_material_are_overridden_and_others_copied() -> void:
	var root := _root()
	var one := _material("one")
	for materials: Array in [[one, one], [one, _material("two")], [one, null]]:
		var many := MultiMeshInstance3D.new()
		many.multimesh = MultiMesh.new()
		many.multimesh.mesh = _mesh(materials)
		_add(root, many, "Many%d" % root.get_child_count())
		var particles := CPUParticles3D.new()
		particles.mesh = many.multimesh.mesh
		_add(root, particles, "Cpu%d" % root.get_child_count())
	var passes := GPUParticles3D.new()
	passes.draw_passes = 2
	passes.draw_pass_1 = _mesh([one])
	passes.draw_pass_2 = _mesh([one])
	_add(root, passes, "Passes")
	var plan: Plan = Plan.make([root], root)
	(
		assert_array(Array(_properties(plan)))
		. contains_exactly(
			[
				"Many0.material_override",
				"Cpu1.material_override",
				"Many2.multimesh",
				"Cpu3.mesh",
				"Many4.multimesh",
				"Cpu5.mesh",
				"Passes.draw_pass_1",
				"Passes.draw_pass_2",
			]
		)
	)
	var mesh: Mesh = (plan.changes[2].after as MultiMesh).mesh
	# What was shared still is, and what was there is as it was.
	assert_object(mesh).is_same(plan.changes[3].after)
	assert_object(mesh.surface_get_material(0)).is_same(plan.changes[0].after)
	var before: Mesh = (root.get_node("Many2") as MultiMeshInstance3D).multimesh.mesh
	assert_object(before.surface_get_material(0)).is_same(one)
	assert_object((plan.changes[5].after as Mesh).surface_get_material(1)).is_null()


func test_meshes_that_cannot_be_copied_are_named() -> void:
	var root := _root()
	var mesh := ImmediateMesh.new()
	for surface in 2:
		mesh.surface_begin(Mesh.PRIMITIVE_TRIANGLES, _material("m%d" % surface))
		for vertex in 3:
			mesh.surface_add_vertex(Vector3(vertex, vertex * vertex, 0.0))
		mesh.surface_end()
	var particles := CPUParticles3D.new()
	particles.mesh = mesh
	_add(root, particles, "Particles")
	var plan: Plan = Plan.make([root], root)
	assert_bool(plan.is_empty()).is_true()
	assert_array(plan.left.keys()).contains_exactly(
		["a mesh of the class ImmediateMesh cannot be copied"]
	)


func test_libraries_are_copied_with_all_else_that_they_hold() -> void:
	var root := _root()
	var library := MeshLibrary.new()
	for item in 2:
		library.create_item(item)
		library.set_item_name(item, "item%d" % item)
	library.set_item_mesh(0, _mesh([_material("stone")]))
	library.set_item_mesh(1, _mesh([null]))
	library.set_item_shapes(0, [BoxShape3D.new(), Transform3D.IDENTITY])
	var grid := GridMap.new()
	grid.mesh_library = library
	_add(root, grid, "Grid")
	var plan: Plan = Plan.make([root], root)
	var copy: MeshLibrary = plan.changes[0].after
	assert_bool(copy.get_item_mesh(0).surface_get_material(0) is LobeMaterial3D).is_true()
	assert_object(copy.get_item_mesh(1)).is_same(library.get_item_mesh(1))
	assert_str(copy.get_item_name(1)).is_equal("item1")
	assert_array(copy.get_item_shapes(0)).is_equal(library.get_item_shapes(0))
	assert_bool(library.get_item_mesh(0).surface_get_material(0) is StandardMaterial3D).is_true()


func test_csg_has_materials_of_its_own_or_its_mesh_s() -> void:
	var root := _root()
	var box := CSGBox3D.new()
	box.material = _material("box")
	_add(root, CSGCombiner3D.new(), "Combiner")
	_add(root, box, "Box")
	for materials: Array in [[_material("one")], [_material("two"), _material("three")]]:
		var shape := CSGMesh3D.new()
		shape.mesh = _mesh(materials)
		_add(root, shape, "Shape%d" % materials.size())
	var plan: Plan = Plan.make([root], root)
	assert_array(Array(_properties(plan))).contains_exactly(
		["Box.material", "Shape1.material", "Shape2.mesh"]
	)


func test_the_way_back() -> void:
	var root := _root()
	var instance := MeshInstance3D.new()
	var material := LobeMaterial3D.new()
	material.anisotropy_enabled = true
	material.anisotropy = 1.05
	material.light = LobeLight.make_dark(false)
	material.next_pass = LobeMaterial3D.new()
	instance.material_override = material
	_add(root, instance, "Ball")
	_add(root, Sprite3D.new(), "Sprite")
	var plan: Plan = Plan.make([root], root, false)
	var made: Material = plan.changes[0].after
	assert_bool(made is StandardMaterial3D).is_true()
	assert_bool(made.next_pass is StandardMaterial3D).is_true()
	assert_array(Array(plan.converter.get_losses(material))).contains_exactly_in_any_order(
		["anisotropy", "light"]
	)
	assert_array(Array(plan.converter.get_losses(LobeMaterial3D.new()))).is_empty()
	assert_bool(plan.left.is_empty()).is_true()


func test_names_and_metadata_go_along() -> void:
	var material := StandardMaterial3D.new()
	material.set_meta("origin", 7)
	material.resource_local_to_scene = true
	var path := FOLDER.path_join("steel.tres")
	ResourceSaver.save(material, path)
	var made := Converter.new().convert_material(load(path))
	assert_str(made.resource_name).is_equal("steel")
	assert_int(made.get_meta("origin")).is_equal(7)
	assert_bool(made.resource_local_to_scene).is_true()


func _save(root: Node, file: String) -> String:
	var packed := PackedScene.new()
	packed.pack(root)
	var path := FOLDER.path_join(file)
	ResourceSaver.save(packed, path)
	root.free()
	return path


# A scene with two instances of another, one of them changed.
func test_files_are_chosen_where_the_scene_has_changed_nothing() -> void:
	var inner := Node3D.new()
	inner.name = "Inner"
	var ball := MeshInstance3D.new()
	ball.material_override = _material("ball")
	_add(inner, ball, "Ball")
	var path := _save(inner, "inner.tscn")
	var root := _root()
	var scene: PackedScene = load(path)
	for name: String in ["Plain", "Changed"]:
		_add(root, scene.instantiate(), name)
	(root.get_node("Changed/Ball") as MeshInstance3D).material_override = _material("mine")
	var plan: Plan = Plan.make([root], root, true, true)
	assert_array(Array(plan.files)).contains_exactly([path])
	assert_int(plan.changes.size()).is_equal(1)
	assert_object(plan.changes[0].node).is_same(root.get_node("Changed/Ball"))
	assert_array(plan.instances).contains_exactly([root.get_node("Changed")])
	assert_int(plan.nodes_in_files).is_equal(1)
	# Files that are locked, and without the choice all.
	var locked: Dictionary[String, String] = {path: "it is open"}
	plan = Plan.make([root], root, true, true, locked)
	assert_array(Array(plan.files)).is_empty()
	assert_array(plan.left["%s: it is open" % path]).contains_exactly(["Plain"])
	plan = Plan.make([root], root)
	assert_int(plan.changes.size()).is_equal(2)
	assert_array(plan.instances).contains_exactly(
		[root.get_node("Plain"), root.get_node("Changed")]
	)


func test_imported_scenes_are_no_files_to_change() -> void:
	var plan: Plan = Plan.make([], _root())
	assert_str(plan.find_lock("res://thing.glb")).contains("imported")
	assert_str(plan.find_lock("res://thing.tscn")).is_empty()
