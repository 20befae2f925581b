@tool
extends RefCounted
## What draws the captures of all probes of a world, one after the other: six views, a pyramid, and
## the cube map that takes it, which is then copied to where the probe's light is kept.

const Pyramid := preload("../pyramid/pyramid.gd")
const PyramidChain := preload("../pyramid/pyramid_chain.gd")
const ProbeView := preload("probe_view.gd")
const LightStore := preload("light_store.gd")
const WorldLight := preload("../light/world_light.gd")

const FILTER := Pyramid.Filter.DISC
# Pixels of a view along the side of a texel.
const _SAMPLES := 1

var _chain: PyramidChain
var _scenario: RID
var _size: int


func _init(view: ProbeView, size: int) -> void:
	_size = size
	_scenario = view.node.get_world_3d().scenario
	view.world.look(WorldLight.Views.SCENE)
	var views := view.world.make_views(_SAMPLES, size)
	_chain = PyramidChain.new(views)
	_chain.pyramid.set_up_views(views.get_textures(), _SAMPLES, size, FILTER)
	_chain.make_cube()


## Why nothing can be captured in this export; empty if it can.
static func find_loss() -> String:
	var losses: Array[String] = [PyramidChain.find_loss(), WorldLight.find_loss()]
	for loss in losses:
		if loss:
			return loss
	return ""


## Whether it draws the world of a view, at a size.
func suits(view: ProbeView, size: int) -> bool:
	return size == _size and view.node.get_world_3d().scenario == _scenario


func get_slices() -> int:
	return _chain.get_slices()


## To be called before the first slice: what the views show.
func begin(view: ProbeView) -> void:
	view.world.look(WorldLight.Views.SCENE)
	view.update_place()
	view.world.place(_chain.views, view.place)


## Has a slice drawn in the next frame.
func draw(slice: int) -> void:
	_chain.draw(slice)


## After the frame. False if nothing was drawn.
func receive(slice: int) -> bool:
	return _chain.receive(slice)


## After the last slice: hands the light over.
func finish(view: ProbeView, store: LightStore) -> bool:
	var light := view.light
	# Those of a bake are no longer what shows.
	light.faces = []
	light.size = _size
	light.level_variance = Pyramid.LEVEL_VARIANCES[FILTER]
	light.base_variance = 0.0
	light.is_even = true
	return store.take(light, _chain.cube)
