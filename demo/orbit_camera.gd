extends Camera3D
## A camera that circles a point: drag to turn, wheel to come closer.

const _RADIANS_PER_PIXEL := 0.006
const _ZOOM_STEP := 0.92
const _PITCH_LIMITS := Vector2(-0.05, 1.3)
const _DISTANCE_LIMITS := Vector2(2.0, 12.0)

## The point that is looked at.
@export var target := Vector3(0.0, 0.5, 0.0)
## Angle about the vertical axis, in radians.
@export var yaw := 0.0
## Angle above the horizon, in radians.
@export var pitch := 0.2
## Distance from the target, in metres.
@export var distance := 6.0


func _ready() -> void:
	_place()


func _unhandled_input(event: InputEvent) -> void:
	var motion := event as InputEventMouseMotion
	var button := event as InputEventMouseButton
	if motion != null and motion.button_mask & MOUSE_BUTTON_MASK_LEFT:
		yaw -= motion.relative.x * _RADIANS_PER_PIXEL
		pitch += motion.relative.y * _RADIANS_PER_PIXEL
		_place()
	elif button != null and button.pressed:
		if button.button_index == MOUSE_BUTTON_WHEEL_UP:
			distance *= _ZOOM_STEP
		elif button.button_index == MOUSE_BUTTON_WHEEL_DOWN:
			distance /= _ZOOM_STEP
		_place()


func _place() -> void:
	pitch = clampf(pitch, _PITCH_LIMITS.x, _PITCH_LIMITS.y)
	distance = clampf(distance, _DISTANCE_LIMITS.x, _DISTANCE_LIMITS.y)
	var direction := Vector3(sin(yaw) * cos(pitch), sin(pitch), cos(yaw) * cos(pitch))
	look_at_from_position(target + distance * direction, target)
