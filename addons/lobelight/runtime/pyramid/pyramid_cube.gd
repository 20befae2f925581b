@tool
extends RefCounted
## A cube map that takes the levels of a pyramid: what [code]gpu_cube.gd[/code] and
## [code]packed_cube.gd[/code] have in common.

## What materials sample: half floats, with all levels.
var texture: TextureLayered
## Frames that handing the levels over can be spread over.
var slices := 1


## Has what [method receive] takes drawn in the next frame, after the levels.
func draw(_slice: int) -> void:
	pass


## Takes what has been drawn; the texture changes with the last slice. False if nothing was drawn.
func receive(_slice: int) -> bool:
	return false


## The faces with their levels on the processor's side, in the order +X −X +Y −Y +Z −Z.
func get_faces() -> Array[Image]:
	return []


## The viewports that draw for it.
func get_viewports() -> Array[RID]:
	return []
