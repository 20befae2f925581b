extends GdUnitTestSuite
## LobeMaterial3D's coordinates and vertices: each property does what BaseMaterial3D's of the same
## name does.
##
## Both materials are drawn white and matte in the light of one lamp, with nothing else around:
## there they look the same. The engine's own picture is the reference.

const Kit := preload("support/render_kit.gd")
const SIDE := 64
# Frames until all pipelines have been compiled.
const SETTLED := 20

## What a row is drawn on.
const SOLIDS := "a sphere and a box"
const BOX := "a box"
const SHEET := "a quad in front of which another stands"
const POINTS := "points"
const PARTICLES := "instances of many ages"

const TRIPLANAR := {"uv1_triplanar": true}
const ON_SECOND := {
	"emission_enabled": true, "emission_texture": "picture", "emission_on_uv2": true
}
const SECOND_PLANES := {
	"emission_enabled": true,
	"emission_texture": "picture",
	"emission_on_uv2": true,
	"uv2_triplanar": true
}
# Compatibility mixes colours in sRGB in Godot's material, and linear ones in ours: here are none in
# between.
const DETAIL := {
	"detail_enabled": true,
	"detail_normal": "flat",
	"detail_albedo": "detail",
	"detail_mask": "mask",
	"albedo_texture": "plates",
	"texture_filter": BaseMaterial3D.TEXTURE_FILTER_NEAREST
}
const DETAIL_ON_SECOND := {
	"detail_enabled": true,
	"detail_albedo": "detail",
	"detail_uv_layer": BaseMaterial3D.DETAIL_UV_2,
	"texture_filter": BaseMaterial3D.TEXTURE_FILTER_NEAREST
}
const SHARP := {"detail_mask": "mask", "texture_filter": BaseMaterial3D.TEXTURE_FILTER_NEAREST}
const RELIEF := {"heightmap_enabled": true, "heightmap_texture": "hills", "heightmap_scale": 40.0}
const STEPS := {
	"heightmap_enabled": true,
	"heightmap_texture": "mask",
	"heightmap_scale": 40.0,
	"heightmap_deep_parallax": true,
	"heightmap_min_layers": 3,
	"heightmap_max_layers": 5
}
const SHAPE := {
	"albedo_texture": "field",
	"albedo_texture_msdf": true,
	"transparency": BaseMaterial3D.TRANSPARENCY_ALPHA,
	"uv1_scale": Vector3(1.0, 1.0, 1.0)
}
const FACING := {"billboard_mode": BaseMaterial3D.BILLBOARD_ENABLED}
const PARTICLE := {
	"billboard_mode": BaseMaterial3D.BILLBOARD_PARTICLES,
	"particles_anim_h_frames": 2,
	"particles_anim_v_frames": 2
}

## Property, value, what it is drawn on, what else is set. Words for textures are keys of _textures.
const ROWS := [
	["uv1_scale", Vector3(2.0, 1.5, 1.0), SOLIDS, {}],
	["uv1_offset", Vector3(0.3, 0.1, 0.0), SOLIDS, {}],
	["uv1_triplanar", true, SOLIDS, {}],
	["uv1_triplanar_sharpness", 6.0, SOLIDS, TRIPLANAR],
	["uv1_world_triplanar", true, SOLIDS, TRIPLANAR],
	["uv1_scale", Vector3(1.0, 1.0, 2.0), SOLIDS, TRIPLANAR],
	["uv1_offset", Vector3(0.0, 0.0, 0.4), SOLIDS, TRIPLANAR],
	["normal_enabled", true, BOX, {"uv1_triplanar": true, "normal_texture": "bumps"}],
	[
		"normal_enabled",
		true,
		BOX,
		{"uv1_triplanar": true, "uv1_world_triplanar": true, "normal_texture": "bumps"}
	],
	["emission_on_uv2", true, SOLIDS, {"emission_enabled": true, "emission_texture": "picture"}],
	["uv2_triplanar", true, SOLIDS, ON_SECOND],
	["uv2_triplanar_sharpness", 6.0, SOLIDS, SECOND_PLANES],
	["uv2_world_triplanar", true, SOLIDS, SECOND_PLANES],
	["uv2_scale", Vector3(1.0, 2.0, 3.0), SOLIDS, SECOND_PLANES],
	["uv2_offset", Vector3(0.1, 0.3, 0.4), SOLIDS, SECOND_PLANES],
	["uv2_scale", Vector3(2.0, 3.0, 1.0), SOLIDS, DETAIL_ON_SECOND],
	["uv2_offset", Vector3(0.3, 0.1, 0.0), SOLIDS, DETAIL_ON_SECOND],
	[
		"uv2_triplanar",
		true,
		SOLIDS,
		{"ao_enabled": true, "ao_texture": "picture", "ao_on_uv2": true, "ao_light_affect": 1.0}
	],
	["detail_enabled", true, SOLIDS, SHARP],
	["detail_albedo", "detail", SOLIDS, {"detail_enabled": true}],
	[
		"detail_mask",
		"mask",
		SOLIDS,
		{
			"detail_enabled": true,
			"detail_albedo": "detail",
			"texture_filter": BaseMaterial3D.TEXTURE_FILTER_NEAREST
		}
	],
	["detail_blend_mode", BaseMaterial3D.BLEND_MODE_ADD, SOLIDS, DETAIL],
	[
		"detail_blend_mode",
		BaseMaterial3D.BLEND_MODE_SUB,
		SOLIDS,
		{
			"detail_enabled": true,
			"detail_albedo": "plates",
			"albedo_texture": "mask",
			"texture_filter": BaseMaterial3D.TEXTURE_FILTER_NEAREST
		}
	],
	[
		"detail_blend_mode",
		BaseMaterial3D.BLEND_MODE_MUL,
		SOLIDS,
		{
			"detail_enabled": true,
			"detail_albedo": "plates",
			"albedo_texture": "detail",
			"texture_filter": BaseMaterial3D.TEXTURE_FILTER_NEAREST
		}
	],
	["detail_uv_layer", BaseMaterial3D.DETAIL_UV_2, SOLIDS, DETAIL],
	["detail_normal", "bumps", SOLIDS, {"detail_enabled": true, "detail_mask": "mask"}],
	["detail_enabled", true, SOLIDS, {"normal_enabled": true, "normal_texture": "bumps"}],
	["heightmap_enabled", true, BOX, {"heightmap_texture": "hills", "heightmap_scale": 40.0}],
	["heightmap_scale", -20.0, BOX, RELIEF],
	["heightmap_texture", "detail", BOX, RELIEF],
	["heightmap_flip_texture", true, BOX, RELIEF],
	["heightmap_flip_tangent", true, BOX, RELIEF],
	["heightmap_flip_binormal", true, BOX, RELIEF],
	["heightmap_deep_parallax", true, BOX, RELIEF],
	["heightmap_min_layers", 1, BOX, STEPS],
	["heightmap_max_layers", 1, BOX, STEPS],
	[
		"heightmap_enabled",
		true,
		BOX,
		{
			"heightmap_texture": "hills",
			"heightmap_scale": 40.0,
			"detail_enabled": true,
			"detail_albedo": "detail",
			"detail_uv_layer": BaseMaterial3D.DETAIL_UV_2
		}
	],
	["albedo_texture_force_srgb", true, SOLIDS, {}],
	[
		"albedo_texture_msdf",
		true,
		SOLIDS,
		{"albedo_texture": "field", "transparency": BaseMaterial3D.TRANSPARENCY_ALPHA}
	],
	["msdf_pixel_range", 12.0, SOLIDS, SHAPE],
	["msdf_outline_size", 1.5, SOLIDS, SHAPE],
	["billboard_mode", BaseMaterial3D.BILLBOARD_ENABLED, BOX, {}],
	["billboard_mode", BaseMaterial3D.BILLBOARD_FIXED_Y, BOX, {}],
	["billboard_mode", BaseMaterial3D.BILLBOARD_PARTICLES, PARTICLES, {}],
	["billboard_keep_scale", true, BOX, FACING],
	["billboard_keep_scale", true, PARTICLES, PARTICLE],
	["particles_anim_h_frames", 4, PARTICLES, PARTICLE],
	["particles_anim_v_frames", 3, PARTICLES, PARTICLE],
	["particles_anim_loop", true, PARTICLES, PARTICLE],
	["grow", true, SOLIDS, {"grow_amount": 0.15}],
	["grow_amount", -0.2, SOLIDS, {"grow": true}],
	["fixed_size", true, SOLIDS, {}],
	["use_point_size", true, POINTS, {"point_size": 14.0}],
	["point_size", 9.0, POINTS, {"use_point_size": true}],
	["use_z_clip_scale", true, SHEET, {"z_clip_scale": 0.2}],
	["z_clip_scale", 0.2, SHEET, {"use_z_clip_scale": true}],
	["use_fov_override", true, SOLIDS, {"fov_override": 60.0}],
	["fov_override", 30.0, SOLIDS, {"use_fov_override": true}],
]

var _view: LinearViewport
var _stages: Dictionary[String, Node3D] = {}
var _textures: Dictionary[String, Texture2D] = {}
var _table := LobeTable.make_single_lobe(1.0)
# The engine may stand still where a shader goes while its pipelines are being compiled on threads.
var _kept: Array[Material] = []


func before() -> void:
	_textures["picture"] = _paint(
		func(u: float, v: float) -> Color:
			var check := 0.5 * ((int(6.0 * u) + int(6.0 * v)) & 1)
			return Color(
				0.1 + 0.4 * u + check, 0.9 - 0.4 * v - check, 0.5 + 0.4 * sin(9.0 * (u + v))
			)
	)
	_textures["plates"] = _paint(
		func(u: float, v: float) -> Color:
			return Color.GREEN if fposmod(3.0 * u + v, 1.0) < 0.5 else Color.BLACK
	)
	# Sums and products with the plates are the same in sRGB.
	_textures["detail"] = _paint(
		func(u: float, v: float) -> Color:
			var place := fposmod(u + 0.3 * sin(TAU * v), 1.0)
			return Color.RED if place < 0.4 else (Color.BLUE if place < 0.7 else Color.MAGENTA)
	)
	_textures["mask"] = _paint(
		func(u: float, v: float) -> Color:
			return Color.WHITE if fposmod(2.0 * u + v, 1.0) < 0.5 else Color.BLACK
	)
	_textures["bumps"] = _paint(
		func(u: float, v: float) -> Color:
			return Color(0.5 + 0.2 * sin(TAU * u), 0.5 + 0.25 * cos(TAU * v), 1.0)
	)
	_textures["flat"] = _paint(func(_u: float, _v: float) -> Color: return Color(0.5, 0.5, 1.0))
	_textures["hills"] = _paint(
		func(u: float, v: float) -> Color:
			return Color.WHITE * (0.5 + 0.4 * sin(TAU * u) * cos(2.0 * TAU * v))
	)
	# Three discs, one for each channel, and another in alpha.
	_textures["field"] = _paint(
		func(u: float, v: float) -> Color:
			var place := Vector2(u, v)
			var red := 0.9 - place.distance_to(Vector2(0.45, 0.5))
			var green := 0.9 - place.distance_to(Vector2(0.55, 0.5))
			var blue := 0.9 - place.distance_to(Vector2(0.5, 0.45))
			return Color(red, green, blue, 0.95 - place.distance_to(Vector2(0.5, 0.5)))
	)


func after() -> void:
	_textures.clear()


func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_view.camera.set_perspective(40.0, 0.1, 20.0)
	var environment := LobeEnvironment3D.new()
	environment.panorama = Kit.constant(0.0)
	_view.add_child(environment)
	await environment.rebuild()
	var lamp := DirectionalLight3D.new()
	lamp.basis = Basis.looking_at(Vector3(-0.4, -0.7, -1.0))
	_view.add_child(lamp)
	for stage: String in [SOLIDS, BOX, SHEET, POINTS, PARTICLES]:
		_stages[stage] = _build(stage)
		_stages[stage].visible = false
		_view.add_child(_stages[stage])


func after_test() -> void:
	_stages.clear()
	for frame in SETTLED:
		await get_tree().process_frame
	_kept.clear()
	_view.free()


func test_properties_do_what_godots_do() -> void:
	var plain: Dictionary[String, Image] = {}
	for row: Array in ROWS:
		var property: String = row[0]
		var settings: Dictionary = row[3]
		if LinearViewport.is_compatibility() and settings.has("ao_light_affect"):
			# There it does not affect lamps.
			continue
		var what := "%s = %s with %s" % [property, row[1], settings]
		var key := "%s %s" % [row[2], settings]
		if not plain.has(key):
			plain[key] = await _draw(row[2], _make(settings))
		var changed := settings.duplicate()
		changed[property] = row[1]
		var godots := _make(changed)
		var expected := await _draw(row[2], godots)
		assert_array(LobeMaterial3D.get_losses_from(godots)).append_failure_message(what).is_empty()
		var made := LobeMaterial3D.from_standard(godots)
		made.table = _table
		var got := await _draw(row[2], made)
		# The engine's own picture changes with the property, and ours is the same.
		var change := _difference(expected, plain[key])
		var error := _difference(got, expected)
		assert_float(change).append_failure_message(what).is_greater(0.005)
		assert_float(error).append_failure_message(what).is_less(0.1 * change)


func _make(settings: Dictionary) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.metallic_specular = 0.0
	material.albedo_texture = _textures["picture"]
	for property: String in settings:
		var value: Variant = settings[property]
		material.set(property, _textures[value] if value is String else value)
	return material


func _draw(stage: String, material: Material) -> Image:
	var shown := _stages[stage]
	_kept.append(material)
	for node: Node in shown.get_children():
		if node is GeometryInstance3D and not node.has_meta("fixed"):
			(node as GeometryInstance3D).material_override = material
	shown.visible = true
	var image: Image = await _view.capture()
	shown.visible = false
	return image


# The mean difference of two pictures as they are seen.
static func _difference(a: Image, b: Image) -> float:
	var first := a.get_data().to_float32_array()
	var second := b.get_data().to_float32_array()
	var sum := 0.0
	for i in first.size():
		var x := pow(clampf(first[i], 0.0, 1.0), 1.0 / 2.2)
		sum += absf(x - pow(clampf(second[i], 0.0, 1.0), 1.0 / 2.2))
	return sum / first.size()


func _build(stage: String) -> Node3D:
	var root := Node3D.new()
	match stage:
		SOLIDS:
			var sphere := SphereMesh.new()
			sphere.add_uv2 = true
			sphere.radius = 0.6
			sphere.height = 1.2
			_place(root, sphere, Vector3(-0.5, 0.4, 0.0), Vector3(1.0, 1.0, 1.2))
			_place(root, _box(), Vector3(0.55, -0.4, 0.0), Vector3(1.0, 1.3, 1.0))
		BOX:
			_place(root, _box(), Vector3(0.1, 0.1, 0.0), Vector3(1.5, 1.2, 1.5))
		SHEET:
			var quad := QuadMesh.new()
			_place(root, quad, Vector3.ZERO, Vector3.ONE).rotation = Vector3.ZERO
			var before := _place(root, quad, Vector3(0.3, 0.2, 0.5), Vector3.ONE)
			before.rotation = Vector3.ZERO
			before.material_override = StandardMaterial3D.new()
			before.set_meta("fixed", true)
		POINTS:
			var arrays := []
			arrays.resize(Mesh.ARRAY_MAX)
			arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array(
				[Vector3(-0.4, 0.3, 0.0), Vector3(0.5, 0.2, 0.0), Vector3(0.1, -0.5, 0.3)]
			)
			arrays[Mesh.ARRAY_NORMAL] = PackedVector3Array(
				[Vector3.BACK, Vector3.BACK, Vector3.BACK]
			)
			arrays[Mesh.ARRAY_TEX_UV] = PackedVector2Array([Vector2.ZERO, Vector2.ONE, Vector2.ONE])
			var mesh := ArrayMesh.new()
			mesh.add_surface_from_arrays(Mesh.PRIMITIVE_POINTS, arrays)
			_place(root, mesh, Vector3.ZERO, Vector3.ONE).rotation = Vector3.ZERO
		PARTICLES:
			root.add_child(_particles())
	return root


static func _box() -> BoxMesh:
	var box := BoxMesh.new()
	box.add_uv2 = true
	return box


static func _place(root: Node3D, mesh: Mesh, at: Vector3, size: Vector3) -> MeshInstance3D:
	var node := MeshInstance3D.new()
	node.mesh = mesh
	node.position = at
	node.basis = Basis.from_euler(Vector3(0.5, 0.6, 0.2)) * Basis.from_scale(size)
	root.add_child(node)
	return node


# Angle, unused, phase of the animation, unused.
static func _particles() -> MultiMeshInstance3D:
	var many := MultiMesh.new()
	many.transform_format = MultiMesh.TRANSFORM_3D
	many.use_custom_data = true
	many.mesh = QuadMesh.new()
	many.instance_count = 4
	for i in 4:
		var turn := (
			Basis.from_euler(Vector3(0.4, 0.3 * i, 0.2)) * Basis.from_scale(Vector3.ONE * 0.8)
		)
		many.set_instance_transform(
			i, Transform3D(turn, Vector3(-0.6 + 1.2 * (i & 1), -0.6 + 0.6 * (i & 2), 0.1 * i))
		)
		many.set_instance_custom_data(i, Color(0.3 * i, 0.0, 0.1 + 0.37 * i, 0.0))
	var node := MultiMeshInstance3D.new()
	node.multimesh = many
	return node


static func _paint(colour: Callable) -> ImageTexture:
	var image := Image.create_empty(64, 64, false, Image.FORMAT_RGBA8)
	for y in 64:
		for x in 64:
			image.set_pixel(x, y, colour.call((x + 0.5) / 64.0, (y + 0.5) / 64.0))
	return ImageTexture.create_from_image(image)
