extends Camera3D
## A camera that circles a point: drag with the mouse or a finger to turn, the wheel or two fingers
## to come closer.

## A click or tap that was no drag, in pixels of the viewport.
signal tapped(at: Vector2)

const _RADIANS_PER_HEIGHT := 4.3
const _ZOOM_STEP := 0.92
const _PITCH_LIMITS := Vector2(-0.05, 1.3)
const _DISTANCE_LIMITS := Vector2(2.0, 12.0)
# Moves beyond this part of the picture's height are drags.
const _TAP_REACH := 0.012


## From where something is seen.
class View:
	extends RefCounted
	var target: Vector3
	var yaw: float
	var pitch: float
	var distance: float

	func _init(at: Vector3, about: float, above: float, away: float) -> void:
		target = at
		yaw = about
		pitch = above
		distance = away


## The point that is looked at.
@export var target := Vector3(0.0, 0.5, 0.0):
	set(value):
		target = value
		_place()
## Angle about the vertical axis, in radians.
@export var yaw := 0.0
## Angle above the horizon, in radians.
@export var pitch := 0.2
## Distance from the target, in metres, where the picture is as wide as [member framed_aspect].
@export var distance := 6.0
## The width over the height of what is to be seen whole.
@export var framed_aspect := 1.5

## The part of the viewport that nothing covers, in pixels; the target is in its middle. Empty for
## all of it.
var free_area := Rect2():
	set(value):
		free_area = value
		_place()

# Whether the mouse's button went down on the scene, rather than on a control.
var _is_pressed := false
var _fingers: Dictionary[int, Vector2] = {}
var _moved := 0.0


func _ready() -> void:
	get_viewport().size_changed.connect(_place)
	_place()


## From where it looks.
func get_view() -> View:
	return View.new(target, yaw, pitch, distance)


## Looks from there.
func frame(view: View) -> void:
	yaw = view.yaw
	pitch = view.pitch
	distance = view.distance
	target = view.target


func _unhandled_input(event: InputEvent) -> void:
	# A finger's drag comes as one of the mouse, too.
	if event.device == InputEvent.DEVICE_ID_EMULATION:
		return
	if event is InputEventScreenTouch:
		_touch(event as InputEventScreenTouch)
	elif event is InputEventScreenDrag:
		_drag(event as InputEventScreenDrag)
	elif event is InputEventMagnifyGesture:
		_zoom(1.0 / (event as InputEventMagnifyGesture).factor)
	elif event is InputEventMouseMotion:
		var motion := event as InputEventMouseMotion
		if _is_pressed:
			_turn(motion.relative)
	elif event is InputEventMouseButton:
		_click(event as InputEventMouseButton)


func _click(button: InputEventMouseButton) -> void:
	match button.button_index:
		MOUSE_BUTTON_LEFT:
			var is_click := button.pressed or _is_pressed
			_is_pressed = button.pressed
			if is_click:
				_press(button.pressed, button.position)
		MOUSE_BUTTON_WHEEL_UP:
			if button.pressed:
				_zoom(_ZOOM_STEP)
		MOUSE_BUTTON_WHEEL_DOWN:
			if button.pressed:
				_zoom(1.0 / _ZOOM_STEP)


func _touch(touch: InputEventScreenTouch) -> void:
	if touch.pressed:
		_fingers[touch.index] = touch.position
		if _fingers.size() > 1:
			# No tap comes of it any more.
			_moved = INF
			return
	elif not _fingers.erase(touch.index):
		return
	if _fingers.size() <= 1 and (touch.pressed or _fingers.is_empty()):
		_press(touch.pressed, touch.position)


func _drag(drag: InputEventScreenDrag) -> void:
	if not _fingers.has(drag.index):
		return
	var before := _spread()
	_fingers[drag.index] = drag.position
	if _fingers.size() == 1:
		_turn(drag.relative)
	elif _fingers.size() == 2 and _spread() > 1.0:
		_zoom(before / _spread())


# The distance between two fingers.
func _spread() -> float:
	var places := _fingers.values()
	return places[0].distance_to(places[1]) if places.size() == 2 else 0.0


func _press(pressed: bool, at: Vector2) -> void:
	if pressed:
		_moved = 0.0
	elif _moved < _TAP_REACH:
		tapped.emit(at)


func _turn(by: Vector2) -> void:
	var part := by / get_viewport().get_visible_rect().size.y
	_moved += part.length()
	yaw -= part.x * _RADIANS_PER_HEIGHT
	pitch += part.y * _RADIANS_PER_HEIGHT
	_place()


func _zoom(factor: float) -> void:
	distance *= factor
	_place()


func _place() -> void:
	pitch = clampf(pitch, _PITCH_LIMITS.x, _PITCH_LIMITS.y)
	distance = clampf(distance, _DISTANCE_LIMITS.x, _DISTANCE_LIMITS.y)
	if not is_inside_tree():
		return
	var size := get_viewport().get_visible_rect().size
	var area := free_area if free_area.has_area() else Rect2(Vector2.ZERO, size)
	# As much of the free area as of a whole picture of the framed aspect.
	var height := minf(area.size.y, area.size.x / framed_aspect)
	var away := distance * size.y / height
	var direction := Vector3(sin(yaw) * cos(pitch), sin(pitch), cos(yaw) * cos(pitch))
	look_at_from_position(target + away * direction, target)
	# The target's place on the screen, in halves of its height from the middle.
	var middle := (area.get_center() - 0.5 * size) / (0.5 * size.y)
	var reach := away * tan(0.5 * deg_to_rad(fov))
	h_offset = -middle.x * reach
	v_offset = middle.y * reach
