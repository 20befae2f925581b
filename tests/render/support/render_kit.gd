extends RefCounted
## Environments, tables and measurements for the rendered suites.

const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")


## The direction that a panorama shows at (u, v): u = fract(atan2(x, -z) / 2 pi), v = acos(y) / pi.
static func panorama_direction(u: float, v: float) -> Vector3:
	var azimuth := TAU * u
	var polar := PI * v
	return Vector3(sin(polar) * sin(azimuth), cos(polar), -sin(polar) * cos(azimuth))


## A panorama of 32-bit floats, 2 · height texels wide, from a function of the direction.
static func make_panorama(height: int, radiance: Callable) -> ImageTexture:
	var image := Image.create_empty(2 * height, height, false, Image.FORMAT_RGBAF)
	for y in height:
		for x in 2 * height:
			var direction := panorama_direction((x + 0.5) / (2.0 * height), (y + 0.5) / height)
			var colour: Color = radiance.call(direction)
			image.set_pixel(x, y, colour)
	return ImageTexture.create_from_image(image)


static func constant(value: float) -> ImageTexture:
	var image := Image.create_empty(8, 4, false, Image.FORMAT_RGBAF)
	image.fill(Color(value, value, value))
	return ImageTexture.create_from_image(image)


## Frames in which a LobeEnvironment3D draws a change: Compatibility reads back a face in each.
static func count_update_frames() -> int:
	return 6 if LinearViewport.is_compatibility() else 1


## A table with nothing symmetric about it: lobes that differ in every component and change with the
## view, as no fit would make them.
static func make_odd_table(
	lobes: int, views: Vector2i, alpha: Vector2, sharpness := 5.0
) -> LobeTable:
	var random := RandomNumberGenerator.new()
	random.seed = 4
	var image := Image.create_empty(views.x, views.y * lobes, false, Image.FORMAT_RGBAH)
	for k in lobes:
		var slope := Vector2(random.randf_range(-1.0, 1.0), random.randf_range(-1.0, 1.0))
		var weight := random.randf_range(0.3, 1.0) / lobes
		for p in views.y:
			for t in views.x:
				var texel := Color(
					slope.x + 0.1 * t / views.x,
					# Those of isotropic tables lie in the plane of incidence.
					slope.y - 0.1 * p / views.y if views.y > 1 else 0.0,
					sharpness + 0.5 * k / lobes + 0.3 * t / views.x,
					weight * (1.0 - 0.5 * t / views.x + 0.1 * p)
				)
				image.set_pixel(t, k * views.y + p, texel)
	var table := LobeTable.new()
	table.brdf = "odd"
	table.alpha = alpha
	table.lobe_count = lobes
	table.views = views
	table.image = image
	return table


## The table with a colour for each lobe and view.
static func coloured(table: LobeTable) -> LobeTable:
	var random := RandomNumberGenerator.new()
	random.seed = 9
	var size := table.image.get_size()
	var image := Image.create_empty(size.x, 2 * size.y, false, Image.FORMAT_RGBAH)
	image.blit_rect(table.image, Rect2i(Vector2i.ZERO, size), Vector2i.ZERO)
	for y in size.y:
		for x in size.x:
			var red := random.randf_range(0.0, 2.0)
			image.set_pixel(x, size.y + y, Color(0.0, 0.0, red, random.randf_range(0.0, 3.0 - red)))
	table.image = image
	return table


## The mean cosine of a spherical Gaussian, coth(kappa) - 1/kappa: what it leaves of the slope of a
## radiance that is linear in the direction.
static func mean_cosine(kappa: float) -> float:
	return 1.0 / tanh(kappa) - 1.0 / kappa


## The normal of the unit sphere at a pixel of a picture of `side` pixels, see SphereImpostor;
## zero where there is no sphere.
static func sphere_normal(x: int, y: int, side: int) -> Vector3:
	var p := Vector2(2.0 * x + 1.0 - side, side - 2.0 * y - 1.0) / side
	if p.length_squared() >= 1.0:
		return Vector3.ZERO
	return Vector3(p.x, p.y, sqrt(1.0 - p.length_squared()))


## The tangent frame of the sphere of SphereImpostor: columns tangent, bitangent, normal.
static func sphere_frame(normal: Vector3) -> Basis:
	var tangent := Vector3.UP.cross(normal).normalized()
	return Basis(tangent, normal.cross(tangent), normal)


## A sphere mesh with the tangents of SphereImpostor.
static func make_sphere(material: Material, rings := 64) -> MeshInstance3D:
	var mesh := SphereMesh.new()
	mesh.radius = 1.0
	mesh.height = 2.0
	mesh.rings = rings
	mesh.radial_segments = 2 * rings
	mesh.material = material
	var instance := MeshInstance3D.new()
	instance.mesh = mesh
	return instance


## Whether all channels of all pixels are finite and none is negative.
static func is_finite_image(image: Image) -> bool:
	for value in image.get_data().to_float32_array():
		if not is_finite(value) or value < 0.0:
			return false
	return true


## Peak signal-to-noise ratio of two linear images, display-encoded and clamped to [0, 1].
static func psnr(a: Image, b: Image) -> float:
	var first := a.get_data().to_float32_array()
	var second := b.get_data().to_float32_array()
	var sum := 0.0
	for i in first.size():
		var x := pow(clampf(first[i], 0.0, 1.0), 1.0 / 2.2)
		var y := pow(clampf(second[i], 0.0, 1.0), 1.0 / 2.2)
		sum += (x - y) * (x - y)
	return -10.0 * log(maxf(sum / first.size(), 1e-12)) / log(10.0)


## The direction of a texel of a cube map's face of `size` texels, and its solid angle. Written
## from OpenGL 4.6, table 8.19, apart from the shaders.
static func texel_direction(face: int, x: int, y: int, size: int) -> Vector3:
	var s := (2.0 * x + 1.0) / size - 1.0
	var t := (2.0 * y + 1.0) / size - 1.0
	var directions: Array[Vector3] = [
		Vector3(1, -t, -s),
		Vector3(-1, -t, s),
		Vector3(s, 1, t),
		Vector3(s, -1, -t),
		Vector3(s, -t, 1),
		Vector3(-s, -t, -1),
	]
	return directions[face].normalized()


static func texel_solid_angle(x: int, y: int, size: int) -> float:
	# The solid angle between the face's centre and a corner (x, y) is atan(x y / sqrt(x² + y² + 1)).
	var corner := func(s: float, t: float) -> float: return atan(s * t / sqrt(s * s + t * t + 1.0))
	var s0 := 2.0 * x / size - 1.0
	var t0 := 2.0 * y / size - 1.0
	var s1 := s0 + 2.0 / size
	var t1 := t0 + 2.0 / size
	return corner.call(s1, t1) - corner.call(s0, t1) - corner.call(s1, t0) + corner.call(s0, t0)


## A level of a pyramid as six images.
static func level_of(faces: Array[Image], level: int) -> Array[Image]:
	var result: Array[Image] = []
	var size := faces[0].get_width() >> level
	for face in faces:
		var offset := face.get_mipmap_offset(level)
		var data := face.get_data().slice(offset, offset + size * size * 8)
		result.append(Image.create_from_data(size, size, false, Image.FORMAT_RGBAH, data))
	return result
