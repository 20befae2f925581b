extends Node3D
## Cloth with a sheen: fibres that stand up from it and shine where it is seen from the side.
##
## The same red velvet twice, with the sheen's lobes and without.

const COLUMNS := 96
const ROWS := 64
const SIZE := Vector2(1.0, 1.4)

@export var velvet: LobeMaterial3D

@onready var _with: MeshInstance3D = $WithSheen
@onready var _without: MeshInstance3D = $WithoutSheen


func _ready() -> void:
	var mesh := _make_folds()
	var plain: LobeMaterial3D = velvet.duplicate()
	plain.sheen_enabled = false
	_with.mesh = mesh
	_with.material_override = velvet
	_without.mesh = mesh
	_without.material_override = plain


# A curtain whose folds grow deeper towards its lower end.
func _make_folds() -> ArrayMesh:
	var builder := SurfaceTool.new()
	builder.begin(Mesh.PRIMITIVE_TRIANGLES)
	for row in ROWS + 1:
		for column in COLUMNS + 1:
			var place := Vector2(float(column) / COLUMNS, float(row) / ROWS)
			var depth := (0.03 + 0.06 * place.y) * sin(TAU * (3.5 * place.x + 0.2 * place.y))
			builder.set_uv(place)
			builder.add_vertex(Vector3((place.x - 0.5) * SIZE.x, (0.5 - place.y) * SIZE.y, depth))
	for row in ROWS:
		for column in COLUMNS:
			var corner := row * (COLUMNS + 1) + column
			var below := corner + COLUMNS + 1
			for index: int in [corner, corner + 1, below, corner + 1, below + 1, below]:
				builder.add_index(index)
	builder.generate_normals()
	builder.generate_tangents()
	return builder.commit()
