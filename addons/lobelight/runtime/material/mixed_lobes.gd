@tool
@abstract
extends RefCounted
## A table of lobes that the GPU mixes for changing widths, in its place on a page.
##
## To have it mixed anew, set [constant SURFACE] of [member item] to the roughness and the
## anisotropy, and [method draw] the page unless it is due.

## The slopes of these tables have been multiplied with the widths.
const ALPHA := Vector2.ONE
## The name of the item's parameter.
const SURFACE := &"surface"

## The table's texture, which stays the same.
var texture: RID
## As [method LobeTable.get_lookup].
var lookup: Vector4
## The canvas item that draws it.
var item: RID
## Whether the page is drawn in the next frame; the array is the page's own, of one element.
var due: Array[bool]

## Has the page drawn in the next frame, before anything else.
@abstract func draw() -> void
