extends SceneTree
## `./dev bench flicker`: how much a bumpy metal under a small sun flickers while a camera passes
## by, beside Godot's material, and how far each is from a supersampled picture.
## `--roughness R`, `--anisotropy A`, `--size N`, `--texels T`, `--slope S`, `--frames N`,
## `--json FILE`.
##
## The picture is all surface: a floor, seen obliquely, so that no silhouette counts.

# Sides of the picture that is taken for the truth: 64 samples a pixel.
const _SAMPLES := 8
const _WARM_UP := 6
const _JUMP := 60.0 / 255.0
const _MAP := 256
const _FIELD := 30.0
const _DISTANCE := 4.0
const _ELEVATION := 0.75
# A quarter of a pixel or so a frame.
const _STEP := 0.01
const _SUN_RADIUS := 0.6
const _SUN := Color(150.0, 138.0, 120.0)
const _METHODS := ["standard", "without", "antialiased", "baked"]

var _arguments := CommandLine.new(
	"bench flicker", ["roughness", "anisotropy", "size", "texels", "slope", "frames", "json"]
)


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var options := {
		"roughness": _number("roughness", 0.25, 0.0, 1.0),
		"anisotropy": _number("anisotropy", 0.0, -1.0, 1.0),
		"size": _arguments.integer("size", 96, 16, 256),
		"texels": _number("texels", 1.5, 0.25, 16.0),
		"slope": _number("slope", 0.4, 0.0, 2.0),
		"frames": _arguments.integer("frames", 5, 2, 1000),
	}
	var json := _arguments.path("json") if _arguments.has("json") else ""
	if _arguments.error.is_empty() and DisplayServer.get_name() == "headless":
		_arguments.fail("the engine runs without a renderer.")
	if _arguments.error.is_empty():
		var results := await _measure(options)
		if not json.is_empty():
			_arguments.fail_if(AtomicFile.save_json(results, json))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _number(option: String, default: float, low: float, high: float) -> float:
	var value := _arguments.numbers(option, 1, [default])
	if _arguments.error.is_empty() and (value[0] < low or value[0] > high):
		_arguments.fail("--%s must be a number from %s to %s." % [option, low, high])
	return value[0] if _arguments.error.is_empty() else default


func _measure(options: Dictionary) -> Array[Dictionary]:
	var map := make_bumps(options["slope"])
	var variance := LobeMaterial3D.bake_normal_variance(map)
	map.generate_mipmaps(true)
	var normals := ImageTexture.create_from_image(map)
	var panorama := make_panorama()
	var truth := await _draw(
		_make_material("without", options, normals, variance), options, panorama
	)
	var results: Array[Dictionary] = []
	for method: String in _METHODS:
		var material := _make_material(method, options, normals, variance)
		var pictures := await _draw(material, options, panorama, 1, options["frames"])
		var result := {
			"renderer": RenderingServer.get_current_rendering_method(),
			"method": method,
			"roughness": options["roughness"],
			"anisotropy": options["anisotropy"],
			"jumping": 0.0,
			"mean_difference": 0.0,
			"psnr": psnr(pictures[0], truth[0]),
		}
		for i in range(1, pictures.size()):
			var change := compare(pictures[i - 1], pictures[i])
			result["jumping"] += change.x / (pictures.size() - 1)
			result["mean_difference"] += 255.0 * change.y / (pictures.size() - 1)
		results.append(result)
		print(
			(
				"%-11s  %.3f %% of the pixels jump, mean difference %.3f / 255, %.2f dB"
				% [method, 100.0 * result["jumping"], result["mean_difference"], result["psnr"]]
			)
		)
	return results


func _make_material(
	method: String, options: Dictionary, normals: Texture2D, variance: Texture2D
) -> Material:
	var material: Material
	if method == "standard":
		material = StandardMaterial3D.new()
	else:
		var ours := LobeMaterial3D.new()
		if method == "without":
			ours.specular_antialiasing = LobeBaseMaterial3D.SpecularAntialiasing.DISABLED
		elif method == "baked":
			ours.normal_variance_texture = variance
		material = ours
	material.set("metallic", 1.0)
	material.set("roughness", options["roughness"])
	material.set("normal_enabled", true)
	material.set("normal_texture", normals)
	material.set("anisotropy_enabled", options["anisotropy"] != 0.0)
	material.set("anisotropy", options["anisotropy"])
	# Texels a pixel, along the picture's rows.
	var size: int = options["size"]
	var pixels := size / (2.0 * _DISTANCE * tan(deg_to_rad(0.5 * _FIELD)))
	material.set("uv1_scale", Vector3.ONE * (8.0 * pixels * float(options["texels"]) / _MAP))
	return material


# Pictures as the screen shows them, from linear light of `samples`² samples a pixel.
func _draw(
	material: Material, options: Dictionary, panorama: Texture2D, samples := _SAMPLES, frames := 1
) -> Array[PackedFloat32Array]:
	var view := LinearViewport.new(samples * int(options["size"]))
	root.add_child(view)
	var surroundings := view.camera.environment
	surroundings.ambient_light_source = Environment.AMBIENT_SOURCE_SKY
	surroundings.reflected_light_source = Environment.REFLECTION_SOURCE_SKY
	surroundings.sky = Sky.new()
	var sky := PanoramaSkyMaterial.new()
	sky.panorama = panorama
	surroundings.sky.sky_material = sky
	var environment := LobeEnvironment3D.new()
	environment.panorama = panorama
	view.add_child(environment)
	var ground := MeshInstance3D.new()
	var plane := PlaneMesh.new()
	plane.size = Vector2(8.0, 8.0)
	ground.mesh = plane
	ground.material_override = material
	view.add_child(ground)
	view.camera.set_perspective(_FIELD, 0.1, 20.0)
	var pictures: Array[PackedFloat32Array] = []
	for frame in _WARM_UP + frames:
		var way := _STEP * maxi(frame - _WARM_UP, 0)
		var place := Vector3(way, _DISTANCE * sin(_ELEVATION), _DISTANCE * cos(_ELEVATION))
		view.camera.look_at_from_position(place, Vector3(0.6 * way, 0.0, 0.0))
		var image := await view.capture()
		if frame >= _WARM_UP:
			# Means of 2 x 2 pixels, three times.
			for halving in roundi(log(samples) / log(2.0)):
				image.shrink_x2()
			pictures.append(shown(image))
	view.free()
	return pictures


## Three values a pixel, encoded as sRGB and clipped as by a screen.
static func shown(image: Image) -> PackedFloat32Array:
	image.convert(Image.FORMAT_RGBF)
	var values := image.get_data().to_float32_array()
	for i in values.size():
		var value := clampf(values[i], 0.0, 1.0)
		values[i] = 12.92 * value if value <= 0.0031308 else 1.055 * pow(value, 1.0 / 2.4) - 0.055
	return values


## (Share of the pixels of which a channel changes by more than 60/255, mean change of a channel.)
static func compare(before: PackedFloat32Array, after: PackedFloat32Array) -> Vector2:
	var jumps := 0
	var sum := 0.0
	for i in range(0, before.size(), 3):
		var change := Vector3(
			absf(before[i] - after[i]),
			absf(before[i + 1] - after[i + 1]),
			absf(before[i + 2] - after[i + 2])
		)
		sum += change.x + change.y + change.z
		jumps += int(maxf(maxf(change.x, change.y), change.z) > _JUMP)
	return Vector2(3.0 * jumps, sum) / before.size()


static func psnr(a: PackedFloat32Array, b: PackedFloat32Array) -> float:
	var sum := 0.0
	for i in a.size():
		sum += (a[i] - b[i]) * (a[i] - b[i])
	return -10.0 * log(maxf(sum / a.size(), 1e-12)) / log(10.0)


## A normal map of random bumps, a texel or two wide, whose slopes have the given deviation along
## each axis. It repeats.
static func make_bumps(slope: float) -> Image:
	var random := RandomNumberGenerator.new()
	random.seed = 7
	var heights := PackedFloat32Array()
	heights.resize(_MAP * _MAP)
	for i in heights.size():
		heights[i] = random.randfn()
	var slopes := PackedVector2Array()
	slopes.resize(heights.size())
	var squares := 0.0
	for y in _MAP:
		for x in _MAP:
			# Differences of heights that a [1 2 1] kernel has smoothed across them.
			var sum := Vector2.ZERO
			for k: int in [-1, 0, 1]:
				var weight := 2.0 - absf(k)
				sum.x += weight * (_at(heights, x + 1, y + k) - _at(heights, x - 1, y + k))
				sum.y += weight * (_at(heights, x + k, y + 1) - _at(heights, x + k, y - 1))
			slopes[y * _MAP + x] = sum
			squares += 0.5 * sum.length_squared()
	var scale := slope / sqrt(squares / slopes.size())
	var image := Image.create_empty(_MAP, _MAP, false, Image.FORMAT_RGB8)
	for y in _MAP:
		for x in _MAP:
			var tilt := scale * slopes[y * _MAP + x]
			var normal := Vector3(-tilt.x, tilt.y, 1.0).normalized()
			image.set_pixel(
				x, y, Color(0.5 * normal.x + 0.5, 0.5 * normal.y + 0.5, 0.5 * normal.z + 0.5)
			)
	return image


static func _at(heights: PackedFloat32Array, x: int, y: int) -> float:
	return heights[posmod(y, _MAP) * _MAP + posmod(x, _MAP)]


## A blue sky over dark ground, and a small sun that its floor's mirror image shows.
static func make_panorama() -> ImageTexture:
	var sun := Vector3(0.3, 0.85, -1.0).normalized()
	var image := Image.create_empty(1024, 512, false, Image.FORMAT_RGBAF)
	for y in image.get_height():
		for x in image.get_width():
			var azimuth := TAU * (x + 0.5) / image.get_width()
			var polar := PI * (y + 0.5) / image.get_height()
			var direction := Vector3(
				sin(polar) * sin(azimuth), cos(polar), -sin(polar) * cos(azimuth)
			)
			var colour := Color(0.15, 0.13, 0.11)
			if direction.angle_to(sun) < deg_to_rad(_SUN_RADIUS):
				colour = _SUN
			elif direction.y > 0.0:
				colour = Color(0.8, 0.8, 0.8).lerp(Color(0.25, 0.4, 0.7), direction.y)
			image.set_pixel(x, y, colour)
	return ImageTexture.create_from_image(image)
