@tool
extends RefCounted
## From a source of light to a cube map: six views where there are any, the levels of the pyramid,
## and the cube that takes them.
##
## An update is drawn in one frame, or in slices of one frame each: the views, levels 0 and 1, the
## other levels, and in Compatibility the faces that are read back. The cube map changes with the
## last slice. Updates allocate nothing on the GPU.

const FaceViews := preload("face_views.gd")
const OnDemand := preload("../on_demand.gd")
const Pyramid := preload("pyramid.gd")
const PyramidCube := preload("pyramid_cube.gd")

const _GPU_CUBE := "res://addons/lobelight/runtime/rendering_device/gpu_cube.gd"
const _PACKED_CUBE := "res://addons/lobelight/runtime/compatibility/packed_cube.gd"

# The engine tells some frames later what drawing a viewport took, and only if it draws it in that
# frame as well.
const _CLOCK_FRAMES := 8

## Null if the light comes from a panorama.
var views: FaceViews
var pyramid := Pyramid.new()
var cube: PyramidCube
## Milliseconds that the processor spent on the last update's transfer to the cube map.
var transfer_time := 0.0

var _is_measured := false
# Frames in which the last update is still to be drawn again for the clock's sake.
var _clock_frames := 0


func _init(drawn_views: FaceViews = null) -> void:
	views = drawn_views


## Why there can be no cube map in this export; empty if there can.
static func find_loss() -> String:
	if _stays_on_gpu():
		return OnDemand.find_loss(_GPU_CUBE, OnDemand.RENDERING_DEVICE)
	return OnDemand.find_loss(_PACKED_CUBE, OnDemand.COMPATIBILITY)


## To be called once the pyramid has been set up.
func make_cube() -> void:
	var script: GDScript
	if _stays_on_gpu():
		script = OnDemand.fetch(_GPU_CUBE, OnDemand.RENDERING_DEVICE)
	else:
		script = OnDemand.fetch(_PACKED_CUBE, OnDemand.COMPATIBILITY)
	cube = script.new(pyramid.size, pyramid.levels)


## Frames that an update takes if it is spread over frames.
func get_slices() -> int:
	var faces := 6 if views != null else 0
	# What is not read back is taken with the last levels.
	return faces + (2 if cube.slices == 1 else 2 + cube.slices)


## Has a slice of an update drawn in the next frame; all of it if [param slice] is negative.
func draw(slice: int) -> void:
	var faces := 6 if views != null else 0
	for face in faces:
		if slice == face or slice < 0:
			views.draw(face)
	if slice < 0:
		pyramid.draw()
	elif slice == faces:
		pyramid.draw(0, 1)
	elif slice == faces + 1:
		pyramid.draw(2)
	for part in cube.slices:
		if slice == faces + 2 + part or slice < 0:
			cube.draw(part)


## After the frame: takes what the slice has drawn. False if nothing was drawn.
func receive(slice: int) -> bool:
	var start := Time.get_ticks_usec()
	var first := get_slices() - cube.slices
	if slice <= first:
		transfer_time = 0.0
	var received := true
	for part in cube.slices:
		if slice == first + part or slice < 0:
			received = cube.receive(part) and received
	transfer_time += 0.001 * (Time.get_ticks_usec() - start)
	# All of it takes what its slices take, so that these need not be measured each time.
	if _is_measured and (slice < 0 or slice == get_slices() - 1 and get_gpu_time() == 0.0):
		_clock_frames = _CLOCK_FRAMES
	return received


## Has the renderer measure what the draws take.
func measure() -> void:
	_is_measured = true
	for viewport in _get_viewports():
		RenderingServer.viewport_set_measure_render_time(viewport, true)


## Whether an update's time is still to come, and nothing else should be drawn before.
func awaits_clock() -> bool:
	return _clock_frames > 0


## Has the last update drawn again in the next frame if its time is still to come; whether it has.
func draw_for_clock() -> bool:
	if _clock_frames == 0:
		return false
	_clock_frames -= 1
	draw(-1)
	return true


## Milliseconds of the GPU for an update, as last measured; it comes some frames late.
func get_gpu_time() -> float:
	var time := 0.0
	for viewport in _get_viewports():
		time += RenderingServer.viewport_get_measured_render_time_gpu(viewport)
	return time


# Whether the renderer can copy into cube maps.
static func _stays_on_gpu() -> bool:
	return RenderingServer.get_rendering_device() != null


func _get_viewports() -> Array[RID]:
	var viewports: Array[RID] = []
	if views != null:
		viewports.append_array(views.viewports)
	for level in pyramid.levels:
		viewports.append(level.viewport)
	viewports.append_array(cube.get_viewports())
	return viewports
