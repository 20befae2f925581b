@tool
extends RefCounted
## A probe as its captures see it: where it looks from, and the light that they make.

const ProbeCamera := preload("probe_camera.gd")
const ViewPlace := preload("../light/view_place.gd")
const WorldLight := preload("../light/world_light.gd")

## Whose world and viewport count; null once it has left.
var node: Node3D
## What the captures are filtered into. Its box is where they are seen from.
var light := LobeLight.new()
var place := ViewPlace.new()
## The background and the ambient light of the node's world.
var world: WorldLight
## Called when a capture has ended, with whether there is one.
var on_end := Callable()
## Captures that are to follow, each of which brings one more reflection between materials.
var echoes := 0
## Whether there has been a capture.
var has_light := false
## Whether it comes before all that are not.
var is_urgent := false
## Whether each capture is drawn in one frame.
var is_whole := false
## Frames since it was asked for.
var waited := 0


func _init() -> void:
	place.is_probe = true


## Puts the views to where the light's box says.
func update_place() -> void:
	place.basis = light.rotation
	place.origin = light.box_middle + light.rotation * light.box_origin


## How large the box looks from the camera of its viewport, which goes first.
func get_urgency() -> float:
	var camera := ProbeCamera.find(node)
	var point := camera.global_position if camera != null else place.origin
	var local := (point - light.box_middle) * light.rotation
	var distance := (local.abs() - 0.5 * light.box_size).max(Vector3.ZERO).length()
	return (1.0 + waited) * light.box_size.length() / maxf(distance, 1.0)
