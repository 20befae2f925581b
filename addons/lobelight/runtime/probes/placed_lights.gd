@tool
extends RefCounted
## The lights of all places, as the shader finds them by where a pixel is
## (placed_light.gdshaderinc): a list of the lights of each world, and the textures that they are
## in.
##
## The list is a texture that all materials share, so that a light which moves costs them nothing.

const LightList := preload("light_list.gd")
const LightRegistry := preload("../light/light_registry.gd")
const LightWorld := preload("../light/light_world.gd")
const LightStore := preload("light_store.gd")
const WorldCameras := preload("world_cameras.gd")

## Worlds that can be told from one another; those beyond show the first one's environment.
const MAX_WORLDS := 4
# Lights with sources beside the one that all materials have.
const _MAX_OTHER_SOURCES := 3

var _list := LightList.new()
var _store: LightStore = LightStore.make()
var _cameras := WorldCameras.new()
var _worlds: Dictionary[RID, LightWorld] = {}
var _neutral: LobeLight
var _primary: LobeLight
var _is_stretched := false
# The lights that have sources, the primary one or null first.
var _with_sources: Array[LobeLight] = []
var _awaits_frame := false
# What the materials have.
var _given: Array[RID] = []


func _init() -> void:
	_store.on_change = LightRegistry.refresh


## The list for a material that has a light of its own, with a box, as its environment.
static func make_list(light: LobeLight) -> Texture2D:
	var list := LightList.new()
	list.begin()
	list.begin_world()
	# This light has no edge: outside the box it goes on.
	list.add(light, LightList.ENVIRONMENT, 0.0, INF, true)
	list.end()
	return list.texture


## To be called before it is let go of.
func end() -> void:
	_cameras.tell([])
	if _awaits_frame:
		RenderingServer.frame_pre_draw.disconnect(_on_frame_pre_draw)


## Looks at the lights of the worlds, by their scenarios.
func show(worlds: Dictionary[RID, LightWorld], neutral: LobeLight) -> void:
	_worlds = worlds
	_neutral = neutral
	var lit: Array[RID] = []
	var locals: Dictionary[int, LobeLight] = {}
	var others: Array[LobeLight] = []
	var faded: Array[LobeLight] = []
	_primary = null
	_is_stretched = false
	for scenario: RID in worlds:
		var world := worlds[scenario]
		var light := world.get_light()
		if not world.is_lit() or lit.size() == MAX_WORLDS:
			continue
		lit.append(scenario)
		if light == null:
			light = neutral
		if _primary == null:
			_primary = light
		elif light != _primary and light not in others:
			others.append(light)
		faded.append_array(world.faded)
		locals.merge(world.probes)
	# If there are too many, those that are fading out are left out.
	for light in faded:
		if light != _primary and light not in others:
			others.append(light)
	for light: LobeLight in locals.values() + others + [_primary]:
		_is_stretched = _is_stretched or not light.is_even
	_store.hold(locals, others)
	_with_sources = [_primary if _primary.sources != null else null]
	for light in others:
		if light.sources != null and _with_sources.size() <= _MAX_OTHER_SOURCES:
			_with_sources.append(light)
	_cameras.tell(lit)
	mark_moved()
	# Otherwise what is drawn before the next frame would show the old list.
	write()


## A light has moved or changed its energy: the list is written before the next frame.
func mark_moved() -> void:
	if not _awaits_frame:
		_awaits_frame = true
		RenderingServer.frame_pre_draw.connect(_on_frame_pre_draw)


## Brings the list up to date.
func write() -> void:
	_list.begin()
	for scenario in _cameras.get_worlds():
		_list.begin_world()
		var world: LightWorld = _worlds.get(scenario)
		_write_world(world, false)
		if world != null and not world.probes.values().all(_store.has):
			_list.begin_captured()
			_write_world(world, true)
	# A world without lights shows the first world's environment, without its probes.
	_list.begin_unlit()
	var sources := _with_sources.find(_primary) + 1 if _primary.sources != null else 0
	_list.add(_primary, LightList.ENVIRONMENT, 0.0, 1.0, true, _primary.energy, sources)
	_list.end()


## The #defines that shaders need, without LOBELIGHT_.
func get_defines() -> PackedStringArray:
	var defines: PackedStringArray = ["PLACED"]
	defines.append_array(_store.get_defines())
	if _is_stretched:
		defines.append("STRETCHED_LEVELS")
	if _with_sources.any(func(light: LobeLight) -> bool: return light != null):
		defines.append("SOURCES")
		if _with_sources.size() > 1:
			defines.append("OTHER_SOURCES %d" % (_with_sources.size() - 1))
	return defines


## Whether there are other textures than when materials were last asked about.
func has_other_textures() -> bool:
	var now := _list_textures()
	var differs := now != _given
	_given = now
	return differs


## Hands the lights to a material of the rendering server.
func apply(material: RID) -> void:
	var server := RenderingServer
	server.material_set_param(material, &"lobelight_environment", _primary.cubemap.get_rid())
	server.material_set_param(material, &"lobelight_lights", _list.texture.get_rid())
	for i in _with_sources.size():
		if _with_sources[i] != null:
			_with_sources[i].apply_sources(material, _name_of_sources(i))
	_store.apply(material)


## Where the lights of probes are kept.
func get_store() -> LightStore:
	return _store


## The bits by which the shader tells a world, for the cull masks of cameras that look at it; with
## [param captured], rooms whose light has not been captured yet have none.
func get_camera_bits(scenario: RID, captured: bool) -> int:
	return _cameras.get_bits(scenario, LightList.CAPTURED if captured else 0)


func _list_textures() -> Array[RID]:
	var textures: Array[RID] = [_primary.cubemap.get_rid(), _list.texture.get_rid()]
	textures.append_array(_store.get_textures())
	for light in _with_sources:
		textures.append(light.sources.get_rid() if light != null else RID())
	return textures


static func _name_of_sources(number: int) -> StringName:
	return (
		&"lobelight_sources" if number == 0 else StringName("lobelight_sources_%d" % (number - 1))
	)


func _on_frame_pre_draw() -> void:
	RenderingServer.frame_pre_draw.disconnect(_on_frame_pre_draw)
	_awaits_frame = false
	write()


# The lights as cameras see them, or as captures of probes see them. In captures, rooms without
# light yet are dark: if the first capture were lit by the sky, some of that light would stay in
# closed rooms.
func _write_world(world: LightWorld, captured: bool) -> void:
	var probes: Array[LobeLight] = []
	if world != null:
		for probe: LobeLight in world.probes.values():
			if _store.get_layer(probe) != LightStore.NO_PLACE or captured and not _store.has(probe):
				probes.append(probe)
	probes.sort_custom(_comes_before)
	for i in probes.size():
		var starts := i > 0 and probes[i].priority != probes[i - 1].priority
		if _store.has(probes[i]):
			var shift := _store.get_level_shift(probes[i])
			_list.add(probes[i], _store.get_layer(probes[i]), shift, 1.0, starts)
		else:
			_list.add(probes[i], LightList.ENVIRONMENT, 0.0, 1.0, starts, 0.0)
	# Each light that fades takes its share of what the ones before leave.
	var lights: Array[LobeLight] = [_neutral]
	if world != null and world.get_light() != null:
		lights[0] = world.get_light()
		lights.append_array(world.faded)
	for i in lights.size():
		var is_last := i == lights.size() - 1
		var light := lights[i]
		if _layer_of(light) == LightStore.NO_PLACE:
			light = _primary
		var share := 1.0 if is_last else world.shares[i]
		var sources := 0 if light.sources == null else _with_sources.find(light) + 1
		_list.add(light, _layer_of(light), 0.0, share, true, light.energy, sources)


func _layer_of(light: LobeLight) -> int:
	return LightList.ENVIRONMENT if light == _primary else _store.get_layer(light)


# The order in which lights take their shares of a pixel. Equal ones keep it from frame to frame.
static func _comes_before(a: LobeLight, b: LobeLight) -> bool:
	if a.priority != b.priority:
		return a.priority > b.priority
	var volumes := [a.box_size.x * a.box_size.y * a.box_size.z, 0.0]
	volumes[1] = b.box_size.x * b.box_size.y * b.box_size.z
	if volumes[0] != volumes[1]:
		return volumes[0] < volumes[1]
	return a.get_instance_id() < b.get_instance_id()
