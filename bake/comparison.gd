class_name Comparison
extends RefCounted
## One sphere drawn by several methods and by the reference integrator.
##
## Writes reference.exr, reference_error.exr, <method>.exr and plan.json, which says what was drawn
## and how; tools/compare/metrics.py turns them into figures and pictures.

const ComparisonSphere := preload("comparators/comparison_sphere.gd")
## Rounds in which the GPU time of every method is measured once.
const TIMING_ROUNDS := 15
## Pixels along the side where times are measured. What a renderer spends on any frame weighs less
## than on smaller ones.
const TIMING_SIZE := 256
# The name of the sphere that reflects nothing, among the measured ones; no method has it.
const _EMPTY := ""

## The absolute path of the panorama, or of the room, that [member stage] has.
var environment_path: String
var brdf: String
var alpha: PackedFloat64Array
## The methods, as [CompareMethods] knows them.
var names: PackedStringArray
## Pixels along the side.
var size := 256
## Of the reference, a pixel; 0 leaves it to the integrator.
var samples := 0
var timing_rounds := TIMING_ROUNDS
## Pixels along the side where times are measured, whatever [member size] is.
var timing_size := TIMING_SIZE
## The absolute path of the folder for the files.
var out: String
var stage: ComparisonStage
## Whether a method that cannot be drawn here is left out, its reason in plan.json's "unavailable";
## otherwise it is an error.
var tolerant := false

# Why methods were left out, by their names.
var _unavailable: Dictionary[String, String] = {}


## Draws, measures and writes. Returns one sentence on failure, otherwise empty. To be awaited.
func run() -> String:
	var methods: Array[ComparisonMethod] = []
	for name in names:
		if name == CompareMethods.REFERENCE:
			continue
		var failure := CompareMethods.error(name, stage.room != null)
		if failure.is_empty():
			var method := CompareMethods.make(name, brdf, alpha)
			method.room = stage.room
			failure = await method.prepare(stage)
			if failure.is_empty():
				methods.append(method)
		if not failure.is_empty():
			if not tolerant:
				return failure
			_unavailable[name] = failure
	return await _compare(methods)


## The panorama of a file as [member ComparisonStage.panorama] wants it, and what there is to say of
## it: {"texture", "remarks"} or {"error"}.
static func load_panorama(path: String) -> Dictionary:
	var panorama := NativeLibrary.load_panorama(path)
	if panorama.has("error"):
		return panorama
	var side := maxi(panorama["width"] as int, panorama["height"] as int)
	if side > NativeLibrary.LARGEST_TEXTURE:
		var text := "%s: has %d texels along a side; a texture holds %d"
		return {"error": text % [path, side, NativeLibrary.LARGEST_TEXTURE]}
	var remarks: PackedStringArray = []
	for remark: String in panorama["warnings"] + panorama["notes"]:
		remarks.append("%s: %s." % [path, remark])
	var pixels: PackedFloat32Array = panorama["pixels"]
	var image := Image.create_from_data(
		panorama["width"], panorama["height"], false, Image.FORMAT_RGBF, pixels.to_byte_array()
	)
	return {"texture": ImageTexture.create_from_image(image), "remarks": remarks}


func _compare(methods: Array[ComparisonMethod]) -> String:
	var reference := await ResultCache.run(
		&"LobeReference", _reference_options(), "integrating", stage.tree
	)
	if reference.has("error"):
		return reference["error"]
	if DirAccess.make_dir_recursive_absolute(out) != OK:
		return "%s: the folder cannot be made." % out
	var failure := _save("reference", reference["pixels"])
	if failure.is_empty():
		failure = _save("reference_error", reference["standard_error"])
	var viewports: Dictionary[String, LinearViewport] = {}
	for method in methods:
		if failure.is_empty():
			viewports[method.name] = _make_viewport(method)
			await method.settle(viewports[method.name])
			failure = await _draw(method, viewports[method.name])
	if failure.is_empty():
		if timing_rounds > 0:
			viewports[_EMPTY] = _make_empty_viewport()
		var times := await _measure(viewports)
		var plan := {
			"env": environment_path,
			"brdf": brdf,
			"alpha": Array(alpha),
			"size": size,
			"timing_size": timing_size,
			"renderer": RenderingServer.get_current_rendering_method(),
			"driver": RenderingServer.get_video_adapter_name(),
			"driver_type": RenderingServer.get_video_adapter_type(),
			"driver_version": RenderingServer.get_video_adapter_api_version(),
			"engine": Engine.get_version_info()["string"],
			"reference_samples": reference["samples"],
			"fixed_ms_rounds": Array(times.get(_EMPTY, PackedFloat32Array())),
			"methods": await _entries(methods, times),
			"unavailable": _unavailable,
		}
		failure = AtomicFile.save_json(plan, out.path_join("plan.json"))
	for name: String in viewports:
		viewports[name].free()
	return failure


## What plan.json says of each method, in the order of [member names].
func _entries(
	methods: Array[ComparisonMethod], times: Dictionary[String, PackedFloat32Array]
) -> Array[Dictionary]:
	var entries: Array[Dictionary] = []
	for name in names:
		if _unavailable.has(name):
			continue
		var entry := {"method": name, "fetches": 0, "probes": 0, "table_fetches": 0}
		for method in methods:
			if method.name == name:
				entry.merge(method.cost(), true)
				var settings := method.settings()
				# Methods with a map of their own have measured it themselves.
				if settings.has("pyramid") and timing_rounds > 0:
					settings.merge(await stage.update_cost(settings["pyramid"]))
				entry["settings"] = settings
		entry["gpu_ms_rounds"] = Array(times.get(name, PackedFloat32Array()))
		entries.append(entry)
	return entries


func _reference_options() -> Dictionary:
	var options := {"brdf": brdf, "alpha": Array(alpha), "size": size}
	if stage.room == null:
		options["env"] = environment_path
	else:
		options.merge(stage.room.get_reference_options())
	if samples > 0:
		options["samples"] = samples
	return options


func _make_viewport(method: ComparisonMethod) -> LinearViewport:
	var viewport := LinearViewport.new(size)
	method.choose_world(viewport)
	stage.tree.root.add_child(viewport)
	_add_sphere(viewport, method.make_sphere())
	method.set_up_viewport(viewport)
	return viewport


func _add_sphere(viewport: LinearViewport, sphere: MeshInstance3D) -> void:
	viewport.add_child(sphere)
	if stage.room != null:
		stage.room.place(viewport, sphere)


## The sphere as all methods draw it, but black: what the renderer takes for any frame and for the
## pixels of any material.
func _make_empty_viewport() -> LinearViewport:
	var viewport := LinearViewport.new(size)
	stage.tree.root.add_child(viewport)
	_add_sphere(viewport, ComparisonSphere.make("empty.gdshaderinc", "empty_specular", [], {}))
	return viewport


## Saves what a method's viewport shows. Returns one sentence on failure, otherwise empty.
func _draw(method: ComparisonMethod, viewport: LinearViewport) -> String:
	# Drivers compile in the background: the first frames may lack the material.
	await viewport.measure_gpu_time(2)
	var picture := await viewport.capture()
	picture.convert(Image.FORMAT_RGBF)
	var pixels := picture.get_data().to_float32_array()
	if method.energy != 1.0:
		for i in pixels.size():
			pixels[i] /= method.energy
	return _save(method.name, pixels)


## GPU milliseconds of every method at [member timing_size], one a round: all of them in each round,
## so that what disturbs the machine disturbs all alike. Empty where the driver gives no times.
func _measure(
	viewports: Dictionary[String, LinearViewport]
) -> Dictionary[String, PackedFloat32Array]:
	var times: Dictionary[String, PackedFloat32Array] = {}
	if timing_rounds == 0:
		return times
	for name: String in viewports:
		times[name] = PackedFloat32Array()
		viewports[name].size = Vector2i(timing_size, timing_size)
	var line := ProgressLine.new("timing")
	for round_index in timing_rounds:
		line.show(float(round_index) / timing_rounds)
		for name: String in viewports:
			var measured := await viewports[name].measure_gpu_time(3, 3)
			if not measured.is_empty():
				times[name].append(LinearViewport.median(measured))
	line.finish()
	return times


func _save(title: String, pixels: PackedFloat32Array) -> String:
	return NativeLibrary.save_exr(out.path_join(title + ".exr"), size, size, pixels)
