extends SceneTree
## The engine's half of `./dev stability`: runs the shaders on rows of numbers.
##
## `-- --jobs FILE --out FOLDER`. FILE is JSON, which tools/stability/probes.py writes: textures,
## probes, passes and pyramids; the files that it names lie beside it. Each probe's results become
## NAME.bin, 32-bit floats as the shader has them, row by row; a pass' pixels NAME.bin, half floats
## or bytes; each pyramid's levels NAME.LEVEL.bin, atlases of half floats.

const CanvasPass := preload("res://addons/lobelight/runtime/pyramid/canvas_pass.gd")
# By its path: this runs in projects that have not been imported, which know no class names.
const Light := preload("res://addons/lobelight/runtime/light/lobe_light.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const HalvesShader := preload("res://bake/stability/halves.gdshader")

const OPTIONS: PackedStringArray = ["jobs", "out"]
## As in probe.gdshaderinc.
const ROWS := 64
const CODE := """shader_type canvas_item;
render_mode unshaded, blend_disabled;
%s
#include "{root}bake/stability/probe.gdshaderinc"
#include "{root}bake/stability/probes/{probe}.gdshaderinc"
"""
## Passes that are drawn in one frame.
const PASSES := 32

var _folder: String
var _out: String
var _textures: Dictionary[String, Texture] = {}
var _shaders: Dictionary[String, Shader] = {}
var _error := ""


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var words := OS.get_cmdline_user_args()
	if words.size() != 4 or words[0] != "--jobs" or words[2] != "--out":
		_fail("usage: --jobs FILE --out FOLDER")
	else:
		_folder = words[1].get_base_dir()
		_out = words[3]
		var text := FileAccess.get_file_as_string(words[1])
		var all: Variant = JSON.parse_string(text)
		if all is Dictionary:
			await _run_all(all)
		else:
			_fail("%s is no JSON" % words[1])
	if not _error.is_empty():
		printerr("stability: " + _error)
	quit(0 if _error.is_empty() else 1)


func _run_all(all: Dictionary) -> void:
	var textures: Dictionary = all["textures"]
	for name: String in textures:
		_textures[name] = _make_texture(textures[name])
	var probes: Array = all["probes"]
	for first in range(0, probes.size(), PASSES):
		await _run_probes(probes.slice(first, first + PASSES))
	for values: Dictionary in all["passes"]:
		await _run_pass(values)
	for pyramid: Dictionary in all["pyramids"]:
		await _run_pyramid(pyramid)


func _run_probes(probes: Array) -> void:
	var passes: Array[CanvasPass] = []
	for probe: Dictionary in probes:
		passes.append(_start(probe))
	await RenderingServer.frame_post_draw
	for n in probes.size():
		var probe: Dictionary = probes[n]
		var image := RenderingServer.texture_2d_get(passes[n].get_texture())
		if image == null or image.get_format() != Image.FORMAT_RGBA8:
			_fail("%s: its results cannot be read back" % probe["name"])
			return
		var size: int = 4 * int(probe["rows"]) * int(probe["results"])
		_write("%s.bin" % probe["name"], image.get_data().slice(0, size))


func _start(probe: Dictionary) -> CanvasPass:
	# The engine draws no viewport that is one pixel high.
	var lines := maxi(ceili(float(probe["rows"]) / ROWS), 2)
	var texels: int = probe["texels"]
	var extent := Vector2i(ROWS * int(probe["results"]), lines)
	var input := _read_image(probe["input"], Vector2i(ROWS * texels, lines), Image.FORMAT_RGBAF)
	var texture := ImageTexture.create_from_image(input)
	_textures[probe["name"]] = texture
	var parameters: Dictionary[StringName, Variant] = {
		&"probe_input": texture.get_rid(), &"probe_extent": extent
	}
	var used: Dictionary = probe["textures"]
	for name: String in used:
		parameters[StringName(name)] = _textures[used[name]].get_rid()
	var uniforms: Dictionary = probe["uniforms"]
	for name: String in uniforms:
		parameters[StringName(name)] = _to_uniform(uniforms[name])
	var drawn := CanvasPass.new(extent, false)
	var material := drawn.add_rect(Rect2i(Vector2i.ZERO, extent), _get_shader(probe), parameters)
	if probe.has("light"):
		_make_light(probe["light"]).apply(material)
	drawn.draw()
	return drawn


func _get_shader(probe: Dictionary) -> Shader:
	var defines := PackedStringArray()
	defines.append("#define PROBE_TEXELS %d" % int(probe["texels"]))
	defines.append("#define PROBE_RESULTS %d" % int(probe["results"]))
	for define: String in probe["defines"]:
		defines.append("#define " + define)
	var code := (CODE % "\n".join(defines)).format(probe)
	if not _shaders.has(code):
		var shader := Shader.new()
		shader.code = code
		_shaders[code] = shader
	return _shaders[code]


# The light of a cube map as the run time hands it to materials.
func _make_light(values: Dictionary) -> Light:
	var light := Light.new()
	light.cubemap = _textures[values["cube"]]
	light.size = values["size"]
	light.level_variance = values["level_variance"]
	light.base_variance = values["base_variance"]
	light.is_even = values["is_even"]
	light.rotation = _to_uniform(values["rotation"])
	light.energy = values["energy"]
	return light


# One of the pyramid's shaders by itself.
func _run_pass(values: Dictionary) -> void:
	var path := "%saddons/lobelight/runtime/%s.gdshader"
	var shader: Shader = load(path % [values["root"], values["shader"]])
	var parameters: Dictionary[StringName, Variant] = {}
	var used: Dictionary = values["textures"]
	for name: String in used:
		parameters[StringName(name)] = _textures[used[name]].get_rid()
	var integers: Dictionary = values["integers"]
	for name: String in integers:
		var numbers: Array = integers[name]
		var first := int(numbers[0])
		parameters[StringName(name)] = (
			first if numbers.size() == 1 else Vector2i(first, int(numbers[1]))
		)
	var extent := Vector2i(int(values["width"]), int(values["height"]))
	var drawn := CanvasPass.new(extent, values["half"])
	drawn.add_rect(Rect2i(Vector2i.ZERO, extent), shader, parameters)
	drawn.draw()
	await RenderingServer.frame_post_draw
	await _write_pixels("%s.bin" % values["name"], drawn, extent, values["half"])


func _run_pyramid(values: Dictionary) -> void:
	# Untyped: the script may be a copy.
	var script: GDScript = load(values["root"] + "addons/lobelight/runtime/pyramid/pyramid.gd")
	var pyramid: Object = script.new()
	var size: int = values["size"]
	var filter: int = values["filter"]
	pyramid.set_up_panorama(_textures[values["panorama"]], size, filter, values["as_sky"])
	pyramid.draw()
	await RenderingServer.frame_post_draw
	var levels: Array = pyramid.levels
	for level in levels.size():
		var extent := (size >> level) * Vector2i(Pyramid.COLUMNS, Pyramid.ROWS)
		await _write_pixels("%s.%d.bin" % [values["name"], level], levels[level], extent, true)


# The pixels of a pass that has been drawn: bytes, or half floats by way of their bits.
func _write_pixels(name: String, drawn: RefCounted, extent: Vector2i, half: bool) -> void:
	var read := drawn
	if half:
		extent.x *= 2
		read = CanvasPass.new(extent, false)
		var parameters: Dictionary[StringName, Variant] = {
			&"picture": drawn.get_texture(), &"extent": extent
		}
		read.add_rect(Rect2i(Vector2i.ZERO, extent), HalvesShader, parameters)
		read.draw()
		await RenderingServer.frame_post_draw
	var image := RenderingServer.texture_2d_get(read.get_texture())
	if image == null or image.get_format() != Image.FORMAT_RGBA8 or image.get_size() != extent:
		_fail("%s: its pixels cannot be read back" % name)
		return
	_write(name, image.get_data())


# 2D, 3D and cube textures; the levels and layers of the latter two lie one after the other.
func _make_texture(values: Dictionary) -> Texture:
	var size := Vector2i(int(values["width"]), int(values["height"]))
	var format := Image.FORMAT_RGBAF if values["float"] else Image.FORMAT_RGBAH
	var layers: int = values["layers"]
	if layers == 1:
		return ImageTexture.create_from_image(_read_image(values["file"], size, format))
	var mipmaps: bool = values["kind"] == "cube" and values["mipmaps"]
	var data := FileAccess.get_file_as_bytes(_folder.path_join(values["file"]))
	@warning_ignore("integer_division")
	var step := data.size() / layers
	var images: Array[Image] = []
	for layer in layers:
		var part := data.slice(layer * step, (layer + 1) * step)
		images.append(Image.create_from_data(size.x, size.y, mipmaps, format, part))
	if values["kind"] == "cube":
		var cube := Cubemap.new()
		cube.create_from_images(images)
		return cube
	var volume := ImageTexture3D.new()
	volume.create(format, size.x, size.y, layers, false, images)
	return volume


func _read_image(file: String, size: Vector2i, format: Image.Format) -> Image:
	var data := FileAccess.get_file_as_bytes(_folder.path_join(file))
	return Image.create_from_data(size.x, size.y, false, format, data)


# Numbers become a float, a vector, or a matrix whose columns they are.
func _to_uniform(v: Array) -> Variant:
	match v.size():
		1:
			return float(v[0])
		2:
			return Vector2(v[0], v[1])
		3:
			return Vector3(v[0], v[1], v[2])
		4:
			return Vector4(v[0], v[1], v[2], v[3])
	return Basis(Vector3(v[0], v[1], v[2]), Vector3(v[3], v[4], v[5]), Vector3(v[6], v[7], v[8]))


func _write(name: String, data: PackedByteArray) -> void:
	var file := FileAccess.open(_out.path_join(name), FileAccess.WRITE)
	if file == null or not file.store_buffer(data):
		_fail("%s cannot be written" % _out.path_join(name))


func _fail(sentence: String) -> void:
	if _error.is_empty():
		_error = sentence
