@tool
extends Object
## The material that draws Outline and X-Ray, before the next pass, as [BaseMaterial3D] makes it.
##
## It is known by its metadata, the engine's own: scenes keep it, and either kind of material takes
## over what the other has made.

const OWNED := &"_stencil_owned"
const _WRITING := BaseMaterial3D.STENCIL_FLAG_WRITE | BaseMaterial3D.STENCIL_FLAG_WRITE_DEPTH_FAIL


## Whether a material of that mode has such a pass.
static func has_pass(mode: BaseMaterial3D.StencilMode) -> bool:
	return mode == BaseMaterial3D.STENCIL_MODE_OUTLINE or mode == BaseMaterial3D.STENCIL_MODE_XRAY


## Whether a material can have a mode: what draws the effect has to come after it.
static func is_possible(shown: Material, mode: BaseMaterial3D.StencilMode) -> bool:
	if not has_pass(mode) or shown.render_priority < Material.RENDER_PRIORITY_MAX:
		return true
	var name := shown.resource_path if shown.resource_path else "stencil_mode"
	push_error(
		(
			"LobeMaterial3D: %s: Outline and X-Ray need a render priority below %d."
			% [name, Material.RENDER_PRIORITY_MAX]
		)
	)
	return false


## The flags without those that exclude others: a surface either reads or writes, and what is new
## wins.
static func without_conflict(flags: int, before: int) -> int:
	if flags & BaseMaterial3D.STENCIL_FLAG_READ and flags & _WRITING:
		return flags & (_WRITING if before & BaseMaterial3D.STENCIL_FLAG_READ else ~_WRITING)
	return flags


## Makes, changes or drops what draws the effect.
static func choose(shown: Material, mode: BaseMaterial3D.StencilMode) -> void:
	var drawn := _find(shown)
	if not has_pass(mode):
		if drawn != null:
			shown.next_pass = drawn.next_pass
		return
	if drawn == null:
		drawn = StandardMaterial3D.new()
		drawn.set_meta(OWNED, true)
		drawn.next_pass = shown.next_pass
		shown.next_pass = drawn
	var is_outline := mode == BaseMaterial3D.STENCIL_MODE_OUTLINE
	drawn.render_priority = shown.render_priority + 1
	drawn.set("shading_mode", BaseMaterial3D.SHADING_MODE_UNSHADED)
	drawn.set("transparency", BaseMaterial3D.TRANSPARENCY_ALPHA)
	drawn.set("no_depth_test", not is_outline)
	drawn.set("grow", is_outline)
	drawn.set("stencil_mode", BaseMaterial3D.STENCIL_MODE_CUSTOM)
	drawn.set("stencil_flags", BaseMaterial3D.STENCIL_FLAG_READ)
	drawn.set("stencil_compare", BaseMaterial3D.STENCIL_COMPARE_NOT_EQUAL)


## What draws the effect takes over what it looks like.
static func hand_on(shown: Material, reference: int, colour: Color, thickness: float) -> void:
	var drawn := _find(shown)
	if drawn != null:
		drawn.set("stencil_reference", reference)
		drawn.set("albedo_color", colour)
		drawn.set("grow_amount", thickness)


# Whole scenes are converted with their passes: it is of either kind.
static func _find(shown: Material) -> Material:
	var next := shown.next_pass
	return next if next != null and next.has_meta(OWNED) else null
