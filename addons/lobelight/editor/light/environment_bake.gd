@tool
extends RefCounted
## Makes the light that a [LobeEnvironment3D] is to show baked: that of its panorama by the native
## library, and that of a sky or a capture on the editor's GPU, as the node would draw it live.

const LightSettings := preload("../../runtime/light/light_settings.gd")
const LiveLight := preload("../../runtime/live/live_light.gd")
const NativeLibrary := preload("../bake/native_library.gd")
const PanoramaFile := preload("../import/panorama_file.gd")
const PanoramaFilter := preload("panorama_filter.gd")
const Pyramid := preload("../../runtime/pyramid/pyramid.gd")

# After so many frames a search for sources is believed to have none.
const _MOST_FRAMES := 16

var _task: RefCounted


## A light without a place, or a sentence that says why there is none. To be awaited; after
## [method cancel] it is any of the two.
func make(environment: LobeEnvironment3D) -> Variant:
	var source := LightSettings.decide(
		environment.source as LightSettings.Source, environment.panorama != null
	)
	var is_by_library := (
		source == LightSettings.Source.PANORAMA
		and environment.panorama != null
		and Pyramid.is_round(environment.filter as Pyramid.Filter)
		and NativeLibrary.is_loaded()
	)
	if is_by_library:
		return await _filter(environment)
	return await _draw(environment)


## The light that is being made is not wanted any more.
func cancel() -> void:
	if _task != null:
		_task.call(&"cancel")


## From 0 to 1, as far as it is known.
func get_progress() -> float:
	return _task.call(&"get_progress") if _task != null else 0.0


func _filter(environment: LobeEnvironment3D) -> Variant:
	var kernel := environment.filter as Pyramid.Filter
	# Its texture ends at 65504.
	var request := PanoramaFile.make_request(environment.panorama, environment.size, kernel)
	if request.is_empty():
		var image := environment.panorama.get_image()
		if image == null or image.is_empty():
			return (
				"The panorama's texels cannot be read: take another texture, or import its file "
				+ "again."
			)
		request = PanoramaFilter.make_request(image, environment.size, kernel)
	request["max_sources"] = environment.max_sources
	var file := environment.panorama.resource_path
	_task = NativeLibrary.create(&"LobeLightFilter")
	if _task.call(&"start", request):
		var tree := Engine.get_main_loop() as SceneTree
		while _task.call(&"is_running"):
			await tree.process_frame
	var error: String = _task.call(&"get_error")
	var result: Dictionary = _task.call(&"get_result")
	_task = null
	if result.is_empty():
		return error if error else "The bake was cancelled."
	for warning: String in result["warnings"]:
		push_warning("%s: %s." % [file if file else "The panorama", warning])
	return PanoramaFilter.make_light(request, result)


func _draw(environment: LobeEnvironment3D) -> Variant:
	var settings := LightSettings.new()
	settings.node = environment
	settings.source = environment.source as LightSettings.Source
	settings.panorama = environment.panorama
	settings.on_panorama_changed = func() -> void: pass
	settings.filter = environment.filter
	settings.size = environment.size
	settings.max_sources = environment.max_sources
	settings.capture.cull_mask = environment.capture_cull_mask
	settings.capture.near = environment.capture_near
	settings.capture.far = environment.capture_far
	var drawing := LiveLight.new(settings, func(_is_other: bool) -> void: pass)
	var is_drawn: bool = await drawing.rebuild()
	if is_drawn and _finds_sources(drawing):
		is_drawn = await drawing.rebuild()
	var error := drawing.error
	var drawn := drawing.light
	var faces: Array[Image] = []
	var sources: PackedFloat32Array = []
	if is_drawn:
		drawing.place()
		faces = drawn.faces if drawing.chain == null else drawing.chain.cube.get_faces()
		sources = _read_sources(drawn)
		if drawn.sources != null and sources.is_empty():
			faces = []
	drawing.end()
	if faces.is_empty():
		return error if error else "The light could not be read back from the GPU."
	var light := LobeLight.new()
	light.faces = faces
	light.size = drawn.size
	light.level_variance = drawn.level_variance
	light.base_variance = drawn.base_variance
	light.is_even = drawn.is_even
	light.source_texels = sources
	light.is_of_world = not settings.takes_panorama()
	if light.is_of_world:
		light.axes = drawn.rotation
	light.base_energy = drawn.energy
	return light


# Whether there are sources in the light that the next update takes out. An editor in which nothing
# moves draws no frames, which the answer comes with.
static func _finds_sources(drawing: LiveLight) -> bool:
	var chain := drawing.chain
	if chain == null:
		return false
	for frame in _MOST_FRAMES:
		if not drawing.source.awaits_search(chain):
			break
		RenderingServer.force_draw(false)
	return drawing.source.follow_search(chain)


# Of a light on the GPU; none where it has none, or where they cannot be read.
static func _read_sources(light: LobeLight) -> PackedFloat32Array:
	var image: Image = null
	if light.sources != null:
		image = RenderingServer.texture_2d_get(light.sources.get_rid())
	if image == null or image.is_empty():
		return []
	image.convert(Image.FORMAT_RGBAF)
	return image.get_data().to_float32_array()
