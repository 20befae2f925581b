extends SceneTree
## `./dev compare`: one sphere drawn by several methods and by the reference integrator.
##
## Writes reference.exr, reference_error.exr, <method>.exr and plan.json, which says what was drawn
## and how; tools/compare/metrics.py turns them into figures and pictures.

const OPTIONS: PackedStringArray = [
	"env",
	"brdf",
	"alpha",
	"methods",
	"size",
	"samples",
	"filter",
	"coverage",
	"views",
	"bias",
	"timing-rounds",
	"out",
]
const LEAST_SIZE := 8
const LARGEST_SIZE := 2048
## Rounds in which the GPU time of every method is measured once.
const TIMING_ROUNDS := 15
const MOST_TIMING_ROUNDS := 10000

var _arguments := CommandLine.new("compare", OPTIONS)
var _brdf: String
var _alpha: PackedFloat64Array
var _names: PackedStringArray
var _size: int
var _timing_rounds: int
var _out: String
var _stage := ComparisonStage.new(self)


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	_read_arguments()
	if _arguments.error.is_empty():
		var panorama := NativeLibrary.load_panorama(_arguments.path("env"))
		_arguments.fail_if(panorama.get("error", ""))
		if _arguments.error.is_empty():
			_stage.panorama = _panorama_texture(panorama)
	var methods: Array[ComparisonMethod] = []
	if _arguments.error.is_empty():
		methods = await _prepare()
	if _arguments.error.is_empty():
		await _compare(methods)
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	_stage = null
	quit(0 if _arguments.error.is_empty() else 1)


func _read_arguments() -> void:
	_arguments.required("env")
	_arguments.required("brdf")
	_brdf = _arguments.brdf("brdf")
	_alpha = _arguments.numbers("alpha", 2, PackedFloat64Array())
	_arguments.required("alpha")
	_names = _arguments.required("methods").split(",", false)
	_size = _arguments.integer("size", 256, LEAST_SIZE, LARGEST_SIZE)
	_timing_rounds = _arguments.integer("timing-rounds", TIMING_ROUNDS, 0, MOST_TIMING_ROUNDS)
	_stage.filter = _arguments.text("filter", _stage.filter)
	if _stage.filter not in ComparisonStage.FILTERS:
		_arguments.fail("--filter is %s." % " or ".join(ComparisonStage.FILTERS.keys()))
	_stage.fis_bias = _arguments.numbers("bias", 1, [_stage.fis_bias])[0]
	_stage.toral_coverage = _arguments.numbers("coverage", 1, [_stage.toral_coverage])[0]
	if not (_stage.toral_coverage > 0.0 and _stage.toral_coverage < 1.0):
		_arguments.fail("--coverage must be between 0 and 1, not %s." % _arguments.text("coverage"))
	var views := _arguments.numbers("views", 2, [0.0, 0.0])
	_stage.toral_views = Vector2i(int(views[0]), int(views[1]))
	if Vector2(_stage.toral_views) != Vector2(views[0], views[1]):
		_arguments.fail("--views takes whole numbers, not %s." % _arguments.text("views"))
	_arguments.required("out")
	_out = _arguments.path("out")
	for method in _names:
		_arguments.fail_if(CompareMethods.error(method))
		if _names.count(method) > 1:
			_arguments.fail("method %s is named twice." % method)
	_arguments.fail_if(NativeLibrary.error())


## The methods that are drawn, ready for it; not all of them where one has failed.
func _prepare() -> Array[ComparisonMethod]:
	var methods: Array[ComparisonMethod] = []
	for name in _names:
		if name == CompareMethods.REFERENCE or not _arguments.error.is_empty():
			continue
		var method := CompareMethods.make(name, _brdf, _alpha)
		_arguments.fail_if(await method.prepare(_stage))
		methods.append(method)
	return methods


func _compare(methods: Array[ComparisonMethod]) -> void:
	var reference := await ReferenceCache.render(_reference_options(), self)
	if reference.has("error"):
		_arguments.fail(reference["error"])
		return
	if DirAccess.make_dir_recursive_absolute(_out) != OK:
		_arguments.fail("%s: the folder cannot be made." % _out)
		return
	_save("reference", reference["pixels"])
	_save("reference_error", reference["standard_error"])
	var viewports := await _draw(methods)
	var times := await _measure(viewports)
	var plan := {
		"env": _arguments.path("env"),
		"brdf": _brdf,
		"alpha": Array(_alpha),
		"size": _size,
		"renderer": RenderingServer.get_current_rendering_method(),
		"driver": RenderingServer.get_video_adapter_name(),
		"reference_samples": reference["samples"],
		"methods": _entries(methods, times),
	}
	_arguments.fail_if(AtomicFile.save_json(plan, _out.path_join("plan.json")))


## What plan.json says of each method, in the order of the command line.
func _entries(
	methods: Array[ComparisonMethod], times: Dictionary[String, PackedFloat32Array]
) -> Array[Dictionary]:
	var entries: Array[Dictionary] = []
	for name in _names:
		var entry := {"method": name, "fetches": 0, "probes": 0, "table_fetches": 0}
		for method in methods:
			if method.name == name:
				entry.merge(method.cost(), true)
				entry["settings"] = method.settings()
		entry["gpu_ms_rounds"] = Array(times.get(name, PackedFloat32Array()))
		entries.append(entry)
	return entries


func _reference_options() -> Dictionary:
	var options := {
		"env": _arguments.path("env"), "brdf": _brdf, "alpha": Array(_alpha), "size": _size
	}
	if _arguments.has("samples"):
		options["samples"] = _arguments.integer("samples", 0, 2, 1 << 20)
	return options


## Draws every method's picture and saves it; returns the viewports, by the methods' names.
func _draw(methods: Array[ComparisonMethod]) -> Dictionary[String, LinearViewport]:
	var viewports: Dictionary[String, LinearViewport] = {}
	for method in methods:
		var viewport := LinearViewport.new(_size)
		root.add_child(viewport)
		viewport.add_child(method.make_sphere())
		viewports[method.name] = viewport
		# Drivers compile in the background: the first frames may lack the material.
		await viewport.measure_gpu_time(2)
		var picture := await viewport.capture()
		picture.convert(Image.FORMAT_RGBF)
		_save(method.name, picture.get_data().to_float32_array())
	return viewports


## GPU milliseconds of every method, one a round: all of them in each round, so that what disturbs
## the machine disturbs all of them alike. Empty where the driver gives no times.
func _measure(
	viewports: Dictionary[String, LinearViewport]
) -> Dictionary[String, PackedFloat32Array]:
	var times: Dictionary[String, PackedFloat32Array] = {}
	if viewports.is_empty() or _timing_rounds == 0:
		return times
	for name: String in viewports:
		times[name] = PackedFloat32Array()
	var line := ProgressLine.new("timing")
	for round_index in _timing_rounds:
		line.show(float(round_index) / _timing_rounds)
		for name: String in viewports:
			var samples := await viewports[name].measure_gpu_time(3, 3)
			if not samples.is_empty():
				times[name].append(LinearViewport.median(samples))
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
