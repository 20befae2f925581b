extends RefCounted
## Skies, and what a camera sees of them and of a mirror.

const Kit := preload("render_kit.gd")

const SHADER := """shader_type sky;
void sky() {
	COLOR = vec3(0.6) + EYEDIR * vec3(0.4, 0.3, -0.35) + 0.15 * sin(4.0 * EYEDIR.zxy);
	if (LIGHT0_ENABLED) {
		COLOR += LIGHT0_COLOR * LIGHT0_ENERGY * pow(max(dot(LIGHT0_DIRECTION, EYEDIR), 0.0), 8.0);
	}
}
"""
const AXES: PackedVector3Array = [
	Vector3.RIGHT, Vector3.LEFT, Vector3.UP, Vector3.DOWN, Vector3.BACK, Vector3.FORWARD
]


## A smooth radiance without any symmetry, between 0.1 and 1.3.
static func radiance(direction: Vector3) -> Color:
	return Color(
		0.7 + 0.3 * direction.x + 0.2 * sin(3.0 * direction.y),
		0.7 + 0.3 * direction.y + 0.2 * sin(3.0 * direction.z),
		0.6 - 0.4 * direction.z + 0.1 * sin(4.0 * direction.x)
	)


## Makes an environment show a kind of sky: one of the engine's materials, a shader, or a colour.
static func set_sky(environment: Environment, kind: String) -> void:
	environment.background_mode = Environment.BG_SKY
	environment.sky = Sky.new()
	environment.sky.radiance_size = Sky.RADIANCE_SIZE_32
	match kind:
		"panorama":
			var material := PanoramaSkyMaterial.new()
			material.panorama = Kit.make_panorama(64, radiance)
			environment.sky.sky_material = material
		"procedural":
			var material := ProceduralSkyMaterial.new()
			# Noise of 1/255, by the pixel.
			material.use_debanding = false
			environment.sky.sky_material = material
		"physical":
			var material := PhysicalSkyMaterial.new()
			material.use_debanding = false
			environment.sky.sky_material = material
		"shader":
			var material := ShaderMaterial.new()
			material.shader = Shader.new()
			material.shader.code = SHADER
			environment.sky.sky_material = material
		"colour":
			environment.background_mode = Environment.BG_COLOR
			environment.background_color = Color(0.2, 0.5, 0.9)
		"clear":
			environment.background_mode = Environment.BG_CLEAR_COLOR


## A light that skies show as their sun.
static func make_sun() -> DirectionalLight3D:
	var sun := DirectionalLight3D.new()
	sun.rotation_degrees = Vector3(-35.0, 130.0, 0.0)
	sun.light_color = Color(1.0, 0.8, 0.5)
	sun.sky_mode = DirectionalLight3D.SKY_MODE_SKY_ONLY
	return sun


static func make_mirror() -> MeshInstance3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = LobeTable.make_single_lobe(0.001)
	return Kit.make_sphere(material, 96)


## What a camera at a point sees along each axis, a right angle wide. To be awaited.
static func look_around(view: LinearViewport, from := Vector3.ZERO) -> Array[Image]:
	var camera := view.camera
	var before := camera.transform
	var projection := camera.projection
	var transparent := view.transparent_bg
	view.transparent_bg = false
	camera.set_perspective(90.0, 0.1, 10.0)
	var pictures: Array[Image] = []
	for axis in AXES:
		camera.look_at_from_position(from, from + axis, _up(axis))
		pictures.append(await view.capture())
	view.transparent_bg = transparent
	camera.transform = before
	camera.projection = projection
	return pictures


## The pixel that such pictures have in a direction.
static func seen(pictures: Array[Image], direction: Vector3) -> Color:
	var index := 0
	for i in AXES.size():
		if AXES[i].dot(direction) > AXES[index].dot(direction):
			index = i
	var axis := AXES[index]
	var local := direction * Basis.looking_at(axis, _up(axis))
	var side := pictures[index].get_width()
	var position := Vector2(local.x, -local.y) / -local.z
	var pixel := ((position * 0.5 + Vector2(0.5, 0.5)) * side).floor()
	return pictures[index].get_pixelv(Vector2i(pixel.clampf(0.0, side - 1.0)))


## The direction that the unit sphere reflects into a pixel; zero beside the sphere and at its rim.
static func reflected(camera: Camera3D, pixel: Vector2) -> Vector3:
	var origin := camera.project_ray_origin(pixel)
	var ray := camera.project_ray_normal(pixel)
	var hit: PackedVector3Array = Geometry3D.segment_intersects_sphere(
		origin, origin + 20.0 * ray, Vector3.ZERO, 1.0
	)
	if hit.is_empty() or -hit[1].dot(ray) < 0.3:
		return Vector3.ZERO
	return ray.bounce(hit[1])


## The directions that the unit sphere reflects into the pixels of a picture, row by row.
static func all_reflected(camera: Camera3D, side: int) -> PackedVector3Array:
	var directions := PackedVector3Array()
	for y in side:
		for x in side:
			directions.append(reflected(camera, Vector2(x + 0.5, y + 0.5)))
	return directions


## How a mirror's picture compares with what there is to see: (share of pixels that are less than
## 6 % off, mean error over mean light).
static func compare(
	mirrored: Image, directions: PackedVector3Array, around: Array[Image]
) -> Vector2:
	var sum := 0.0
	var off := 0.0
	var count := 0
	var matching := 0
	for i in directions.size():
		if directions[i] == Vector3.ZERO:
			continue
		@warning_ignore("integer_division")
		var got := mirrored.get_pixel(i % mirrored.get_width(), i / mirrored.get_width())
		var expected := seen(around, directions[i])
		var difference := 0.0
		for channel in 3:
			sum += expected[channel]
			off += absf(got[channel] - expected[channel])
			difference = maxf(difference, absf(got[channel] - expected[channel]))
		count += 1
		# Compatibility's frame buffer shows nothing that is darker than 0.00084.
		matching += 1 if difference < maxf(0.06 * expected.v, 0.001) else 0
	return Vector2(float(matching) / count, off / sum)


static func _up(axis: Vector3) -> Vector3:
	return Vector3.UP if absf(axis.y) < 0.9 else Vector3.BACK
