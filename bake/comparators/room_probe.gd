extends RefCounted
## A room's light as the addon has it: a [LobeProbe3D] of the room's size, captured at the room's
## probe, in a world of its own with the walls. The spheres of methods are drawn in that world, each
## on a layer of its own.

# Layers from here on are not for spheres.
const _LAYERS := 19

var _probe: LobeProbe3D
var _world: SubViewport
var _flat: LobeLight
var _count := 0


func _init(room: CompareRoom, tree: SceneTree) -> void:
	_world = room.make_world()
	_probe = LobeProbe3D.new()
	_probe.size = room.size
	_probe.origin_offset = room.probe
	_probe.interior = true
	_probe.cull_mask = CompareRoom.WALL_LAYER
	_world.add_child(_probe)
	tree.root.add_child(_world)


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE and is_instance_valid(_world):
		_world.free()


## Captures the room. Returns one sentence on failure, otherwise empty. To be awaited.
func capture() -> String:
	if await _probe.rebuild():
		return ""
	return _probe.get_rebuild_error()


## Has a viewport that is not in the tree yet show the probe's world.
func enter(viewport: LinearViewport) -> void:
	viewport.own_world_3d = false
	viewport.world_3d = _world.find_world_3d()


## Has the viewport show its own sphere, and no other one of that world.
func part(viewport: LinearViewport, sphere: MeshInstance3D) -> void:
	sphere.layers = 1 << (_count % _LAYERS)
	viewport.camera.cull_mask = sphere.layers
	_count += 1


## The same light, but from infinitely far away; null on failure.
func get_flat_light() -> LobeLight:
	if _flat == null:
		_flat = _probe.get_light()
		if _flat != null:
			_flat.box_size = Vector3.ZERO
			_flat.box_middle = Vector3.ZERO
			_flat.box_origin = Vector3.ZERO
	return _flat
