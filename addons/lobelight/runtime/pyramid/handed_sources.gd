@tool
@abstract
extends RefCounted
## The sources that a search has found, as materials get them and as scripts ask for them: what
## [code]gpu_sources.gd[/code] and [code]packed_sources.gd[/code] have in common.

## Whether there are any.
enum Answer { UNKNOWN, NONE, SOME }

## Sources are the columns.
const EXTENT := Vector2i(4, 3)
# Of half floats: where the energies begin, and how far they are apart.
const _ENERGIES := 4 * 8
const _ENERGY := 8

## What materials sample: see [member LobeLight.sources].
var texture: Texture2D


## Has what [method receive] takes drawn in the next frame, after the search.
func draw() -> void:
	pass


## After the frame: the texture changes.
@abstract func receive() -> void

## Whether the last ones that were received are any; each answer is given once, some frames late.
@abstract func take_answer() -> Answer

## Whether there will be an answer.
@abstract func awaits_answer() -> bool


func get_viewports() -> Array[RID]:
	return []


## Of the texture's bytes.
static func find_answer(data: PackedByteArray) -> Answer:
	for source in EXTENT.x:
		for channel in 3:
			if data.decode_half(_ENERGIES + _ENERGY * source + 2 * channel) > 0.0:
				return Answer.SOME
	return Answer.NONE
