## Loop's subdivision of triangle meshes (C. Loop, "Smooth subdivision surfaces based on triangles",
## 1987), with straight rules along boundaries.

## The mesh's points.
var points: PackedVector3Array
## Three indices into the points for each triangle.
var triangles: PackedInt32Array


## Points at the same place are joined.
func _init(mesh_points: PackedVector3Array, mesh_triangles: PackedInt32Array) -> void:
	var known: Dictionary[Vector3, int] = {}
	for index in mesh_triangles:
		var point := mesh_points[index].snappedf(1e-5)
		if not known.has(point):
			known[point] = known.size()
			points.append(point)
		triangles.append(known[point])


## Replaces each triangle by four.
func refine() -> void:
	var edges := _find_edges()
	var refined := _move_points(edges)
	var middles: Dictionary[Vector2i, int] = {}
	for edge in edges:
		middles[edge] = refined.size()
		refined.append(_place_middle(edge, edges[edge]))
	var finer := PackedInt32Array()
	for i in range(0, triangles.size(), 3):
		var a := triangles[i]
		var b := triangles[i + 1]
		var c := triangles[i + 2]
		var ab := middles[_edge(a, b)]
		var bc := middles[_edge(b, c)]
		var ca := middles[_edge(c, a)]
		finer.append_array([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca])
	points = refined
	triangles = finer


## The mesh with normals that weigh the triangles about a point by their area.
func to_mesh() -> ArrayMesh:
	var normals := PackedVector3Array()
	normals.resize(points.size())
	for i in range(0, triangles.size(), 3):
		var origin := points[triangles[i]]
		var edge_b := points[triangles[i + 1]] - origin
		var edge_c := points[triangles[i + 2]] - origin
		for corner in 3:
			# The engine's front faces are clockwise.
			normals[triangles[i + corner]] += edge_c.cross(edge_b)
	for i in normals.size():
		normals[i] = normals[i].normalized()
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = points
	arrays[Mesh.ARRAY_NORMAL] = normals
	arrays[Mesh.ARRAY_INDEX] = triangles
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh


static func _edge(a: int, b: int) -> Vector2i:
	return Vector2i(mini(a, b), maxi(a, b))


# Each edge with the points across it: two, or one at a boundary.
func _find_edges() -> Dictionary[Vector2i, PackedInt32Array]:
	var edges: Dictionary[Vector2i, PackedInt32Array] = {}
	for i in range(0, triangles.size(), 3):
		for corner in 3:
			var edge := _edge(triangles[i + corner], triangles[i + (corner + 1) % 3])
			var across := triangles[i + (corner + 2) % 3]
			edges[edge] = edges.get(edge, PackedInt32Array()) + PackedInt32Array([across])
	return edges


# Inside (1 − n β) p + β Σ neighbours, β = (5/8 − (3/8 + cos(2π/n)/4)²)/n; at a boundary 3/4 p + 1/8
# of each neighbour along it.
func _move_points(edges: Dictionary[Vector2i, PackedInt32Array]) -> PackedVector3Array:
	var inner: Array[PackedInt32Array] = []
	var outer: Array[PackedInt32Array] = []
	inner.resize(points.size())
	outer.resize(points.size())
	for edge in edges:
		inner[edge.x].append(edge.y)
		inner[edge.y].append(edge.x)
		if edges[edge].size() == 1:
			outer[edge.x].append(edge.y)
			outer[edge.y].append(edge.x)
	var moved := points.duplicate()
	for i in points.size():
		if outer[i].size() == 2:
			moved[i] = 0.75 * points[i] + 0.125 * (points[outer[i][0]] + points[outer[i][1]])
		elif outer[i].is_empty():
			var count := inner[i].size()
			var root := 0.375 + 0.25 * cos(TAU / count)
			var beta := (0.625 - root * root) / count
			moved[i] = (1.0 - count * beta) * points[i]
			for neighbour in inner[i]:
				moved[i] += beta * points[neighbour]
	return moved


# 3/8 of the edge's ends and 1/8 of the points across it; the middle at a boundary.
func _place_middle(edge: Vector2i, across: PackedInt32Array) -> Vector3:
	var ends := points[edge.x] + points[edge.y]
	if across.size() != 2:
		return 0.5 * ends
	return 0.375 * ends + 0.125 * (points[across[0]] + points[across[1]])
