extends SceneTree
## `./dev bench light-formats`: what the formats of saved light cost in quality and in bytes; see
## tools/bench/light-formats.sh.

const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const LightFile := preload("res://addons/lobelight/editor/light/light_file.gd")
const PanoramaFilter := preload("res://addons/lobelight/editor/light/panorama_filter.gd")
const OPTIONS: PackedStringArray = ["env", "alphas", "formats", "lobes", "size", "json"]
const FORMATS: Dictionary[String, LightFormats.Format] = {
	"half": LightFormats.Format.HALF,
	"rgb9e5": LightFormats.Format.SHARED_EXPONENT,
	"bptc": LightFormats.Format.BPTC,
	"astc": LightFormats.Format.ASTC,
}
const DEFAULT_FORMATS := "half:512,rgb9e5:512,rgb9e5:256,bptc:512,astc:512"
const DEFAULT_ALPHAS := "0.01,0.02,0.05,0.1,0.2,0.5"
const BRDF := "ggx"
const MIDDLE_GREY := 0.18
# As ./dev compare counts pixels.
const MASK := 0.9995
const _LEAST := 4
const _MOST := 2048

var _arguments := CommandLine.new("bench light-formats", OPTIONS)
var _stage := ComparisonStage.new(self)
# By size, in half floats.
var _lights: Dictionary[int, LobeLight] = {}


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	_arguments.required("env")
	var json := _arguments.path("json") if _arguments.has("json") else ""
	var formats := _arguments.text("formats", DEFAULT_FORMATS).split(",")
	var alphas := _read_alphas()
	for format in formats:
		var parts := format.split(":")
		var size := parts[1].to_int() if parts.size() == 2 else 0
		if parts[0] not in FORMATS or size < _LEAST or size > _MOST or size != nearest_po2(size):
			_arguments.fail(
				(
					"--formats takes %s with a power of two as rgb9e5:256, not %s."
					% [", ".join(FORMATS.keys()), format]
				)
			)
	var lobes := _arguments.integer("lobes", 8, 1, 32)
	var size := _arguments.integer("size", 128, 8, 1024)
	_arguments.fail_if(NativeLibrary.error())
	if _arguments.error.is_empty():
		var rows := await _measure(_arguments.path("env"), alphas, formats, lobes, size)
		if _arguments.error.is_empty() and not json.is_empty():
			_arguments.fail_if(AtomicFile.save_json(rows, json))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _read_alphas() -> PackedFloat64Array:
	var texts := _arguments.text("alphas", DEFAULT_ALPHAS)
	var alphas := texts.split_floats(",")
	for alpha in alphas:
		if not (alpha >= 0.001 and alpha <= 1.0):
			_arguments.fail("--alphas must be numbers from 0.001 to 1, not %s." % texts)
	return alphas


func _measure(
	env: String, alphas: PackedFloat64Array, formats: PackedStringArray, lobes: int, size: int
) -> Array[Dictionary]:
	var rows: Array[Dictionary] = []
	var panorama := Comparison.load_panorama(env)
	if panorama.has("error"):
		_arguments.fail(panorama["error"])
		return rows
	var viewport := LinearViewport.new(size)
	root.add_child(viewport)
	var lights: Array[LobeLight] = []
	for format in formats:
		lights.append(_make_light((panorama["texture"] as Texture2D).get_image(), format))
	for alpha in alphas:
		var recipe := {"brdf": BRDF, "alpha": [alpha, alpha], "lobes": lobes}
		var baked := await _stage.bake(recipe, "%s %s" % [BRDF, alpha])
		var options := {"env": env, "brdf": BRDF, "alpha": [alpha, alpha], "size": size}
		var reference := await ResultCache.run(&"LobeReference", options, "integrating", self)
		for result: Dictionary in [baked, reference]:
			_arguments.fail_if(result.get("error", ""))
		if not _arguments.error.is_empty():
			break
		var exact: PackedFloat32Array = reference["pixels"]
		var first := PackedFloat32Array()
		for i in formats.size():
			var drawn := await _draw(viewport, baked["table"], lights[i])
			first = drawn if first.is_empty() else first
			var row := {
				"env": env.get_file(),
				"alpha": alpha,
				"lobes": lobes,
				"format": formats[i],
				"bytes": LightFile.count_bytes(lights[i]),
				"psnr": _psnr(drawn, exact, exact, size),
				"psnr_to_first": _psnr(drawn, first, exact, size),
			}
			print(
				(
					"%s, width %.3f: %-11s %8d bytes, %.2f dB; %.1f dB beside %s"
					% [
						row["env"],
						alpha,
						formats[i],
						row["bytes"],
						row["psnr"],
						row["psnr_to_first"],
						formats[0]
					]
				)
			)
			rows.append(row)
	viewport.free()
	return rows


func _make_light(image: Image, format: String) -> LobeLight:
	var parts := format.split(":")
	var size := parts[1].to_int()
	if not _lights.has(size):
		var request := PanoramaFilter.make_request(image, size)
		var filter := NativeLibrary.create(&"LobeLightFilter")
		_lights[size] = PanoramaFilter.make_light(request, filter.call(&"filter", request))
	var light: LobeLight = _lights[size].at_another_place()
	_arguments.fail_if(LightFormats.convert_light(light, FORMATS[parts[0]]))
	return light


func _draw(viewport: LinearViewport, table: LobeTable, light: LobeLight) -> PackedFloat32Array:
	var sphere := SphereImpostor.make(table)
	(sphere.mesh.surface_get_material(0) as LobeMaterial3D).light = light
	viewport.add_child(sphere)
	# Drivers compile in the background: the first frames may lack the material.
	for frame in 3:
		await viewport.capture()
	var picture := await viewport.capture()
	sphere.free()
	picture.convert(Image.FORMAT_RGBF)
	return picture.get_data().to_float32_array()


# As tools/compare/metrics.py: exposure by the median of `exact`, a power of 1 / 2.2.
static func _psnr(
	picture: PackedFloat32Array, expected: PackedFloat32Array, exact: PackedFloat32Array, size: int
) -> float:
	var means := PackedFloat32Array()
	var inside := PackedInt32Array()
	for row in size:
		for column in size:
			var x := (2.0 * column + 1.0) / size - 1.0
			var y := 1.0 - (2.0 * row + 1.0) / size
			if x * x + y * y < MASK:
				var at := 3 * (row * size + column)
				inside.append(at)
				means.append((exact[at] + exact[at + 1] + exact[at + 2]) / 3.0)
	var exposure := MIDDLE_GREY / LinearViewport.median(means)
	var sum := 0.0
	for at in inside:
		for channel in 3:
			var off := (
				pow(clampf(picture[at + channel] * exposure, 0.0, 1.0), 1.0 / 2.2)
				- pow(clampf(expected[at + channel] * exposure, 0.0, 1.0), 1.0 / 2.2)
			)
			sum += off * off
	return -10.0 * log(maxf(sum / (3 * inside.size()), 1e-12)) / log(10.0)
