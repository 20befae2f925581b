@tool
extends Object
## What shows a [LobeMaterial3D] in a scene: a sky, a sun, a [LobeEnvironment3D], and a sphere.

const MaterialPresets := preload("../presets/material_presets.gd")
const View3D := preload("view_3d.gd")

## The sphere's look.
const LOOK := "Brushed Metal"
const WORLD := "WorldEnvironment"
const SUN := "DirectionalLight3D"
const ENVIRONMENT := "LobeEnvironment3D"

# Of a new SphereMesh. Spheres stand on the grid, this far from each other.
const _RADIUS := 0.5
const _STEP := Vector3(1.25, 0.0, 0.0)
const _SUN_HEIGHT := 3.0


## What a scene lacks to have light, by the names of nodes in their order; [param root] may be
## [code]null[/code]. No sun comes where there are lamps, or a sky that does not draw suns.
static func find_missing_light(root: Node) -> PackedStringArray:
	var missing: PackedStringArray = []
	var worlds := _find_all(root, WORLD)
	if worlds.is_empty():
		missing.append(WORLD)
	if worlds.all(_draws_suns) and _find_all(root, "Light3D").is_empty():
		missing.append(SUN)
	if _find_all(root, ENVIRONMENT).is_empty():
		missing.append(ENVIRONMENT)
	return missing


## One of these nodes.
static func make_light(name: String) -> Node:
	var node: Node
	match name:
		WORLD:
			node = _make_world()
		SUN:
			node = _make_sun()
		ENVIRONMENT:
			node = LobeEnvironment3D.new()
	node.name = name
	return node


## A sphere of brushed metal where no other mesh stands.
static func make_sphere(root: Node) -> MeshInstance3D:
	var sphere := MeshInstance3D.new()
	sphere.name = "BrushedSphere"
	sphere.mesh = SphereMesh.new()
	sphere.position = _find_place(root)
	var material := LobeMaterial3D.new()
	var look := MaterialPresets.find(LOOK)
	for property in look:
		material.set(property, look[property])
	sphere.material_override = material
	return sphere


# A scene's nodes of a class, those of instanced scenes too.
static func _find_all(root: Node, type: String) -> Array[Node]:
	var nodes: Array[Node] = []
	if root == null:
		return nodes
	nodes = root.find_children("*", type, true, false)
	if root.is_class(type) or type == ENVIRONMENT and root is LobeEnvironment3D:
		nodes.append(root)
	return nodes


# The editor's own, so that the scene looks as it did.
static func _make_world() -> WorldEnvironment:
	var world := WorldEnvironment.new()
	var preview := View3D.find_preview_environment()
	if preview != null:
		world.environment = preview.environment.duplicate(true)
		if preview.camera_attributes != null:
			world.camera_attributes = preview.camera_attributes.duplicate(true)
		return world
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_SKY
	world.environment.tonemap_mode = Environment.TONE_MAPPER_FILMIC
	world.environment.sky = Sky.new()
	world.environment.sky.sky_material = ProceduralSkyMaterial.new()
	return world


static func _make_sun() -> DirectionalLight3D:
	var preview := View3D.find_preview_sun()
	var sun: DirectionalLight3D
	if preview != null:
		sun = preview.duplicate()
	else:
		sun = DirectionalLight3D.new()
		sun.rotation_degrees = Vector3(-60, 150, 0)
		sun.shadow_enabled = true
	# Where its icon hides no sphere.
	sun.position.y = _SUN_HEIGHT
	return sun


static func _draws_suns(world: WorldEnvironment) -> bool:
	if world.environment == null or world.environment.sky == null:
		return false
	var material := world.environment.sky.sky_material
	return material is ProceduralSkyMaterial or material is PhysicalSkyMaterial


static func _find_place(root: Node) -> Vector3:
	var places: Array[Vector3] = []
	var frame := (root as Node3D).global_transform if root is Node3D else Transform3D.IDENTITY
	for mesh: MeshInstance3D in _find_all(root, "MeshInstance3D"):
		places.append(frame.affine_inverse() * mesh.global_position)
	var place := Vector3(0.0, _RADIUS, 0.0)
	while places.any(func(other: Vector3) -> bool: return other.distance_to(place) < 2.0 * _RADIUS):
		place += _STEP
	return place
