extends Node
## Where the suites of `./dev compare`'s methods draw them: a stage, a viewport for each picture,
## and a map of lamps with its reference.

const Kit := preload("render_kit.gd")
const ComparatorKit := preload("comparator_kit.gd")
const Stock := preload("res://bake/comparators/stock.gd")
const SIDE := ComparatorKit.SIDE

var stage: ComparisonStage
## The map's file, see [method ComparatorKit.save_lamps].
var lamps: String
## Of the picture that was drawn last.
var view: LinearViewport


## [param folder] is for the map.
func _init(folder: String) -> void:
	lamps = folder.path_join("lamps.exr")
	assert(ComparatorKit.save_lamps(lamps).is_empty(), "the map of lamps cannot be saved")


func _ready() -> void:
	stage = ComparisonStage.new(get_tree())
	_renew_view()


## From now on the lamps light what is drawn.
func light_lamps() -> void:
	stage.panorama = ComparatorKit.load_panorama(lamps)


## The method with this name, for widths [param x] and [param y].
func make(title: String, brdf: String, x: float, y: float) -> ComparisonMethod:
	return CompareMethods.make(title, brdf, PackedFloat64Array([x, y]))


## The method's picture, three floats a pixel; empty if it cannot be prepared. To be awaited.
func drawn(method: ComparisonMethod) -> PackedFloat32Array:
	var problem := await method.prepare(stage)
	if not problem.is_empty():
		push_error(problem)
		return PackedFloat32Array()
	return await captured(method)


## As [method drawn], of a method that is prepared. To be awaited.
func captured(method: ComparisonMethod) -> PackedFloat32Array:
	# A method may have changed the last one.
	_renew_view()
	view.add_child(method.make_sphere())
	method.set_up_viewport(view)
	# Skies take some frames.
	if method is Stock:
		await view.measure_gpu_time(2)
	return await pixels()


## What [member view] shows, three floats a pixel. To be awaited.
func pixels() -> PackedFloat32Array:
	var image := await view.capture()
	image.convert(Image.FORMAT_RGBF)
	return image.get_data().to_float32_array()


## The reference of the lamps, three floats a pixel; empty, with an error, if it fails.
func reference(brdf: String, x: float, y: float) -> PackedFloat32Array:
	var options := {"env": lamps, "brdf": brdf, "alpha": [x, y], "size": SIDE, "samples": 1024}
	var result: Dictionary = NativeLibrary.create(&"LobeReference").call("render_sphere", options)
	if result.has("error"):
		push_error(result["error"])
	return result.get("pixels", PackedFloat32Array())


func _renew_view() -> void:
	if view != null:
		view.free()
	view = LinearViewport.new(SIDE)
	add_child(view)
