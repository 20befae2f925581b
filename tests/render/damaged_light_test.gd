extends GdUnitTestSuite
## Saved lights that are damaged are told of in one sentence, and show nothing.

const Kit := preload("support/render_kit.gd")
const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const SkyKit := preload("support/sky_kit.gd")
const PATH := "user://damaged_light_test.res"
const TEXELS := 8
const OUTSIDE := 0.25
const INSIDE := 2.0
const FORMATS := [
	[LightFormats.Format.HALF],
	[LightFormats.Format.SHARED_EXPONENT],
	[LightFormats.Format.BPTC],
	[LightFormats.Format.ASTC],
]
# What is wrong, and what is said of it.
const CASES := [
	[
		"version",
		(
			"The light is in format 7, and this version of Lobelight reads up to 3: "
			+ "update the addon, or bake the light again."
		)
	],
	["no version", "The light is in format 0, which there is none of: bake it again."],
	["no faces", "The light has 0 faces, not 6: bake it again."],
	["five faces", "The light has 5 faces, not 6: bake it again."],
	["no face", "no image of 8 texels"],
	["other size", "no image of 8 texels"],
	["size", "no image of 16 texels"],
	["odd size", "The light's faces are 12 texels wide, no power of two: bake it again."],
	["negative size", "The light's faces are -8 texels wide, no power of two: bake it again."],
	["format", "no image of 8 texels"],
	["no levels", "no image of 8 texels"],
	["variance", "The light does not say what its levels were blurred with: bake it again."],
	["byte", "The light is not as it was saved, its checksum differs: bake it again."],
	["number", "The light is not as it was saved, its checksum differs: bake it again."],
	["sources", "The light's sources are not what sources are: bake it again."],
	["fewer sources", "The light's sources are not what sources are: bake it again."],
	["energy", "The light is not as it was saved, its checksum differs: bake it again."],
	["base", "The light does not say what its levels were blurred with: bake it again."],
]

var _view: LinearViewport
var _ball: MeshInstance3D
var _probe: LobeProbe3D


func before_test() -> void:
	_view = LinearViewport.new(8)
	add_child(_view)
	_ball = SkyKit.make_mirror()
	_view.add_child(_ball)
	var light := LobeEnvironment3D.new()
	light.panorama = Kit.constant(OUTSIDE)
	light.size = 8
	_view.add_child(light)
	await light.rebuild()


func after_test() -> void:
	_view.free()
	if FileAccess.file_exists(PATH):
		DirAccess.remove_absolute(PATH)


func test_a_whole_one_shows(format: LightFormats.Format, _test_parameters := FORMATS) -> void:
	var light := _make_light()
	var converted := LightFormats.convert_faces(light.faces, format)
	assert_str(converted.get("error", "")).is_empty()
	light.faces.assign(converted["faces"])
	light.seal()
	if format == LightFormats.Format.HALF:
		# As the first form was saved.
		light.version = 1
		light.checksum = ""
	_save(light)
	_probe = LobeProbe3D.new()
	_probe.light = _load_light()
	_view.add_child(_probe)
	await _assert_shows(INSIDE)
	_probe.light = null
	_probe.hide()
	var material: LobeMaterial3D = (_ball.mesh as SphereMesh).material
	material.light = _load_light()
	await _assert_shows(INSIDE)


func test_a_damaged_one_is_told(damage: String, told: String, _test_parameters := CASES) -> void:
	_save(_damage(_make_light(), damage))
	_probe = LobeProbe3D.new()
	_view.add_child(_probe)
	if told.begins_with("no "):
		told = (
			"A face of the light is %s with all levels in a format of lights: bake it again." % told
		)
	var light := _load_light()
	var material: LobeMaterial3D = (_ball.mesh as SphereMesh).material
	var give_material := func() -> void: material.light = light
	var name := light.resource_path if light.resource_path else "Light"
	await assert_error(give_material).is_push_error("LobeMaterial3D: %s: %s" % [name, told])
	await _assert_shows(OUTSIDE)
	var give_probe := func() -> void:
		_probe.light = light
		await RenderingServer.frame_post_draw
		# It is not told of again.
		_probe.hide()
		_probe.show()
		await RenderingServer.frame_post_draw
	await assert_error(give_probe).is_push_error("LobeProbe3D: %s: %s" % [name, told])
	material.light = null
	await _assert_shows(OUTSIDE)


func _make_light() -> LobeLight:
	var light := LobeLight.new()
	var faces: Array[Image] = []
	for face in 6:
		faces.append(_make_face(TEXELS, Image.FORMAT_RGBAH, true))
	light.faces = faces
	light.size = TEXELS
	light.is_even = true
	return light


func _make_face(side: int, format: Image.Format, levels: bool) -> Image:
	var face := Image.create_empty(side, side, levels, format)
	face.fill(Color(INSIDE, INSIDE, INSIDE))
	if levels:
		face.generate_mipmaps()
	return face


func _damage(light: LobeLight, damage: String) -> LobeLight:
	match damage:
		"version":
			light.version = 7
		"no version":
			light.version = 0
		"no faces":
			light.faces = []
		"five faces":
			light.faces = light.faces.slice(1)
		"no face":
			light.faces[3] = null
		"other size":
			light.faces[3] = _make_face(16, Image.FORMAT_RGBAH, true)
		"size":
			light.size = 16
		"odd size":
			light.size = 12
		"negative size":
			light.size = -8
		"format":
			light.faces[2] = _make_face(TEXELS, Image.FORMAT_RGBA8, true)
		"no levels":
			light.faces[5] = _make_face(TEXELS, Image.FORMAT_RGBAH, false)
		"variance":
			light.level_variance = NAN
		"byte":
			light.seal()
			var data := light.faces[2].get_data()
			data[5] ^= 1
			light.faces[2] = Image.create_from_data(TEXELS, TEXELS, true, Image.FORMAT_RGBAH, data)
		"number":
			light.seal()
			light.level_variance *= 2.0
		"sources":
			light.source_texels = _make_sources(-1.0)
		"fewer sources":
			light.source_texels = _make_sources(1.0).slice(4)
		"energy":
			light.source_texels = _make_sources(1.0)
			light.seal()
			light.source_texels = _make_sources(2.0)
		"base":
			light.base_variance = INF
	return light


# One that shines from above.
func _make_sources(energy: float) -> PackedFloat32Array:
	var texels: PackedFloat32Array = []
	texels.resize(48)
	texels[1] = 1.0
	texels[3] = 0.01
	for channel in 3:
		texels[16 + channel] = energy
	return texels


func _save(light: LobeLight) -> void:
	assert_int(ResourceSaver.save(light, PATH)).is_equal(OK)


func _load_light() -> LobeLight:
	return ResourceLoader.load(PATH, "", ResourceLoader.CACHE_MODE_IGNORE)


func _assert_shows(value: float) -> void:
	var image: Image = await _view.capture()
	assert_float(image.get_pixel(4, 4).g).is_equal_approx(value, 0.01)
