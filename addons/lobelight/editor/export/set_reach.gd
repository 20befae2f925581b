@tool
extends RefCounted
## What is known of a ready set: which widths of it are reached, and by whom.

## Why all of it is kept, or empty.
var whole_because := ""
## Who needs the set: files.
var needed_by: PackedStringArray = []
## Pairs of widths that are drawn; equal ones stand for an isotropic table.
var surfaces: Array[Vector2] = []
## Whether everything between the surfaces is reached, too.
var is_filled := false
## Why all isotropic tables are kept, or empty.
var isotropic_because := ""


## The least and the largest width of the surfaces.
func get_range() -> Vector2:
	var low := INF
	var high := 0.0
	for surface in surfaces:
		low = minf(low, minf(surface.x, surface.y))
		high = maxf(high, maxf(surface.x, surface.y))
	return Vector2(low, high)


func is_isotropic() -> bool:
	return surfaces.all(
		func(surface: Vector2) -> bool: return is_equal_approx(surface.x, surface.y)
	)


func add_user(file: String) -> void:
	if file not in needed_by:
		needed_by.append(file)


func add_surface(widths: Vector2) -> void:
	if widths not in surfaces:
		surfaces.append(widths)
