@tool
@abstract
extends RefCounted
## Where the lights of probes, and of the environments of further worlds, are kept on the GPU: in
## Forward+ and Mobile an array of cube maps, in Compatibility, which has no such arrays, a few cube
## maps.

const PyramidCube := preload("../pyramid/pyramid_cube.gd")

## The setting with the texels along the side of a face of a probe's light, a power of two.
const SETTING := "lobelight/probes/size"
const DEFAULT_SIZE := 256
## The same on phones.
const DEFAULT_MOBILE_SIZE := 128
## The layer of lights that have no place.
const NO_PLACE := -100
const _MIN_SIZE := 16
const _MAX_SIZE := 1024
# As features that an export has; the last two are those of browsers on phones.
const _PHONES: Array[String] = ["mobile", "web_android", "web_ios"]
const _FOLDER := "res://addons/lobelight/runtime/probes/"

## Called when other lights have places.
var on_change := Callable()
## Texels along the side of a face of a probe's light.
var size := find_size()


## The store of the current renderer.
static func make() -> RefCounted:
	var has_device := RenderingServer.get_rendering_device() != null
	var script: GDScript = load(_FOLDER + ("probe_array.gd" if has_device else "probe_cubes.gd"))
	return script.new()


## What the project says of the size of probes.
static func find_size() -> int:
	var value: int = DEFAULT_MOBILE_SIZE if _PHONES.any(OS.has_feature) else DEFAULT_SIZE
	if ProjectSettings.has_setting(SETTING):
		value = ProjectSettings.get_setting_with_override(SETTING)
	return clampi(nearest_po2(maxi(value, 1)), _MIN_SIZE, _MAX_SIZE)


## Keeps these lights and no others: those of probes, by their instance ids, and those of further
## environments.
@abstract func hold(probes: Dictionary[int, LobeLight], environments: Array[LobeLight]) -> void

## Whether the light of a probe has been captured or baked.
@abstract func has(probe: LobeLight) -> bool

## Where a light is, for the list; [constant NO_PLACE] if it has none.
@abstract func get_layer(light: LobeLight) -> int

## What is added to the levels of a light because it is kept at another size than its own.
@abstract func get_level_shift(light: LobeLight) -> float

## Of shaders, without LOBELIGHT_.
@abstract func get_defines() -> PackedStringArray

@abstract func get_textures() -> Array[RID]

## Hands the textures to a material of the rendering server.
@abstract func apply(material: RID) -> void

## Takes what a probe's capture has drawn. False if there was nothing.
@abstract func take(light: LobeLight, cube: PyramidCube) -> bool

## The faces of a probe's light with all levels; empty if it has none.
@abstract func read(light: LobeLight) -> Array[Image]
