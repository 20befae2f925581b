@tool
extends Object
## Captures probes one after the other, a few views in each frame: those that look largest first,
## and those that have waited. Nothing is called while there is nothing to capture.

const LightRegistry := preload("../light/light_registry.gd")
const ProbeCapture := preload("probe_capture.gd")
const ProbeView := preload("probe_view.gd")

## The setting with the views that are drawn in a frame, from 1 to 6.
const SETTING := "lobelight/probes/views_per_frame"
const DEFAULT_VIEWS := 2
# Frames without captures after which the memory for drawing them is given back.
const _IDLE_FRAMES := 120

static var _waiting: Array[ProbeView] = []
static var _current: ProbeView
static var _capture: ProbeCapture
# Of the current one: the slice that comes next, and those that this frame draws.
static var _slice := 0
static var _drawn: Array[int] = []
static var _idle := 0
static var _is_running := false


## Has a probe captured: each capture in one frame if it is to be [param whole], and before those of
## others if it is [param urgent].
static func request(view: ProbeView, whole: bool, urgent: bool) -> void:
	view.is_urgent = view.is_urgent or urgent
	view.is_whole = whole or view.is_urgent
	if view == _current and urgent:
		# Otherwise the views that have been drawn are kept, so that a probe that changes in every
		# frame is captured, too.
		_current = null
		_drawn.clear()
	if view not in _waiting:
		view.waited = 0
		_waiting.append(view)
	_start()


## Captures a probe no more.
static func drop(view: ProbeView) -> void:
	_waiting.erase(view)
	if view == _current:
		_current = null
		_drawn.clear()
	view.echoes = 0
	view.is_urgent = false


static func _start() -> void:
	_idle = 0
	if _is_running:
		return
	_is_running = true
	RenderingServer.frame_pre_draw.connect(_on_frame_pre_draw)
	RenderingServer.frame_post_draw.connect(_on_frame_post_draw)
	var tree := Engine.get_main_loop() as SceneTree
	if tree != null and not tree.root.tree_exiting.is_connected(_stop):
		tree.root.tree_exiting.connect(_stop)


static func _stop() -> void:
	if not _is_running:
		return
	_is_running = false
	RenderingServer.frame_pre_draw.disconnect(_on_frame_pre_draw)
	RenderingServer.frame_post_draw.disconnect(_on_frame_post_draw)
	_waiting.clear()
	_current = null
	_drawn.clear()
	_capture = null


static func _on_frame_pre_draw() -> void:
	if _current == null and not _waiting.is_empty():
		_take_next()
	if _current == null:
		_idle += 1
		if _idle > _IDLE_FRAMES:
			_stop()
		return
	_idle = 0
	var slices := _capture.get_slices()
	var count := slices if _current.is_whole else _find_views_per_frame()
	_drawn.clear()
	while count > 0 and _slice < slices:
		_capture.draw(_slice)
		_drawn.append(_slice)
		_slice += 1
		count -= 1


static func _take_next() -> void:
	var placed := LightRegistry.get_placed()
	if placed == null:
		return
	var next: ProbeView = null
	for view in _waiting:
		view.waited += 1
		if next == null or _comes_before(view, next):
			next = view
	_waiting.erase(next)
	var size: int = placed.get_store().size
	if _capture == null or not _capture.suits(next, size):
		_capture = ProbeCapture.new(next, size)
	_current = next
	_slice = 0
	_capture.begin(next)


static func _comes_before(a: ProbeView, b: ProbeView) -> bool:
	if a.is_urgent != b.is_urgent:
		return a.is_urgent
	# A room without a light of its own shows the sky's.
	if a.has_light != b.has_light:
		return b.has_light
	return a.get_urgency() > b.get_urgency()


static func _on_frame_post_draw() -> void:
	if _current == null or _drawn.is_empty():
		return
	var view := _current
	var received := true
	for slice in _drawn:
		received = _capture.receive(slice) and received
	# Slices from which nothing is read back do not count.
	var is_last := _slice >= _capture.get_slices()
	_drawn.clear()
	if not is_last:
		return
	_current = null
	var placed := LightRegistry.get_placed()
	var succeeded: bool = received and placed != null and _capture.finish(view, placed.get_store())
	if succeeded:
		view.has_light = true
		LightRegistry.refresh()
	if view in _waiting:
		# It was asked for again meanwhile.
		return
	if succeeded and view.echoes > 0:
		view.echoes -= 1
		request(view, view.is_whole, view.is_urgent)
	else:
		view.is_urgent = false
		view.on_end.call(succeeded)


static func _find_views_per_frame() -> int:
	if not ProjectSettings.has_setting(SETTING):
		return DEFAULT_VIEWS
	var value: int = ProjectSettings.get_setting_with_override(SETTING)
	return clampi(value, 1, 6)
