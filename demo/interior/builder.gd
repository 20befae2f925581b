extends RefCounted
## Builds meshes of rectangles, one mesh a material, with the light that falls on their vertices.

const StillLight := preload("still_light.gd")
# Metres between vertices, at most.
const _STEP := 0.17
# Of two triangles, clockwise as the engine's front faces are.
const _CORNERS: PackedInt32Array = [0, 2, 1, 1, 2, 3]


class Part:
	extends RefCounted
	var points: PackedVector3Array = []
	var normals: PackedVector3Array = []
	var coordinates: PackedVector2Array = []
	var light: PackedFloat32Array = []
	var triangles: PackedInt32Array = []


var _light: StillLight
var _parts: Dictionary[Material, Part] = {}


func _init(light: StillLight) -> void:
	_light = light


## A rectangle from a corner along u and v; it faces u × v.
func add_rectangle(material: Material, corner: Vector3, u: Vector3, v: Vector3) -> void:
	var part: Part = _parts.get_or_add(material, Part.new())
	var normal := u.cross(v).normalized()
	var columns := maxi(ceili(u.length() / _STEP), 1)
	var rows := maxi(ceili(v.length() / _STEP), 1)
	var first := part.points.size()
	# Patterns go on from one rectangle to the next.
	var start := Vector2(corner.dot(u.normalized()), corner.dot(v.normalized()))
	for row in rows + 1:
		for column in columns + 1:
			var at := Vector2(float(column) / columns, float(row) / rows)
			var place := corner + at.x * u + at.y * v
			part.points.append(place)
			part.normals.append(normal)
			part.coordinates.append(start + at * Vector2(u.length(), v.length()))
			var light := _light.on(place, normal)
			part.light.append_array([light.x, light.y, light.z])
	for row in rows:
		for column in columns:
			var a := first + row * (columns + 1) + column
			var corners: PackedInt32Array = [a, a + 1, a + columns + 1, a + columns + 2]
			for index in _CORNERS:
				part.triangles.append(corners[index])


## All sides of a box but those that [param without] names: of "x", "X", "y", "Y", "z" and "Z", the
## small ones being the lower sides.
func add_box(material: Material, box: AABB, without := "") -> void:
	var x := box.size.x * Vector3.RIGHT
	var y := box.size.y * Vector3.UP
	var z := box.size.z * Vector3.BACK
	var low := box.position
	if "x" not in without:
		add_rectangle(material, low, z, y)
	if "X" not in without:
		add_rectangle(material, low + x + z, -z, y)
	if "y" not in without:
		add_rectangle(material, low, x, z)
	if "Y" not in without:
		add_rectangle(material, low + y + z, x, -z)
	if "z" not in without:
		add_rectangle(material, low + x, -x, y)
	if "Z" not in without:
		add_rectangle(material, low + z, x, y)


## The meshes, as children for [param parent].
func build(parent: Node3D, layers: int) -> void:
	for material in _parts:
		var part := _parts[material]
		var arrays := []
		arrays.resize(Mesh.ARRAY_MAX)
		arrays[Mesh.ARRAY_VERTEX] = part.points
		arrays[Mesh.ARRAY_NORMAL] = part.normals
		arrays[Mesh.ARRAY_TEX_UV] = part.coordinates
		arrays[Mesh.ARRAY_CUSTOM0] = part.light
		arrays[Mesh.ARRAY_INDEX] = part.triangles
		var mesh := ArrayMesh.new()
		mesh.add_surface_from_arrays(
			Mesh.PRIMITIVE_TRIANGLES,
			arrays,
			[],
			{},
			Mesh.ARRAY_CUSTOM_RGB_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT
		)
		var instance := MeshInstance3D.new()
		instance.mesh = mesh
		instance.material_override = material
		instance.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
		instance.layers = layers
		parent.add_child(instance)
