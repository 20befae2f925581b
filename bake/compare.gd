extends SceneTree
## `./dev compare`: one sphere drawn by several methods and by the reference integrator.
##
## Writes reference.exr, reference_error.exr, <method>.exr and plan.json; tools/compare/metrics.py
## turns them into figures and pictures.

const OPTIONS: PackedStringArray = [
	"env", "brdf", "alpha", "methods", "size", "samples", "filter", "out"
]
const LEAST_SIZE := 8
const LARGEST_SIZE := 2048
const FILTERS: Dictionary[String, LobeEnvironment3D.Filter] = {
	"box": LobeEnvironment3D.Filter.BOX,
	"binomial": LobeEnvironment3D.Filter.BINOMIAL,
	"gaussian": LobeEnvironment3D.Filter.GAUSSIAN,
}
## Rounds in which every method is drawn once for its GPU time; the median is kept.
const TIMING_ROUNDS := 15

var _arguments := CommandLine.new("compare", OPTIONS)
var _brdf: String
var _alpha: PackedFloat64Array
var _methods: PackedStringArray
var _size: int
var _out: String


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	_read_arguments()
	var panorama := {}
	if _arguments.error.is_empty():
		panorama = NativeLibrary.load_panorama(_arguments.path("env"))
		_arguments.fail_if(panorama.get("error", ""))
	var tables: Dictionary[String, LobeTable] = {}
	if _arguments.error.is_empty():
		tables = await _bake_tables()
	if _arguments.error.is_empty():
		await _compare(panorama, tables)
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _read_arguments() -> void:
	_arguments.required("env")
	_brdf = _arguments.required("brdf")
	_alpha = _arguments.numbers("alpha", 2, PackedFloat64Array())
	_arguments.required("alpha")
	_methods = _arguments.required("methods").split(",", false)
	_size = _arguments.integer("size", 256, LEAST_SIZE, LARGEST_SIZE)
	if _arguments.text("filter", "gaussian") not in FILTERS:
		_arguments.fail("--filter is %s." % " or ".join(FILTERS.keys()))
	_arguments.required("out")
	_out = _arguments.path("out")
	for method in _methods:
		_arguments.fail_if(CompareMethods.error(method))
		if _methods.count(method) > 1:
			_arguments.fail("method %s is named twice." % method)
	_arguments.fail_if(NativeLibrary.error())


func _bake_tables() -> Dictionary[String, LobeTable]:
	var tables: Dictionary[String, LobeTable] = {}
	for method in _methods:
		if CompareMethods.lobes(method) == 0 or not _arguments.error.is_empty():
			continue
		var recipe := {"brdf": _brdf, "alpha": Array(_alpha), "lobes": CompareMethods.lobes(method)}
		var result := await NativeLibrary.run(
			NativeLibrary.create(&"LobeBaker"), recipe, "baking %s" % method, self
		)
		if result.has("error"):
			_arguments.fail(result["error"])
		else:
			tables[method] = LobeTable.from_baked(result)
	return tables


func _compare(panorama: Dictionary, tables: Dictionary[String, LobeTable]) -> void:
	var reference := await ReferenceCache.render(_reference_options(), self)
	if reference.has("error"):
		_arguments.fail(reference["error"])
		return
	if DirAccess.make_dir_recursive_absolute(_out) != OK:
		_arguments.fail("%s: the folder cannot be made." % _out)
		return
	_save("reference", reference["pixels"])
	_save("reference_error", reference["standard_error"])
	var times := await _draw(panorama, tables)
	if not _arguments.error.is_empty():
		return
	var entries: Array[Dictionary] = []
	for method in _methods:
		var entry := CompareMethods.cost(method)
		entry["method"] = method
		entry["gpu_ms"] = times.get(method)
		entries.append(entry)
	var plan := {
		"env": _arguments.path("env"),
		"brdf": _brdf,
		"alpha": Array(_alpha),
		"size": _size,
		"renderer": RenderingServer.get_current_rendering_method(),
		"driver": RenderingServer.get_video_adapter_name(),
		"reference_samples": reference["samples"],
		"methods": entries,
	}
	_arguments.fail_if(AtomicFile.save_json(plan, _out.path_join("plan.json")))


func _reference_options() -> Dictionary:
	var options := {
		"env": _arguments.path("env"), "brdf": _brdf, "alpha": Array(_alpha), "size": _size
	}
	if _arguments.has("samples"):
		options["samples"] = _arguments.integer("samples", 0, 2, 1 << 20)
	return options


## Draws every method; returns the median GPU time of each in milliseconds.
func _draw(
	panorama: Dictionary, tables: Dictionary[String, LobeTable]
) -> Dictionary[String, float]:
	var medians: Dictionary[String, float] = {}
	if tables.is_empty():
		return medians
	var environment := LobeEnvironment3D.new()
	environment.panorama = _panorama_texture(panorama)
	environment.filter = FILTERS[_arguments.text("filter", "gaussian")]
	root.add_child(environment)
	if not await environment.rebuild():
		_arguments.fail(environment.get_rebuild_error())
		return medians
	var viewports: Dictionary[String, LinearViewport] = {}
	for method: String in tables:
		var viewport := LinearViewport.new(_size)
		root.add_child(viewport)
		viewport.add_child(SphereImpostor.make(tables[method]))
		viewports[method] = viewport
		# Drivers compile in the background: the first frames may lack the material.
		await viewport.measure_gpu_time(2)
		var picture := await viewport.capture()
		picture.convert(Image.FORMAT_RGBF)
		_save(method, picture.get_data().to_float32_array())
	var times := await _measure(viewports)
	for method: String in times:
		medians[method] = LinearViewport.median(times[method])
	return medians


# Every method once a round, so that what disturbs the machine disturbs all of them.
func _measure(
	viewports: Dictionary[String, LinearViewport]
) -> Dictionary[String, PackedFloat32Array]:
	var times: Dictionary[String, PackedFloat32Array] = {}
	var line := ProgressLine.new("timing")
	for round_index in TIMING_ROUNDS:
		line.show(float(round_index) / TIMING_ROUNDS)
		for method: String in viewports:
			var samples: PackedFloat32Array = times.get(method, PackedFloat32Array())
			samples.append_array(await viewports[method].measure_gpu_time(1, 1))
			times[method] = samples
	line.finish()
	return times


func _panorama_texture(panorama: Dictionary) -> ImageTexture:
	var pixels: PackedFloat32Array = panorama["pixels"]
	return ImageTexture.create_from_image(
		Image.create_from_data(
			panorama["width"], panorama["height"], false, Image.FORMAT_RGBF, pixels.to_byte_array()
		)
	)


func _save(title: String, pixels: PackedFloat32Array) -> void:
	_arguments.fail_if(NativeLibrary.save_exr(_out.path_join(title + ".exr"), _size, _size, pixels))
