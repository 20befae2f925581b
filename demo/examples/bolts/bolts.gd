extends Node3D
## 1000 brushed bolts: one mesh, one [LobeMaterial3D] and one [MultiMesh], so one draw call.
##
## Instances need nothing of their own. Highlights lie right on each, as the material takes normals
## and tangents as the instance's transform turns them.

const COUNT := 1000
const COLUMNS := 40
const SPACING := 0.16
# A bolt's outline from the middle of the head to the tip: distance from the axis, height.
const OUTLINE: PackedVector2Array = [
	Vector2(0.0, 0.1),
	Vector2(0.055, 0.095),
	Vector2(0.065, 0.08),
	Vector2(0.065, 0.05),
	Vector2(0.03, 0.05),
	Vector2(0.03, -0.1),
]
const SIDES := 20

@export var material: LobeMaterial3D

@onready var _bolts: MultiMeshInstance3D = $Bolts


func _ready() -> void:
	var bolts := MultiMesh.new()
	bolts.transform_format = MultiMesh.TRANSFORM_3D
	bolts.use_colors = true
	bolts.mesh = _make_bolt()
	bolts.instance_count = COUNT
	var random := RandomNumberGenerator.new()
	random.seed = 1
	for i in COUNT:
		@warning_ignore("integer_division")
		var place := Vector3(i % COLUMNS - 0.5 * COLUMNS, 0.0, -(i / COLUMNS)) * SPACING
		var lean := Vector3(random.randf_range(-0.5, 0.5), TAU * random.randf(), 0.0)
		bolts.set_instance_transform(i, Transform3D(Basis.from_euler(lean), place))
		# Steel and brass: the material takes the instance's colour (vertex_color_use_as_albedo).
		var is_brass := random.randf() < 0.2
		bolts.set_instance_color(
			i, Color(0.91, 0.74, 0.42) if is_brass else Color(0.77, 0.78, 0.78)
		)
	_bolts.multimesh = bolts


# The outline turned about the axis, as a lathe does it, which brushes the metal around the axis:
# that is the tangent. Highlights are wide across it, so the material turns its anisotropy by 90°.
func _make_bolt() -> ArrayMesh:
	var builder := SurfaceTool.new()
	builder.begin(Mesh.PRIMITIVE_TRIANGLES)
	for ring in OUTLINE.size() - 1:
		var from := OUTLINE[ring]
		var to := OUTLINE[ring + 1]
		# Across the outline, outwards.
		var across := Vector2(from.y - to.y, to.x - from.x).normalized()
		for side in SIDES:
			for corner: Vector2i in [
				Vector2i(0, 0),
				Vector2i(1, 0),
				Vector2i(1, 1),
				Vector2i(0, 0),
				Vector2i(1, 1),
				Vector2i(0, 1)
			]:
				var around := Vector3.RIGHT.rotated(Vector3.UP, TAU * (side + corner.x) / SIDES)
				var point := from if corner.y == 0 else to
				builder.set_normal(around * across.x + Vector3.UP * across.y)
				builder.set_tangent(_plane(Vector3.UP.cross(around)))
				builder.set_uv(Vector2(float(side + corner.x) / SIDES, float(ring + corner.y)))
				builder.add_vertex(around * point.x + Vector3.UP * point.y)
	var mesh := builder.commit()
	mesh.surface_set_material(0, material)
	return mesh


# A tangent as meshes hold it: with the hand of the frame.
func _plane(tangent: Vector3) -> Plane:
	return Plane(tangent.x, tangent.y, tangent.z, 1.0)
