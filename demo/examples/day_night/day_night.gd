extends Node3D
## Day and night: a procedural sky with a turning sun, and things that are lit by it all the time.
##
## The sky is a script on the WorldEnvironment (turning_sky.gd). Nothing here tells the
## [LobeEnvironment3D] when the light is another one; it sees that the sky was changed. Its Max
## Sources is 0, so that materials keep one shader: none is compiled when the sun rises or sets.

const TurningSky := preload("turning_sky.gd")

## Of the sky's, in a second.
@export var hours_a_second := 1.0

@onready var _sky: TurningSky = $TurningSky


func _process(delta: float) -> void:
	if hours_a_second != 0.0:
		_sky.hour += hours_a_second * delta


## Stops at an hour.
func stop_at(hour: float) -> void:
	hours_a_second = 0.0
	_sky.hour = hour


## As it is shown in the documentation.
func pose() -> void:
	stop_at(17.2)
