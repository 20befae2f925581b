@tool
extends RefCounted
## From a source of light to a cube map: six views where there are any, the levels of the pyramid,
## and the cube that takes them.
##
## An update is drawn in one frame, or in slices of one frame each, see
## [code]chain_slices.gd[/code]. The cube map changes with the last slice.

## How an update is spread over frames: not at all; drawn in one frame, but in Compatibility read
## back a face a frame; in slices.
enum Pace { WHOLE, FACE_BY_FACE, SLICED }

const ChainSlices := preload("chain_slices.gd")
const FaceViews := preload("face_views.gd")
const LightSearch := preload("light_search.gd")
const OnDemand := preload("../on_demand.gd")
const Pyramid := preload("pyramid.gd")
const PyramidCube := preload("pyramid_cube.gd")

const _GPU_CUBE := "res://addons/lobelight/runtime/rendering_device/gpu_cube.gd"
const _PACKED_CUBE := "res://addons/lobelight/runtime/compatibility/packed_cube.gd"

# Frames to wait for a measured time: the engine reports it some frames later, and only if the
# viewport is drawn in that frame, too.
const _CLOCK_FRAMES := 8
# The assumed speed of a GPU until it is measured, in fetches (Pyramid.count_fetches) a millisecond:
# that of a phone of 2013.
const _LEAST_SPEED := 0.4e6
# Shorter measured times count as this long, in milliseconds.
const _SHORTEST_TIME := 0.05

## Null if the light comes from a panorama.
var views: FaceViews
## What looks for sources, made before the pyramid is set up; null if nothing does.
var search: LightSearch
var pyramid := Pyramid.new()
var cube: PyramidCube
## Milliseconds that the processor spent on the last update's transfer to the cube map.
var transfer_time := 0.0

var _pace := Pace.SLICED
var _slices: Array[ChainSlices.Slice] = []
# Milliseconds of the GPU in which a slice is to be drawn; 0 for as long as it takes.
var _budget := 0.0
var _speed := _LEAST_SPEED
# The fetches of the finest level in its last draws.
var _drawn: PackedFloat64Array = []
var _is_measured := false
# Frames in which the last update is still to be drawn again so that its time is reported, and that
# time. An update in slices is measured as a whole.
var _clock_frames := 0
var _clock_time := 0.0


func _init(drawn_views: FaceViews = null) -> void:
	views = drawn_views


## Why there can be no cube map in this export; empty if there can.
static func find_loss() -> String:
	if _stays_on_gpu():
		return OnDemand.find_loss(_GPU_CUBE, OnDemand.RENDERING_DEVICE)
	return OnDemand.find_loss(_PACKED_CUBE, OnDemand.COMPATIBILITY)


## To be called once the pyramid has been set up. A cube map of the same size may be taken over.
func make_cube(texture: TextureLayered = null) -> void:
	var script: GDScript
	if _stays_on_gpu():
		script = OnDemand.fetch(_GPU_CUBE, OnDemand.RENDERING_DEVICE)
	else:
		script = OnDemand.fetch(_PACKED_CUBE, OnDemand.COMPATIBILITY)
	cube = script.new(pyramid.size, pyramid.levels, texture)
	plan(Pace.SLICED)


## Limits the time of a slice on the GPU, as far as it can be predicted: the GPU's speed is measured
## while slices are drawn. Views are not limited.
func limit(milliseconds: float) -> void:
	_budget = milliseconds
	var viewport := pyramid.levels[0].viewport
	RenderingServer.viewport_set_measure_render_time(viewport, _budget > 0.0 or _is_measured)


## Makes the slices of the next update; how many they are.
func plan(pace: Pace) -> int:
	_pace = pace
	_slices = _make_slices(pace)
	return _slices.size()


## Frames that an update takes if it is spread over frames.
func get_slices() -> int:
	return _slices.size() if _pace == Pace.SLICED else _make_slices(Pace.SLICED).size()


## Has a slice of an update drawn in the next frame; all of it if [param slice] is negative.
func draw(slice: int) -> void:
	if slice < 0:
		for face in 6 if views != null else 0:
			views.draw(face)
		if search != null:
			search.draw_rows(0, search.count_rows())
			search.draw_last()
		pyramid.draw()
		for part in cube.slices:
			cube.draw(part)
		_measure_speed(pyramid.count_fetches(0))
		return
	for face in _slices[slice].views:
		views.draw(face)
	if _slices[slice].search.y > 0:
		search.draw_rows(_slices[slice].search.x, _slices[slice].search.y)
	if _slices[slice].ends_search:
		search.draw_last()
	for rows in _slices[slice].rows:
		pyramid.draw_rows(rows.x, rows.y, rows.z)
		if rows.x == 0:
			_measure_speed(pyramid.count_fetches(0) * rows.z / pyramid.count_rows(0))
	for part in _slices[slice].parts:
		cube.draw(part)


## After the frame: takes what the slice has drawn. False if nothing was drawn.
func receive(slice: int) -> bool:
	var start := Time.get_ticks_usec()
	if slice <= 0:
		transfer_time = 0.0
	var received := true
	for part in _slices[slice].parts if slice >= 0 else PackedInt32Array(range(cube.slices)):
		received = cube.receive(part) and received
	var is_last := slice < 0 or slice == _slices.size() - 1
	if is_last and search != null:
		search.receive()
	transfer_time += 0.001 * (Time.get_ticks_usec() - start)
	# All of it takes what its slices take, so that these need not be measured each time.
	if _is_measured and is_last and (_pace != Pace.SLICED or _clock_time == 0.0):
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
	_clock_time = _sum_times()
	return true


## Milliseconds of the GPU for an update, as last measured; it comes some frames late.
func get_gpu_time() -> float:
	return _sum_times() if _slices.size() == 1 else _clock_time


func _make_slices(pace: Pace) -> Array[ChainSlices.Slice]:
	var faces := 6 if views != null else 0
	if pace == Pace.SLICED:
		var most := _budget * _speed if _budget > 0.0 else INF
		return ChainSlices.spread(faces, search, pyramid, cube.slices, most)
	var at_once := cube.slices if pace == Pace.WHOLE else 1
	return ChainSlices.at_once(faces, search, pyramid, cube.slices, at_once)


# To be called when the finest level is drawn, with its number of fetches. The engine reports the
# time of an earlier draw of the viewport, but not of which one: the cheapest of the last draws is
# assumed.
func _measure_speed(fetches_now: float) -> void:
	const LATEST := 4
	if _budget == 0.0:
		return
	_drawn.append(fetches_now)
	if _drawn.size() <= LATEST:
		return
	_drawn = _drawn.slice(-LATEST)
	var viewport := pyramid.levels[0].viewport
	var time := RenderingServer.viewport_get_measured_render_time_gpu(viewport)
	if time == 0.0:
		return
	var least := INF
	for fetches in _drawn:
		least = minf(least, fetches)
	_speed = maxf(lerpf(_speed, least / maxf(time, _SHORTEST_TIME), 0.25), _LEAST_SPEED)


func _sum_times() -> float:
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
	if search != null:
		viewports.append_array(search.get_viewports())
	for level in pyramid.levels:
		viewports.append(level.viewport)
	viewports.append_array(cube.get_viewports())
	return viewports
