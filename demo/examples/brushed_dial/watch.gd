extends Node3D
## A watch that goes, and turns to and fro as in a hand: the brushing shows by that.

## How far it turns to either side, in radians, and the seconds there and back.
@export var swing := 0.35
@export var period := 8.0
## What it shows at the start, in seconds since midnight.
@export var start := 36575.0

var _passed := 0.0

@onready var _watch: Node3D = $Watch
@onready var _hours: Node3D = $Watch/Hours
@onready var _minutes: Node3D = $Watch/Minutes
@onready var _seconds: Node3D = $Watch/Seconds


func _ready() -> void:
	_show()


func _process(delta: float) -> void:
	_passed += delta
	_show()


func _show() -> void:
	_watch.rotation.y = swing * sin(TAU * _passed / period) if period > 0.0 else 0.0
	# Clocks turn the other way round than angles.
	var time := start + _passed
	_hours.rotation.z = -TAU * time / 43200.0
	_minutes.rotation.z = -TAU * time / 3600.0
	_seconds.rotation.z = -TAU * floorf(time) / 60.0
