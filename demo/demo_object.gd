@tool
extends MeshInstance3D
## One of the demo's objects: a shape, and its material by each method.

enum Shape { SPHERE, TORUS, DISC, KNOT, TEAPOT, PLINTH, VASE }

const Layers := preload("layers.gd")
const LoopSubdivision := preload("meshes/loop_subdivision.gd")
const Methods := preload("methods.gd")
const RivalLight := preload("rivals/rival_light.gd")
const RivalMaterial := preload("rivals/rival_material.gd")
const SurfaceMesh := preload("meshes/surface_mesh.gd")
const Surfaces := preload("meshes/surfaces.gd")
const TEAPOT := preload("meshes/teapot.obj")

## What to build.
@export var shape := Shape.SPHERE:
	set(value):
		shape = value
		mesh = _build()
## Its name for people. Objects without one are not for the sliders.
@export var title := ""

## The material as this project draws it, from which the others are made.
var material: LobeMaterial3D
## What the methods that need a map of their own are lit by.
var rival_light: RivalLight:
	set(value):
		rival_light = value
		update_materials()

var _preset := Vector3.ZERO
var _twin: MeshInstance3D
var _left := Methods.Method.OURS
var _right := Methods.NONE
var _rivals: Dictionary[int, Material] = {}


func _init() -> void:
	mesh = _build()


# What the shape builds is not saved with the scene.
func _validate_property(property: Dictionary) -> void:
	if property["name"] == "mesh":
		property["usage"] &= ~PROPERTY_USAGE_STORAGE


func _ready() -> void:
	material = material_override as LobeMaterial3D
	if Engine.is_editor_hint() or material == null:
		return
	# Scenes share their resources.
	material = material.duplicate()
	material_override = material
	_preset = get_widths()
	layers = Layers.LEFT
	_twin = MeshInstance3D.new()
	_twin.mesh = mesh
	_twin.layers = Layers.RIGHT
	_twin.hide()
	add_child(_twin)


## Chooses how the left and the right half of the picture show the object.
func show_methods(left: int, right: int) -> void:
	_left = left as Methods.Method
	_right = right
	_twin.visible = right != Methods.NONE
	update_materials()


## (roughness, anisotropy, the direction's angle in radians).
func get_widths() -> Vector3:
	return Vector3(material.roughness, material.anisotropy, material.anisotropy_rotation)


func set_widths(widths: Vector3) -> void:
	material.roughness = widths.x
	material.anisotropy = widths.y
	material.anisotropy_enabled = true
	material.anisotropy_rotation = widths.z
	update_materials()


## Widths as the scene has them.
func reset_widths() -> void:
	set_widths(_preset)


## Hands the material's properties to the methods that are shown.
func update_materials() -> void:
	if _twin == null:
		return
	material_override = _material_of(_left)
	_twin.material_override = _material_of(_right) if _right != Methods.NONE else null


func _material_of(method: int) -> Material:
	match method:
		Methods.Method.OURS:
			return material
		Methods.Method.STOCK:
			return _make_stock()
	if rival_light == null:
		# Its map takes some frames, in which the object would be black.
		return material
	if not _rivals.has(method):
		_rivals[method] = RivalMaterial.make(method == Methods.Method.THESIS)
	var rival: RivalMaterial = _rivals[method]
	rival.follow(material, rival_light)
	return rival


func _make_stock() -> BaseMaterial3D:
	var stock := material.to_standard()
	if material.anisotropy_rotation != 0.0 and stock.anisotropy_enabled:
		# A flow map is the only way to turn it.
		var flow := Vector2.from_angle(material.anisotropy_rotation) * 0.5 + 0.5 * Vector2.ONE
		var texel := Image.create_empty(1, 1, false, Image.FORMAT_RGBA8)
		texel.fill(Color(flow.x, flow.y, 0.0, 1.0))
		stock.anisotropy_flowmap = ImageTexture.create_from_image(texel)
	return stock


func _build() -> ArrayMesh:
	if shape == Shape.TEAPOT:
		return _build_teapot()
	# A surface, and its quads along and across.
	var surfaces: Dictionary[Shape, Array] = {
		Shape.SPHERE: [Surfaces.sphere.bind(0.5), 96, 48],
		Shape.TORUS: [Surfaces.torus.bind(0.42, 0.17), 128, 64],
		Shape.DISC: [Surfaces.plate.bind(0.8, 0.06, 0.06), 160, 80],
		Shape.KNOT: [Surfaces.knot.bind(0.2, 0.105), 384, 40],
		Shape.PLINTH: [Surfaces.plate.bind(2.5, 0.2, 0.0), 160, 60],
		Shape.VASE: [Surfaces.vase.bind(0.4, 1.05), 128, 64],
	}
	var surface: Callable = surfaces[shape][0]
	var columns: int = surfaces[shape][1]
	var rows: int = surfaces[shape][2]
	return SurfaceMesh.build(surface, columns, rows)


static func _build_teapot() -> ArrayMesh:
	var arrays := TEAPOT.surface_get_arrays(0)
	var subdivision := LoopSubdivision.new(arrays[Mesh.ARRAY_VERTEX], arrays[Mesh.ARRAY_INDEX])
	subdivision.refine()
	subdivision.refine()
	return subdivision.to_mesh()
