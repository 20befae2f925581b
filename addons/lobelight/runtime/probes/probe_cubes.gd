@tool
extends "light_store.gd"
## The lights of probes as cube maps: Compatibility, which has no arrays of them. Materials get the
## few that matter most to the camera; the others are left out, and where they are, the environment
## shows.

const ProbeCamera := preload("probe_camera.gd")

## Cube maps beside the environment's.
const CUBES := 4
# Seconds between looks at where the camera is, while there are more lights than cube maps.
const _INTERVAL := 0.1
# How much closer a light must be to replace one that has a place, so that places do not change to
# and fro.
const _ADVANTAGE := 0.9

var _cubes: Dictionary[LobeLight, Cubemap] = {}
var _faces: Dictionary[LobeLight, Array] = {}
# By their instance ids.
var _probes: Dictionary[int, LobeLight] = {}
var _environments: Array[LobeLight] = []
# By layer.
var _places: Array[LobeLight] = []
var _timer: SceneTreeTimer


func hold(probes: Dictionary[int, LobeLight], environments: Array[LobeLight]) -> void:
	var lights := probes.values()
	_probes = probes
	_environments = environments.slice(0, CUBES - 1)
	for light: LobeLight in _cubes.keys():
		if light not in lights:
			_cubes.erase(light)
			_faces.erase(light)
	for light: LobeLight in lights:
		if not light.faces.is_empty() and _faces.get(light) != light.faces:
			_faces[light] = light.faces
			_cubes[light] = Cubemap.new()
			_cubes[light].create_from_images(light.faces)
	_choose()
	_watch()


func has(probe: LobeLight) -> bool:
	return _cubes.has(probe)


func get_layer(light: LobeLight) -> int:
	var place := _places.find(light)
	return place if place >= 0 else NO_PLACE


func get_level_shift(_light: LobeLight) -> float:
	return 0.0


func get_defines() -> PackedStringArray:
	return []


func get_textures() -> Array[RID]:
	var textures: Array[RID] = []
	for light in _places:
		textures.append(_get_cube(light).get_rid())
	return textures


func apply(material: RID) -> void:
	for i in _places.size():
		var name := StringName("lobelight_probe_%d" % i)
		RenderingServer.material_set_param(material, name, _get_cube(_places[i]).get_rid())


func take(light: LobeLight, cube: PyramidCube) -> bool:
	var faces := cube.get_faces()
	if faces.size() != 6 or faces.has(null):
		return false
	if _cubes.has(light) and _cubes[light].get_width() == faces[0].get_width():
		for face in 6:
			_cubes[light].update_layer(faces[face], face)
	else:
		_cubes[light] = Cubemap.new()
		_cubes[light].create_from_images(faces)
		_choose()
	_faces[light] = faces.duplicate()
	return true


func read(light: LobeLight) -> Array[Image]:
	var faces: Array[Image] = []
	faces.assign(_faces.get(light, []))
	return faces


func _get_cube(light: LobeLight) -> TextureLayered:
	return _cubes[light] if _cubes.has(light) else light.cubemap


# Gives the places to the environments and to the nearest probes.
func _choose() -> void:
	var shown: Array[LobeLight] = []
	for light: LobeLight in _probes.values():
		if _cubes.has(light):
			shown.append(light)
	if shown.size() + _environments.size() > CUBES:
		var distances: Dictionary[LobeLight, float] = {}
		for light in shown:
			var distance := _distance(light, _find_camera(_probes.find_key(light)))
			if light in _places:
				distance *= _ADVANTAGE if distance > 0.0 else 1.0 / _ADVANTAGE
			distances[light] = distance
		shown.sort_custom(
			func(a: LobeLight, b: LobeLight) -> bool: return distances[a] < distances[b]
		)
		shown.resize(CUBES - _environments.size())
	var places := _environments + shown
	# Those that stay come first, so that few places change.
	var kept: Array[LobeLight] = []
	for light in _places:
		if light in places and kept.size() < places.size():
			kept.append(light)
	for light in places:
		if light not in kept:
			kept.append(light)
	_places = kept


static func _distance(light: LobeLight, point: Vector3) -> float:
	var local := (point - light.box_middle) * light.rotation
	var outside := (local.abs() - 0.5 * light.box_size).max(Vector3.ZERO)
	# Inside several boxes, the smaller one counts.
	return outside.length() if outside != Vector3.ZERO else -1.0 / (1.0 + light.box_size.length())


# Where the camera is that looks at a probe's world.
static func _find_camera(probe: int) -> Vector3:
	var node := instance_from_id(probe) as Node3D
	if node == null or not node.is_inside_tree():
		return Vector3.ZERO
	var camera := ProbeCamera.find(node)
	return camera.global_position if camera != null else node.global_position


func _watch() -> void:
	if _timer != null or _probes.size() + _environments.size() <= CUBES:
		return
	var tree := Engine.get_main_loop() as SceneTree
	if tree != null:
		_timer = tree.create_timer(_INTERVAL, true, false, true)
		_timer.timeout.connect(_look)


func _look() -> void:
	_timer = null
	var before := _places
	_choose()
	if _places != before and on_change.is_valid():
		on_change.call()
	_watch()
