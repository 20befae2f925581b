extends GdUnitTestSuite
## LobeMaterial3D's properties beside those of Godot's own materials, all of them: name, type,
## default, hint, place; and that scripts, tweens, animations and scenes treat both alike.

## What it does not have, and why.
const NOT_CARRIED: Dictionary[String, String] = {}
## Hints that go further than the engine's, and those.
const WIDER: Dictionary[String, Array] = {
	"roughness": [0.0, 1.0, 0.001],
	"anisotropy": [-1.0, 1.1, 0.001],
}
# What turns on what begins so.
const _SWITCHES: Dictionary[String, Array] = {
	"albedo_texture_msdf": ["msdf_"],
	"backlight_enabled": ["backlight"],
	"bent_normal_enabled": ["bent_normal_"],
	"billboard_mode": ["billboard_", "particles_anim_"],
	"detail_enabled": ["detail_"],
	"distance_fade_mode": ["distance_fade_"],
	"emission_enabled": ["emission"],
	"grow": ["grow_"],
	"heightmap_enabled": ["heightmap_"],
	"proximity_fade_enabled": ["proximity_fade_"],
	"refraction_enabled": ["refraction_"],
	"rim_enabled": ["rim"],
	"stencil_mode": ["stencil_"],
	"subsurf_scatter_enabled": ["subsurf_scatter_"],
	"use_fov_override": ["fov_override"],
	"use_point_size": ["point_size"],
	"use_z_clip_scale": ["z_clip_scale"],
	"uv1_triplanar": ["uv1_triplanar_", "uv1_world_"],
	"uv2_triplanar": ["uv2_triplanar_", "uv2_world_"],
}
# Without what it belongs to, the engine refuses it.
const PHYSICAL_UNITS := "rendering/lights_and_shadows/use_physical_light_units"
const SCENE := "user://vocabulary_test.tscn"

var _texture := ImageTexture.create_from_image(Image.create_empty(2, 2, false, Image.FORMAT_RGB8))
# Of the engine's list, by the names.
var _godots: Dictionary[String, Dictionary] = {}
# Of ours.
var _ours: Dictionary[String, Dictionary] = {}


func before() -> void:
	_godots = _by_name(ClassDB.class_get_property_list(&"BaseMaterial3D", true))
	_ours = _by_name((LobeBaseMaterial3D as Script).get_script_property_list())
	ProjectSettings.set_setting(PHYSICAL_UNITS, true)


func after() -> void:
	ProjectSettings.set_setting(PHYSICAL_UNITS, false)


func test_every_property_is_there_or_lost() -> void:
	assert_int(_godots.size()).is_greater(120)
	var lacking: Array[String] = []
	for name in _godots:
		if not _ours.has(name):
			lacking.append(name)
	assert_array(lacking).contains_exactly_in_any_order(NOT_CARRIED.keys())


func test_types_defaults_and_hints() -> void:
	var made := LobeMaterial3D.new()
	var usual := StandardMaterial3D.new()
	for name in _get_common():
		var ours := _ours[name]
		var godots := _godots[name]
		assert_int(ours["type"]).append_failure_message(name).is_equal(godots["type"])
		_expect_equal([made, usual], name, "default")
		assert_int(ours["hint"]).append_failure_message(name).is_equal(godots["hint"])
		if WIDER.has(name):
			assert_array(_numbers(ours)).is_equal(WIDER[name])
			continue
		var expected: Array = _numbers(godots)
		assert_array(_numbers(ours)).append_failure_message(name).is_equal(expected)


func test_groups_and_order() -> void:
	var expected: Array = []
	for name in _godots:
		if _ours.has(name):
			expected.append([_godots[name]["group"], name])
	var got: Array = []
	for name in _ours:
		if _godots.has(name):
			got.append([_ours[name]["group"], name])
	assert_array(got).is_equal(expected)


func test_losses_are_what_is_not_carried() -> void:
	for name in _godots:
		var source := StandardMaterial3D.new()
		for switch: String in _SWITCHES:
			for beginning: String in _SWITCHES[switch]:
				if name.begins_with(beginning):
					source.set(switch, true)
		source.set(name, _other_value(name, 1.0))
		var losses := LobeMaterial3D.get_losses_from(source)
		assert_bool(name in losses).append_failure_message(name).is_equal(NOT_CARRIED.has(name))


func test_an_animation_drives_both() -> void:
	var root := Node.new()
	add_child(root)
	var materials := _add_meshes(root)
	var animation := Animation.new()
	animation.length = 2.0
	for name in _get_common():
		for owner: String in ["Ours", "Godots"]:
			var track := animation.add_track(Animation.TYPE_VALUE)
			animation.track_set_path(track, "%s:material_override:%s" % [owner, name])
			animation.track_insert_key(track, 0.0, StandardMaterial3D.new().get(name))
			animation.track_insert_key(track, 1.0, _other_value(name, 0.4))
			animation.track_insert_key(track, 2.0, _other_value(name, 0.9))
	var player := AnimationPlayer.new()
	var library := AnimationLibrary.new()
	library.add_animation("all", animation)
	player.add_animation_library("", library)
	root.add_child(player)
	player.play("all")
	var moved: Dictionary[String, bool] = {}
	for time: float in [0.0, 0.3, 1.0, 1.6, 2.0]:
		player.seek(time, true)
		for name in _get_common():
			_expect_equal(materials, name, "at %s" % time)
			if materials[0].get(name) != StandardMaterial3D.new().get(name):
				moved[name] = true
	var common := _get_common()
	assert_array(moved.keys()).contains_exactly_in_any_order(common)
	root.free()


func test_a_tween_drives_both() -> void:
	var materials: Array[Material] = [LobeMaterial3D.new(), StandardMaterial3D.new()]
	var tween := create_tween()
	tween.set_parallel()
	for name in _get_common():
		if _godots[name]["type"] in [TYPE_FLOAT, TYPE_COLOR, TYPE_VECTOR3]:
			for material in materials:
				tween.tween_property(material, name, _other_value(name, 0.8), 1.0)
	for step in 3:
		tween.custom_step(0.3)
		for name in _get_common():
			_expect_equal(materials, name, "step %d" % step)
	tween.kill()
	assert_float(materials[0].get("rim_tint")).is_equal_approx(0.716, 0.001)


func test_a_script_of_one_is_one_of_the_other() -> void:
	var code := "static func run(material):\n\tvar value = null\n"
	for name in _get_common():
		code += "\tvalue = material.%s\n\tmaterial.%s = value\n" % [name, name]
	code += "\tmaterial.rim = 0.5 * material.rim\n\tmaterial.uv1_scale *= 2.0\n"
	code += "\tmaterial.albedo_color.a = 0.5\n"
	code += "\tmaterial.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED\n"
	var script := GDScript.new()
	script.source_code = code
	assert_int(script.reload()).is_equal(OK)
	var materials: Array[Material] = [LobeMaterial3D.new(), StandardMaterial3D.new()]
	for material in materials:
		script.call("run", material)
	for name in _get_common():
		_expect_equal(materials, name, "script")
	assert_float(materials[0].get("rim")).is_equal(0.5)


func test_scenes_keep_everything() -> void:
	var mesh := MeshInstance3D.new()
	mesh.mesh = BoxMesh.new()
	var material := LobeMaterial3D.new()
	mesh.material_override = material
	for name in _get_common():
		material.set(name, _other_value(name, 0.7))
	var packed := PackedScene.new()
	packed.pack(mesh)
	assert_int(ResourceSaver.save(packed, SCENE)).is_equal(OK)
	packed = ResourceLoader.load(SCENE, "", ResourceLoader.CACHE_MODE_IGNORE_DEEP)
	var loaded: MeshInstance3D = packed.instantiate()
	for name in _get_common():
		var after: Variant = loaded.material_override.get(name)
		var is_kept: bool = after == material.get(name)
		if _godots[name]["type"] == TYPE_OBJECT:
			is_kept = after is Texture2D
		var message := "%s: %s, saved %s" % [name, after, material.get(name)]
		assert_bool(is_kept).append_failure_message(message).is_true()
	mesh.free()
	loaded.free()
	DirAccess.remove_absolute(SCENE)


func test_what_is_of_no_use_is_hidden() -> void:
	var material := LobeMaterial3D.new()
	for case: Array in [
		["alpha_scissor_threshold", {"transparency": 2}],
		["alpha_antialiasing_mode", {"transparency": 3}],
		["alpha_antialiasing_edge", {"transparency": 2, "alpha_antialiasing_mode": 1}],
		["proximity_fade_distance", {"proximity_fade_enabled": true}],
		["distance_fade_max_distance", {"distance_fade_mode": 2}],
		["stencil_compare", {"stencil_mode": 3}],
		["stencil_outline_thickness", {"stencil_mode": 1}],
	]:
		var name: String = case[0]
		material = LobeMaterial3D.new()
		assert_bool(_is_shown(material, name)).append_failure_message(name).is_false()
		for switch: String in case[1]:
			material.set(switch, case[1][switch])
		assert_bool(_is_shown(material, name)).append_failure_message(name).is_true()
	assert_bool(_is_shown(material, "roughness")).is_true()
	material.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	assert_bool(_is_shown(material, "roughness")).is_false()
	assert_bool(_is_shown(material, "albedo_color")).is_true()


func test_outlines_are_drawn_by_a_pass_as_godots() -> void:
	var further := StandardMaterial3D.new()
	var materials: Array[Material] = [LobeMaterial3D.new(), StandardMaterial3D.new()]
	for material in materials:
		material.render_priority = 3
		material.next_pass = further
		material.set("stencil_mode", BaseMaterial3D.STENCIL_MODE_OUTLINE)
		material.set("stencil_color", Color.RED)
		material.set("stencil_reference", 9)
		material.set("stencil_outline_thickness", 0.2)
	for mode: BaseMaterial3D.StencilMode in [1, 2]:
		for material in materials:
			material.set("stencil_mode", mode)
		var ours := materials[0].next_pass as StandardMaterial3D
		var godots := materials[1].next_pass as StandardMaterial3D
		assert_object(ours.next_pass).is_same(further)
		for name in _godots:
			if not name in ["grow_amount", "emission_intensity"]:
				_expect_equal([ours, godots], name, "pass of mode %d" % mode)
		assert_int(ours.render_priority).is_equal(godots.render_priority)
	# A converted one has its own.
	var converted := LobeMaterial3D.from_standard(materials[1] as BaseMaterial3D)
	assert_bool(converted.next_pass == materials[1].next_pass).is_false()
	assert_object(converted.next_pass.next_pass).is_not_null()
	# So has one whose pass was converted with it.
	var drawn := LobeMaterial3D.from_standard(materials[0].next_pass as BaseMaterial3D)
	drawn.set_meta(&"_stencil_owned", true)
	materials[0].next_pass = drawn
	materials[0].set("stencil_color", Color.BLUE)
	assert_that(drawn.albedo_color).is_equal(Color.BLUE)
	for material in materials:
		material.set("stencil_mode", BaseMaterial3D.STENCIL_MODE_DISABLED)
		assert_object(material.next_pass).is_same(further)


func _by_name(list: Array[Dictionary]) -> Dictionary[String, Dictionary]:
	var found: Dictionary[String, Dictionary] = {}
	var group := ""
	for property: Dictionary in list:
		if property["usage"] & PROPERTY_USAGE_GROUP:
			group = property["name"]
		elif property["usage"] & PROPERTY_USAGE_STORAGE:
			property["group"] = group
			found[property["name"]] = property
	return found


func _get_common() -> Array[String]:
	var common: Array[String] = []
	for name in _godots:
		if _ours.has(name):
			common.append(name)
	return common


# A hint's text, with numbers as such.
func _numbers(property: Dictionary) -> Array:
	var parts: Array = []
	for part: String in (property["hint_string"] as String).split(","):
		parts.append(part.to_float() if part.is_valid_float() else part)
	return parts


# Not the default; `share` chooses where it lies in its range.
func _other_value(name: String, share: float) -> Variant:
	var usual: Variant = StandardMaterial3D.new().get(name)
	var property := _godots[name]
	var value: Variant = 0.5 + share
	match property["type"]:
		TYPE_BOOL:
			value = not usual
		TYPE_COLOR:
			value = Color(share, 0.5, 0.25)
		TYPE_VECTOR3:
			value = Vector3(share, 2.0, 3.0)
		TYPE_OBJECT:
			value = _texture
		TYPE_INT:
			value = 1 if usual == 0 else 0
	if property["hint"] == PROPERTY_HINT_RANGE:
		var limits := _numbers(property)
		value = lerpf(limits[0], minf(limits[1], 100.0), 0.1 + 0.8 * share)
		value = int(value) if property["type"] == TYPE_INT else snappedf(value, 0.01)
	return value


func _add_meshes(root: Node) -> Array[Material]:
	var materials: Array[Material] = [LobeMaterial3D.new(), StandardMaterial3D.new()]
	for i in 2:
		var mesh := MeshInstance3D.new()
		mesh.name = ["Ours", "Godots"][i]
		mesh.mesh = BoxMesh.new()
		mesh.material_override = materials[i]
		root.add_child(mesh)
	return materials


func _expect_equal(materials: Array, name: String, what: String) -> void:
	var first: Variant = (materials[0] as Material).get(name)
	var second: Variant = (materials[1] as Material).get(name)
	var is_equal: bool = first == second
	if first is float and second is float:
		is_equal = is_equal_approx(first, second)
	var message := "%s %s: %s, Godot's %s" % [what, name, first, second]
	assert_bool(is_equal).append_failure_message(message).is_true()


func _is_shown(material: Material, name: String) -> bool:
	for property in material.get_property_list():
		if property["name"] == name:
			return property["usage"] & PROPERTY_USAGE_EDITOR != 0
	return false
