@tool
extends MeshInstance3D
## The streamlined body that paints are shown on: a sphere, drawn out to a tail, flat below.

## Half its length, height and width, in metres.
@export var extents := Vector3(1.0, 0.38, 0.5)
## How much narrower it is at the tail than at the nose.
@export_range(0.0, 0.9) var taper := 0.45


func _ready() -> void:
	var sphere := SphereMesh.new()
	sphere.radial_segments = 64
	sphere.rings = 32
	sphere.radius = 1.0
	sphere.height = 2.0
	var arrays := sphere.get_mesh_arrays()
	var places: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	for i in places.size():
		places[i] = _shape(places[i])
	arrays[Mesh.ARRAY_VERTEX] = places
	arrays[Mesh.ARRAY_NORMAL] = null
	arrays[Mesh.ARRAY_TANGENT] = null
	var surface := SurfaceTool.new()
	surface.create_from_arrays(arrays)
	surface.generate_normals()
	mesh = surface.commit()


func _shape(unit: Vector3) -> Vector3:
	# From the nose at 0 to the tail at 1.
	var along := 0.5 - 0.5 * unit.x
	var narrow := 1.0 - taper * along * along
	var height := unit.y if unit.y > 0.0 else 0.45 * unit.y
	# A cabin: the middle bulges.
	var cabin := 1.0 + 0.35 * exp(-8.0 * pow(along - 0.52, 2.0)) * maxf(unit.y, 0.0)
	return extents * Vector3(unit.x, height * narrow * cabin, unit.z * narrow)
