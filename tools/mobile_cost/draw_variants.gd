extends SceneTree
## Draws the materials of variants.json one after the other, for a driver that prints or stores what
## it compiles; see engine.py.
##
## Arguments: [code]-- FOLDER NAME,NAME…[/code]. Says on stderr that a material is being drawn, and
## goes on once FOLDER has a file of the material's name. The environment's LOBELIGHT_VARIANTS names
## another file of variants.

const VARIANTS_PATH := "res://tools/mobile_cost/variants.json"
# Unlike all variants: drivers compile what they know no second time.
const WARM_UP := "shader_type spatial; void fragment() { ALBEDO = vec3(0.1, 0.2, 0.3); }"
const MOST_MILLISECONDS := 120_000

var _sphere := MeshInstance3D.new()


func _initialize() -> void:
	_run.call_deferred()


func _run() -> void:
	var arguments := OS.get_cmdline_user_args()
	var folder := arguments[0]
	var path := OS.get_environment("LOBELIGHT_VARIANTS")
	var text := FileAccess.get_file_as_string(path if path else VARIANTS_PATH)
	var variants: Dictionary = JSON.parse_string(text)
	_build_scene()
	await _draw("warm_up", _make_shader(WARM_UP), folder)
	for name in arguments[1].split(","):
		var variant: Dictionary = variants[name]
		await _draw(name, _make_material(variant), folder)
	quit()


func _draw(name: String, material: Material, folder: String) -> void:
	_sphere.material_override = material
	printerr("mobile-cost: drawing %s" % name)
	var started := Time.get_ticks_msec()
	while not FileAccess.file_exists(folder.path_join(name)):
		await process_frame
		if Time.get_ticks_msec() - started > MOST_MILLISECONDS:
			printerr("mobile-cost: nobody took %s" % name)
			quit(1)


# One sphere under a sky, without lights: a driver that specialises pipelines leaves out what the
# engine has for lights, decals, fog and so on, so that the material is what remains.
func _build_scene() -> void:
	var surroundings := Environment.new()
	surroundings.background_mode = Environment.BG_SKY
	surroundings.sky = Sky.new()
	surroundings.sky.sky_material = PanoramaSkyMaterial.new()
	var camera := Camera3D.new()
	camera.environment = surroundings
	camera.position.z = 3.0
	root.add_child(camera)
	_sphere.mesh = SphereMesh.new()
	root.add_child(_sphere)


func _make_material(variant: Dictionary) -> Material:
	var material: Material
	match variant["kind"]:
		"standard":
			material = StandardMaterial3D.new()
		"lobes":
			material = LobeMaterial3D.new()
			material.set(&"metallic", 1.0)
			material.set(&"roughness", 0.4)
			# Without a table, the material takes those of the ready set.
			if variant.has("lobes"):
				material.set(&"table", _make_table(variant))
			if variant.get("sources", false):
				_light_with_sources(material as LobeMaterial3D)
			if variant.get("placed", false):
				material = _make_placed(material as LobeMaterial3D)
		"shader":
			material = _make_shader("\n".join(PackedStringArray(variant["code"] as Array)))
		"rival":
			material = _make_shader(_make_rival_code(variant))
	var properties: Dictionary = variant.get("properties", {})
	for property: String in properties:
		assert(property in material, property)
		material.set(property, _make_value(properties[property]))
	return material


func _light_with_sources(material: LobeMaterial3D) -> void:
	material.light = LobeLight.make_dark(true)
	material.light.sources = ImageTexture.create_from_image(
		Image.create_empty(4, 3, false, Image.FORMAT_RGBAF)
	)


# What the material becomes where there are probes.
func _make_placed(material: LobeMaterial3D) -> ShaderMaterial:
	var code := material.get_shader_code()
	var first := code.find("#define")
	return _make_shader(code.insert(first, "#define LOBELIGHT_PLACED\n"))


func _make_shader(code: String) -> ShaderMaterial:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = code
	return material


# The file bake/comparators/RIVAL.gdshaderinc has a function RIVAL_specular.
func _make_rival_code(variant: Dictionary) -> String:
	var code := "shader_type spatial;\nrender_mode ambient_light_disabled;\n"
	for define: String in variant["defines"]:
		code += "#define %s\n" % define
	code += '#include "res://bake/comparators/%s.gdshaderinc"\n' % variant["rival"]
	code += "#define RIVAL_SPECULAR %s_specular\n" % variant["rival"]
	return code + '#include "res://tools/mobile_cost/rival_material.gdshaderinc"\n'


# A table of no BRDF: how many lobes it has decides what the shader costs, and nothing else.
func _make_table(variant: Dictionary) -> LobeTable:
	var lobes: int = variant["lobes"]
	var azimuths: int = 1 if variant.get("isotropic", false) else 2
	var rows: int = lobes * azimuths * (2 if variant.get("coloured", false) else 1)
	var table := LobeTable.new()
	table.brdf = variant.get("brdf", "")
	table.lobe_count = lobes
	table.views = Vector2i(2, azimuths)
	table.image = Image.create_empty(2, rows, false, Image.FORMAT_RGBAH)
	return table


# JSON has no textures: "texture" stands for one.
func _make_value(value: Variant) -> Variant:
	if value is String and value == "texture":
		return ImageTexture.create_from_image(Image.create_empty(4, 4, false, Image.FORMAT_RGBA8))
	return value
