@tool
extends Object
## Scenes for tests of conversions: three levels of instances, with geometry of each kind. Every
## material has a name and a colour of its own, by which it is known again.

const FOLDER := "res://conversion"
const THING := FOLDER + "/thing.gltf"
const HALL := FOLDER + "/hall.tscn"
const SHELVES := 3
const PROPS := 3

static var _count := 0


## Writes the file that is to be imported.
static func write_source(shift := 0.0) -> void:
	DirAccess.make_dir_recursive_absolute(FOLDER)
	var corners := PackedVector3Array([Vector3(shift, 0, 0), Vector3.RIGHT, Vector3.UP])
	var bytes := corners.to_byte_array()
	var surfaces: Array[Dictionary] = []
	var materials: Array[Dictionary] = []
	for index in 2:
		surfaces.append({"attributes": {"POSITION": 0}, "material": index})
		var factor := [0.25 * index + 0.25, 0.5, 0.125, 1.0]
		materials.append(
			{"name": "thing%d" % index, "pbrMetallicRoughness": {"baseColorFactor": factor}}
		)
	var text := JSON.stringify(
		{
			"asset": {"version": "2.0"},
			"scene": 0,
			"scenes": [{"nodes": [0]}],
			"nodes":
			[
				{"name": "Thing", "children": [1, 2]},
				{"name": "A", "mesh": 0},
				{"name": "B", "mesh": 0}
			],
			"meshes": [{"name": "triangle", "primitives": surfaces}],
			"materials": materials,
			"accessors":
			[
				{
					"bufferView": 0,
					"componentType": 5126,
					"count": 3,
					"type": "VEC3",
					"min": [minf(shift, 0.0), 0, 0],
					"max": [maxf(shift, 1.0), 1, 0]
				}
			],
			"bufferViews": [{"buffer": 0, "byteLength": bytes.size()}],
			"buffers":
			[
				{
					"byteLength": bytes.size(),
					"uri": "data:application/octet-stream;base64," + Marshalls.raw_to_base64(bytes)
				}
			]
		}
	)
	FileAccess.open(THING, FileAccess.WRITE).store_string(text)


## Writes all scenes anew, once the source has been imported; the path of the outermost one.
static func write() -> String:
	var ball := _mesh_instance("Ball", [_material()])
	var ball_path := _save(ball, "ball")
	var prop := Node3D.new()
	prop.name = "Prop"
	add_each_kind(prop)
	var prop_path := _save(prop, "prop")
	var shelf := Node3D.new()
	shelf.name = "Shelf"
	for index in PROPS:
		_instance(shelf, prop_path, "Prop%d" % index)
	_instance(shelf, ball_path, "Ball")
	_instance(shelf, THING, "Thing")
	var shelf_path := _save(shelf, "shelf")
	var hall := Node3D.new()
	hall.name = "Hall"
	for index in SHELVES:
		_instance(hall, shelf_path, "Shelf%d" % index)
	_instance(hall, THING, "Thing")
	add_each_kind(hall)
	# What the scene has changed of an instance is the scene's own.
	hall.set_editable_instance(hall.get_node("Shelf0"), true)
	(hall.get_node("Shelf0/Ball") as MeshInstance3D).material_override = _material()
	return _save(hall, "hall")


## Adds an instance of a scene whose root is a mesh.
static func add_ball(root: Node) -> void:
	_instance(root, FOLDER.path_join("ball.tscn"), "Other")


## Adds geometry of each kind.
static func add_each_kind(root: Node) -> void:
	var one := _material()
	_add(root, _mesh_instance("Inside", [_material(), _material()]))
	var surface := _mesh_instance("Surface", [_material()])
	surface.set_surface_override_material(0, _material())
	_add(root, surface)
	var override := _mesh_instance("Override", [null])
	override.material_override = one
	override.material_overlay = _material()
	_add(root, override)
	var passes := _mesh_instance("Passes", [_material()])
	passes.mesh.surface_get_material(0).next_pass = _material()
	_add(root, passes)
	for materials: Array in [[one], [_material(), _material()]]:
		_add_many(root, make_mesh(materials), materials.size())
	var box := CSGBox3D.new()
	box.name = "Box"
	box.material = _material()
	var combiner := CSGCombiner3D.new()
	combiner.name = "Combiner"
	combiner.material_override = _material()
	_add(root, combiner)
	combiner.add_child(box)
	box.owner = root
	_add(root, _grid())
	var sprite := Sprite3D.new()
	sprite.name = "Sprite"
	_add(root, sprite)
	var shader := _mesh_instance("Shader", [null])
	shader.material_override = ShaderMaterial.new()
	_add(root, shader)


static func _add_many(root: Node, mesh: Mesh, number: int) -> void:
	var many := MultiMeshInstance3D.new()
	many.name = "Many%d" % number
	many.multimesh = MultiMesh.new()
	many.multimesh.transform_format = MultiMesh.TRANSFORM_3D
	many.multimesh.instance_count = 2
	many.multimesh.mesh = mesh
	_add(root, many)
	var fast := GPUParticles3D.new()
	fast.name = "Gpu%d" % number
	fast.draw_passes = number
	for index in number:
		fast.set_draw_pass_mesh(index, make_mesh([mesh.surface_get_material(index)]))
	_add(root, fast)
	var slow := CPUParticles3D.new()
	slow.name = "Cpu%d" % number
	slow.mesh = mesh
	_add(root, slow)
	var shape := CSGMesh3D.new()
	shape.name = "Shape%d" % number
	shape.mesh = mesh
	_add(root, shape)


static func _grid() -> GridMap:
	var grid := GridMap.new()
	grid.name = "Grid"
	grid.mesh_library = MeshLibrary.new()
	for item in 2:
		grid.mesh_library.create_item(item)
		grid.mesh_library.set_item_mesh(item, make_mesh([_material()]))
		grid.set_cell_item(Vector3i(item, 0, 0), item)
	return grid


## A mesh with a closed surface for each material.
static func make_mesh(materials: Array) -> ArrayMesh:
	var mesh := ArrayMesh.new()
	for surface in materials.size():
		var arrays := BoxMesh.new().get_mesh_arrays()
		mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
		mesh.surface_set_material(surface, materials[surface])
	return mesh


static func _mesh_instance(name: String, materials: Array) -> MeshInstance3D:
	var instance := MeshInstance3D.new()
	instance.name = name
	instance.mesh = make_mesh(materials)
	return instance


static func _material() -> StandardMaterial3D:
	_count += 1
	var material := StandardMaterial3D.new()
	material.resource_name = "material %d" % _count
	material.albedo_color = Color8(_count % 256, floori(_count / 256.0), 7)
	return material


static func _add(root: Node, node: Node) -> void:
	root.add_child(node)
	node.owner = root


static func _instance(root: Node, path: String, name: String) -> void:
	var scene: PackedScene = load(path)
	var instance := scene.instantiate(PackedScene.GEN_EDIT_STATE_INSTANCE)
	instance.name = name
	_add(root, instance)


static func _save(root: Node, name: String) -> String:
	var path := FOLDER.path_join(name + ".tscn")
	var packed := PackedScene.new()
	packed.pack(root)
	root.free()
	ResourceSaver.save(packed, path)
	# Instances are made of what the cache has.
	packed.take_over_path(path)
	return path


## What each node below one is drawn with: [code][class, name, colour][/code] by path and place.
static func list_drawn(root: Node) -> Dictionary[String, Array]:
	var drawn: Dictionary[String, Array] = {}
	for node in root.find_children("*", "Node3D", true, false):
		var materials := _get_drawn(node)
		for place: String in materials:
			var material: Material = materials[place]
			var passes := 0
			while material != null:
				var key := "%s %s %d" % [root.get_path_to(node), place, passes]
				drawn[key] = [
					_class_of(material), material.resource_name, material.get("albedo_color")
				]
				material = material.next_pass
				passes += 1
	return drawn


## The materials that nodes below one are drawn with.
static func list_materials(root: Node) -> Array[Material]:
	var found: Array[Material] = []
	for node in root.find_children("*", "Node3D", true, false):
		for material: Material in _get_drawn(node).values():
			if material != null:
				found.append(material)
	return found


static func _class_of(material: Material) -> String:
	return "LobeMaterial3D" if material is LobeMaterial3D else material.get_class()


static func _get_drawn(node: Node) -> Dictionary:
	var found := {}
	var grid := node as GridMap
	if grid != null:
		for item in grid.mesh_library.get_item_list():
			_list(grid.mesh_library.get_item_mesh(item), "item%d " % item, found)
	var geometry := node as GeometryInstance3D
	if geometry == null:
		return found
	found["overlay"] = geometry.material_overlay
	var inside := {}
	if node is MeshInstance3D:
		for surface in (node as MeshInstance3D).get_surface_override_material_count():
			inside[str(surface)] = (node as MeshInstance3D).get_active_material(surface)
	elif node is MultiMeshInstance3D:
		_list((node as MultiMeshInstance3D).multimesh.mesh, "", inside)
	elif node is CPUParticles3D:
		_list((node as CPUParticles3D).mesh, "", inside)
	elif node is GPUParticles3D:
		for index in (node as GPUParticles3D).draw_passes:
			_list((node as GPUParticles3D).get_draw_pass_mesh(index), "pass%d " % index, inside)
	elif node is CSGShape3D:
		if "mesh" in node:
			_list(node.get("mesh"), "", inside)
		if node.get("material") != null:
			_cover(inside, node.get("material"))
	if geometry.material_override != null:
		_cover(inside, geometry.material_override)
	found.merge(inside)
	return found


static func _list(mesh: Mesh, prefix: String, found: Dictionary) -> void:
	for surface in mesh.get_surface_count():
		found[prefix + str(surface)] = mesh.surface_get_material(surface)


# All that it covers is drawn with it.
static func _cover(inside: Dictionary, material: Material) -> void:
	if inside.is_empty():
		inside["all"] = material
	for place: String in inside:
		inside[place] = material
