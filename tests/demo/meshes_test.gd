extends GdUnitTestSuite
## The demo's shapes: formulas against finite differences, meshes against what holds for any solid.

const LoopSubdivision := preload("res://demo/meshes/loop_subdivision.gd")
const SurfaceMesh := preload("res://demo/meshes/surface_mesh.gd")
const Surfaces := preload("res://demo/meshes/surfaces.gd")
const Teapot := preload("res://demo/meshes/teapot.obj")

const SHAPES := [["sphere"], ["torus"], ["plate"], ["knot"], ["vase"]]
const STEP := 1e-3


func _surface(shape: String) -> Callable:
	match shape:
		"torus":
			return Surfaces.torus.bind(0.42, 0.17)
		"plate":
			return Surfaces.plate.bind(0.8, 0.06, 0.06)
		"knot":
			return Surfaces.knot.bind(0.2, 0.1)
		"vase":
			return Surfaces.vase.bind(0.4, 1.05)
	return Surfaces.sphere.bind(0.5)


func _coordinates() -> Array[Vector2]:
	var coordinates: Array[Vector2] = []
	for i in 23:
		for j in 17:
			coordinates.append(Vector2((i + 0.31) / 23.0, (j + 0.43) / 17.0))
	return coordinates


func test_frames_are_orthonormal(shape: String, _test_parameters := SHAPES) -> void:
	var worst := 0.0
	for at in _coordinates():
		var basis: Basis = _surface(shape).call(at.x, at.y).basis
		var product := basis.transposed() * basis
		for column in 3:
			worst = maxf(worst, (product[column] - Basis.IDENTITY[column]).length())
	assert_float(worst).is_less(1e-5)


func test_normal_is_across_the_surface(shape: String, _test_parameters := SHAPES) -> void:
	var surface := _surface(shape)
	var least := 1.0
	for at in _coordinates():
		var along_u: Vector3 = (
			surface.call(at.x + STEP, at.y).origin - surface.call(at.x - STEP, at.y).origin
		)
		var along_v: Vector3 = (
			surface.call(at.x, at.y + STEP).origin - surface.call(at.x, at.y - STEP).origin
		)
		var normal: Vector3 = surface.call(at.x, at.y).basis.z
		least = minf(least, absf(along_u.cross(along_v).normalized().dot(normal)))
	# Single precision and the step leave a few thousandths of a radian.
	assert_float(least).is_greater(0.9999)


func test_tangent_follows_the_brushing(shape: String, _test_parameters := SHAPES) -> void:
	if shape == "knot":
		# Along the tube, but the mesh's u runs around it too.
		var frame: Transform3D = _surface(shape).call(0.2, 0.3)
		var ahead: Transform3D = _surface(shape).call(0.2 + STEP, 0.3)
		assert_float((ahead.origin - frame.origin).dot(frame.basis.x)).is_greater(0.0)
		return
	var least := 1.0
	for at in _coordinates():
		var before: Transform3D = _surface(shape).call(at.x - STEP, at.y)
		var after: Transform3D = _surface(shape).call(at.x + STEP, at.y)
		var tangent: Vector3 = _surface(shape).call(at.x, at.y).basis.x
		least = minf(least, (after.origin - before.origin).normalized().dot(tangent))
	assert_float(least).is_greater(0.9999)


func test_triangles_face_outwards(shape: String, _test_parameters := SHAPES) -> void:
	var arrays := SurfaceMesh.build(_surface(shape), 24, 16).surface_get_arrays(0)
	assert_int(_inward_triangles(arrays)).is_equal(0)
	assert_int((arrays[Mesh.ARRAY_INDEX] as PackedInt32Array).size()).is_greater(3 * 24 * 16)


func test_subdivision_keeps_a_closed_surface_closed() -> void:
	var subdivision := _octahedron()
	subdivision.refine()
	subdivision.refine()
	assert_int(subdivision.triangles.size()).is_equal(3 * 8 * 16)
	var edges: Dictionary[Vector2i, int] = {}
	for i in range(0, subdivision.triangles.size(), 3):
		for corner in 3:
			var a := subdivision.triangles[i + corner]
			var b := subdivision.triangles[i + (corner + 1) % 3]
			# Each directed edge once: closed, and all triangles turn the same way.
			assert_bool(edges.has(Vector2i(a, b))).is_false()
			edges[Vector2i(a, b)] = 1
	for edge in edges:
		assert_bool(edges.has(Vector2i(edge.y, edge.x))).is_true()
	# Euler: V - E + F = 2.
	@warning_ignore("integer_division")
	var euler := subdivision.points.size() - edges.size() / 2 + subdivision.triangles.size() / 3
	assert_int(euler).is_equal(2)


func test_subdivision_rounds_and_stays_in_the_hull() -> void:
	var subdivision := _octahedron()
	subdivision.refine()
	subdivision.refine()
	subdivision.refine()
	var longest := 0.0
	var shortest := 1.0
	for point in subdivision.points:
		longest = maxf(longest, point.length())
		shortest = minf(shortest, point.length())
	assert_float(longest).is_less(1.0)
	# The octahedron itself has 1 : 0.577.
	assert_float(shortest / longest).is_greater(0.85)


func test_flat_mesh_stays_flat_and_keeps_its_edge() -> void:
	var subdivision := LoopSubdivision.new(
		PackedVector3Array([Vector3.ZERO, Vector3.RIGHT, Vector3(1, 0, 1), Vector3.BACK]),
		PackedInt32Array([0, 1, 2, 0, 2, 3])
	)
	subdivision.refine()
	assert_int(subdivision.points.size()).is_equal(9)
	assert_bool(subdivision.points.has(Vector3(0.5, 0, 0))).is_true()
	for point in subdivision.points:
		assert_float(point.y).is_equal(0.0)


func test_teapot() -> void:
	var arrays := Teapot.surface_get_arrays(0)
	var subdivision := LoopSubdivision.new(arrays[Mesh.ARRAY_VERTEX], arrays[Mesh.ARRAY_INDEX])
	assert_int(subdivision.points.size()).is_equal(529)
	assert_int(subdivision.triangles.size()).is_equal(3 * 992)
	subdivision.refine()
	var smooth := subdivision.to_mesh().surface_get_arrays(0)
	assert_int(_inward_triangles(smooth)).is_equal(0)


func _octahedron() -> LoopSubdivision:
	var points := PackedVector3Array(
		[
			Vector3.RIGHT,
			Vector3.UP,
			Vector3.BACK,
			Vector3.LEFT,
			Vector3.DOWN,
			Vector3.FORWARD,
		]
	)
	return LoopSubdivision.new(
		points,
		PackedInt32Array([0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5])
	)


# Triangles that turn against the mean of their normals; the engine's front faces are clockwise.
func _inward_triangles(arrays: Array) -> int:
	var points: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
	var triangles: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	var count := 0
	for i in range(0, triangles.size(), 3):
		var a := triangles[i]
		var b := triangles[i + 1]
		var c := triangles[i + 2]
		var area := (points[c] - points[a]).cross(points[b] - points[a])
		if area.dot(normals[a] + normals[b] + normals[c]) <= 0.0:
			count += 1
	return count
