## Builds meshes from surfaces that are given by a formula, with the formula's own normals and
## tangents.

## A mesh of [param columns] × [param rows] quads over [param surface], a function of (u, v), both
## from 0 to 1, that gives a [Transform3D]: its origin is the point, its x axis the unit tangent,
## its z axis the unit normal.
static func build(surface: Callable, columns: int, rows: int) -> ArrayMesh:
	var points := PackedVector3Array()
	var normals := PackedVector3Array()
	var tangents := PackedFloat32Array()
	var coordinates := PackedVector2Array()
	for row in rows + 1:
		for column in columns + 1:
			var coordinate := Vector2(float(column) / columns, float(row) / rows)
			var frame: Transform3D = surface.call(coordinate.x, coordinate.y)
			points.append(frame.origin)
			normals.append(frame.basis.z)
			tangents.append_array([frame.basis.x.x, frame.basis.x.y, frame.basis.x.z, 1.0])
			coordinates.append(coordinate)

	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = points
	arrays[Mesh.ARRAY_NORMAL] = normals
	arrays[Mesh.ARRAY_TANGENT] = tangents
	arrays[Mesh.ARRAY_TEX_UV] = coordinates
	arrays[Mesh.ARRAY_INDEX] = _make_triangles(points, normals, columns, rows)
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh


static func _make_triangles(
	points: PackedVector3Array, normals: PackedVector3Array, columns: int, rows: int
) -> PackedInt32Array:
	var triangles := PackedInt32Array()
	for row in rows:
		for column in columns:
			var a := row * (columns + 1) + column
			var c := a + columns + 1
			for corners: Array in [[a, a + 1, c + 1], [a, c + 1, c]]:
				triangles.append_array(_facing_outwards(corners, points, normals))
	return triangles


# The engine's front faces are clockwise. Triangles without an area, at poles, are left out.
static func _facing_outwards(
	corners: Array, points: PackedVector3Array, normals: PackedVector3Array
) -> PackedInt32Array:
	var edge_b := points[corners[1]] - points[corners[0]]
	var edge_c := points[corners[2]] - points[corners[0]]
	var area := edge_b.cross(edge_c)
	if area.length_squared() < 1e-18:
		return []
	var outwards := normals[corners[0]] + normals[corners[1]] + normals[corners[2]]
	if area.dot(outwards) > 0.0:
		return [corners[0], corners[2], corners[1]]
	return [corners[0], corners[1], corners[2]]
