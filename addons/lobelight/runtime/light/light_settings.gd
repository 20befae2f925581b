@tool
extends RefCounted
## What a [LobeEnvironment3D] says of its light, for those who make it.

## As [enum LobeEnvironment3D.Source].
enum Source { AUTOMATIC, SKY, PANORAMA, CAPTURE }
## As [enum LobeEnvironment3D.UpdateMode].
enum UpdateMode { ONCE, WHEN_CHANGED, EVERY_FRAME, TIME_SLICED }

## The most sources that a light can have, see [member LobeLight.sources].
const MAX_SOURCES := 4

const ViewPlace := preload("view_place.gd")

## Whose world, viewport and place count.
var node: Node3D
var source := Source.AUTOMATIC
var panorama: Texture2D
## As [enum LobeEnvironment3D.Filter].
var filter := 3
## Texels along the side of a face; 0 for what suits the source.
var size := 0
var energy := 1.0
## As [member LobeEnvironment3D.max_sources].
var max_sources := MAX_SOURCES
var measure_cost := false
var update_mode := UpdateMode.WHEN_CHANGED
## Whether changes are drawn in slices, as with TIME_SLICED.
var spread_changes := false
## Seconds from the begin of an update to that of the next one that begins by itself, at least.
var update_interval := 0.0
## Whether the node is the one that lights its world.
var is_active := false
## Of captures; where they are seen from is the node's position.
var capture := ViewPlace.new()
## Called when a panorama has changed.
var on_panorama_changed := Callable()


## Whether updates are spread over frames.
func is_sliced() -> bool:
	return (
		update_mode == UpdateMode.TIME_SLICED
		or update_mode == UpdateMode.WHEN_CHANGED and spread_changes
	)


## Whether the light is taken from [member panorama], by what the properties say.
func takes_panorama() -> bool:
	return decide(source, panorama != null) == Source.PANORAMA


## What a source stands for: with AUTOMATIC, a panorama if there is one, otherwise the sky.
static func decide(wanted: Source, has_panorama: bool) -> Source:
	if wanted == Source.AUTOMATIC:
		return Source.PANORAMA if has_panorama else Source.SKY
	return wanted
