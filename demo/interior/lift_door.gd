extends Object
## The lift's door: two leaves with bevelled edges, which face +z and are brushed upwards.

const _LEAF := Vector2(0.612, 2.04)
const _GAP := 0.008
const _BEVEL := 0.014
const _DEPTH := 0.05


## The mesh, standing on the origin.
static func build() -> ArrayMesh:
	var points := PackedVector3Array()
	var normals := PackedVector3Array()
	var tangents := PackedFloat32Array()
	var coordinates := PackedVector2Array()
	var triangles := PackedInt32Array()
	for side: float in [-1.0, 1.0]:
		var low := Vector2(minf(0.0, side * _LEAF.x), 0.0) + 0.5 * _GAP * Vector2(side, 0.0)
		var outer := Rect2(low, _LEAF)
		var inner := outer.grow(-_BEVEL)
		var face := _ring(inner, _DEPTH)
		var edge := _ring(outer, _DEPTH - _BEVEL)
		var quads: Array[PackedVector3Array] = [face]
		for corner in 4:
			var next := (corner + 1) % 4
			quads.append([edge[corner], edge[next], face[next], face[corner]])
		for quad in quads:
			var normal := (quad[1] - quad[0]).cross(quad[3] - quad[0]).normalized()
			var first := points.size()
			for point in quad:
				points.append(point)
				normals.append(normal)
				# Along the brushing as far as the surface has it.
				var tangent := (Vector3.UP - normal * normal.y).normalized()
				tangents.append_array([tangent.x, tangent.y, tangent.z, 1.0])
				coordinates.append(Vector2(point.x, point.y))
			for index: int in [0, 2, 1, 0, 3, 2]:
				triangles.append(first + index)
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = points
	arrays[Mesh.ARRAY_NORMAL] = normals
	arrays[Mesh.ARRAY_TANGENT] = tangents
	arrays[Mesh.ARRAY_TEX_UV] = coordinates
	arrays[Mesh.ARRAY_INDEX] = triangles
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh


# A rectangle's corners, counter-clockwise.
static func _ring(area: Rect2, z: float) -> PackedVector3Array:
	var end := area.end
	return [
		Vector3(area.position.x, area.position.y, z),
		Vector3(end.x, area.position.y, z),
		Vector3(end.x, end.y, z),
		Vector3(area.position.x, end.y, z),
	]
