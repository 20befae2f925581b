extends GdUnitTestSuite
## The examples of shaders of one's own, demo/examples: they show what they are examples of.

const Kit := preload("support/render_kit.gd")
const PAGE := "res://docs/own-shaders.md"
const EXAMPLES := [["car_paint"], ["water"], ["brushed_dial"]]
const SIDE := 64

var _view: LinearViewport


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	_view.transparent_bg = false
	add_child(_view)


func after_test() -> void:
	_view.free()
	# Lights linger for a moment, for the next scene.
	for frame in 3:
		await get_tree().process_frame


func test_runs_as_it_is(name: String, _test_parameters := EXAMPLES) -> void:
	_view.add_child(_load(name))
	var picture: Image
	for frame in 6:
		picture = await _view.capture()
	# One NaN makes the mean one.
	assert_float(_mean(picture)).is_between(0.02, 1.0)


## The page's first shader, and what it says to put after the include, show what the equal
## LobeMaterial3D shows; copies of the material are bound.
func test_first_shader_of_the_page() -> void:
	var blocks := FileAccess.get_file_as_string(PAGE).split("```glsl\n")
	var code := blocks[1].get_slice("```", 0)
	var check := blocks[3].get_slice("```", 0)
	assert_str(check).contains("LOBELIGHT_API")
	var material := LobeShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = code.replace("\nuniform vec3", check + "\nuniform vec3")
	var ready := LobeMaterial3D.new()
	ready.albedo_color = Color(0.95, 0.8, 0.5)
	material.set_shader_parameter(&"colour", ready.albedo_color)
	ready.metallic = 1.0
	ready.roughness = 0.35
	ready.anisotropy_enabled = true
	ready.anisotropy = 0.8
	var light := LobeEnvironment3D.new()
	light.panorama = Kit.make_panorama(
		32, func(d: Vector3) -> Color: return Color(1.2, 0.8, 0.5) * (0.6 + 0.5 * d.y * d.x)
	)
	_view.add_child(light)
	var sphere := Kit.make_sphere(material.duplicate() as Material, 24)
	_view.add_child(sphere)
	await light.rebuild()
	await _view.capture()
	var own := await _view.capture()
	(sphere.mesh as SphereMesh).material = ready
	await _view.capture()
	var other := await _view.capture()
	assert_float(_mean(other)).is_greater(0.1)
	var largest := 0.0
	for y in SIDE:
		for x in SIDE:
			var one := own.get_pixel(x, y).linear_to_srgb()
			var equal := other.get_pixel(x, y).linear_to_srgb()
			for channel in 3:
				largest = maxf(largest, absf(one[channel] - equal[channel]))
	assert_float(largest).is_less(1.01 / 255.0)


func test_flakes_sparkle_until_they_are_smaller_than_pixels() -> void:
	var scene := _load("car_paint")
	await _view.capture()
	var paint: ShaderMaterial = (scene.get_node("Red") as MeshInstance3D).material_override
	(scene.get_node("Red") as Node3D).position = Vector3.ZERO
	for name: String in ["Blue", "Silver", "Camera", "WorldEnvironment"]:
		scene.get_node(name).free()
	paint.set_shader_parameter(&"coat_roughness", 0.5)
	_view.add_child(scene)
	var light: LobeEnvironment3D = scene.get_node("Light")
	light.panorama = Kit.make_panorama(
		32, func(d: Vector3) -> Color: return Color.WHITE * pow(maxf(d.y, 0.0), 2.0)
	)
	await light.rebuild()
	var found: Array[Vector2] = []
	# Spread, and flakes a metre, of which a pixel is 1 / 32.
	for case: Array in [[0.0, 12.0], [0.14, 12.0], [0.14, 900.0]]:
		paint.set_shader_parameter(&"flake_spread", case[0])
		paint.set_shader_parameter(&"flakes", case[1])
		await _view.capture()
		var picture := await _view.capture()
		found.append(Vector2(_roughness_of(picture), _mean(picture)))
	assert_float(found[1].x).is_greater(1.5 * found[0].x)
	assert_float(found[2].x).is_less(1.1 * found[0].x)
	# However they are seen, they send out as much.
	assert_float(found[1].y / found[0].y).is_between(0.85, 1.15)
	assert_float(found[2].y / found[0].y).is_between(0.85, 1.15)


func test_calm_water_reflects_as_fresnel_has_it() -> void:
	var scene := _load("water")
	await _view.capture()
	for name: String in ["Camera", "WorldEnvironment", "Sun"]:
		scene.get_node(name).free()
	var sea: MeshInstance3D = scene.get_node("Sea")
	var water: ShaderMaterial = (sea.mesh as PlaneMesh).material
	water.set_shader_parameter(&"steepness", 0.0)
	water.set_shader_parameter(&"depth_colour", Color.BLACK)
	_view.camera.position = Vector3(0.0, 2.0, 0.0)
	_view.camera.set_perspective(90.0, 0.1, 500.0)
	_view.add_child(scene)
	var light: LobeEnvironment3D = scene.get_node("Light")
	light.panorama = Kit.constant(1.0)
	await light.rebuild()
	await _view.capture()
	var picture := await _view.capture()
	@warning_ignore("integer_division")
	var half := SIDE / 2
	for y: int in [half + 4, half + 10, half + 20, SIDE - 1]:
		var below := (y + 0.5 - half) / half
		var cosine := below / sqrt(1.0 + below * below)
		var expected := 0.02 + 0.98 * pow(1.0 - cosine, 5.0)
		var seen := picture.get_pixel(half, y).g
		assert_float(seen / expected).is_between(0.85, 1.15)
	# With waves it mirrors less far away, where their slopes turn to the viewer.
	water.set_shader_parameter(&"steepness", 0.065)
	await _view.capture()
	var waves := await _view.capture()
	var far := half + 2
	assert_float(waves.get_pixel(half, far).g).is_less(0.7 * picture.get_pixel(half, far).g)


## Light from above, in front: facets that mirror it to the viewer are tilted up. Grooves from the
## centre outwards have such facets at 3 and 9 o'clock, those that go around at 12 and 6.
func test_brushing_goes_where_the_shader_says() -> void:
	var scene := _load("brushed_dial")
	await _view.capture()
	scene.set(&"swing", 0.0)
	for name: String in ["Camera", "WorldEnvironment", "Watch/Case"]:
		scene.get_node(name).free()
	for name: String in ["Hours", "Minutes", "Seconds"]:
		(scene.get_node("Watch/" + name) as Node3D).hide()
	var dial: MeshInstance3D = scene.get_node("Watch/Dial")
	var metal: ShaderMaterial = (dial.mesh as CylinderMesh).material
	for name: String in ["dial_colour", "ring_colour", "mark_colour"]:
		metal.set_shader_parameter(name, Color.WHITE)
	_view.add_child(scene)
	var light: LobeEnvironment3D = scene.get_node("Light")
	light.transform = Transform3D.IDENTITY
	var lamp := Vector3(0.0, 0.6, 0.8)
	light.panorama = Kit.make_panorama(
		64, func(d: Vector3) -> Color: return Color.WHITE * exp(40.0 * (d.dot(lamp) - 1.0))
	)
	await light.rebuild()
	await _view.capture()
	var picture := await _view.capture()
	for middle: float in [0.3, 0.45]:
		var dial_beside := _at(picture, middle, 0.0) + _at(picture, middle, PI)
		var dial_above := _at(picture, middle, 0.5 * PI) + _at(picture, middle, -0.5 * PI)
		assert_float(dial_beside).is_greater(3.0 * dial_above)
	var ring_beside := _at(picture, 0.95, 0.0) + _at(picture, 0.95, PI)
	var ring_above := _at(picture, 0.95, 0.5 * PI) + _at(picture, 0.95, -0.5 * PI)
	assert_float(ring_above).is_greater(3.0 * ring_beside)


static func _load(name: String) -> Node3D:
	# Resources of the scene that a test changes are not to stay so. (Who frees its sky draws a frame
	# before: Compatibility of Godot 4.6 makes textures for skies that went in their first one.)
	var path := "res://demo/examples/%s/%s.tscn" % [name, name]
	var scene: PackedScene = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	return scene.instantiate()


## Means over a few pixels around a place of the dial: a radius, and an angle from 3 o'clock.
func _at(picture: Image, radius: float, angle: float) -> float:
	var middle := Vector2(cos(angle), -sin(angle)) * radius
	var sum := 0.0
	for y in range(-1, 2):
		for x in range(-1, 2):
			var place := Vector2i(((middle + Vector2.ONE) * 0.5 * SIDE).floor()) + Vector2i(x, y)
			sum += picture.get_pixelv(place.clamp(Vector2i.ZERO, (SIDE - 1) * Vector2i.ONE)).g / 9.0
	return sum


static func _mean(picture: Image) -> float:
	var sum := 0.0
	for y in SIDE:
		for x in SIDE:
			var colour := picture.get_pixel(x, y)
			sum += (colour.r + colour.g + colour.b) / (3 * SIDE * SIDE)
	return sum


## How far pixels of the body are from the mean of those beside them.
static func _roughness_of(picture: Image) -> float:
	var sum := 0.0
	for y in range(1, SIDE - 1):
		for x in range(1, SIDE - 1):
			var around := 0.0
			var covered := picture.get_pixel(x, y).a
			for step: Vector2i in [Vector2i.LEFT, Vector2i.RIGHT, Vector2i.UP, Vector2i.DOWN]:
				var beside := picture.get_pixelv(Vector2i(x, y) + step)
				around += 0.25 * beside.r
				covered = minf(covered, beside.a)
			sum += covered * absf(picture.get_pixel(x, y).r - around)
	return sum
