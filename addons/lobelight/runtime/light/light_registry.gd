@tool
extends Object
## Brings the lights of the worlds to the materials.
##
## A material belongs to no world. If there is a single light, all materials show it; if there is
## none, they show the neutral one. With probes, with lights in several worlds, and while one light
## fades into another, the shader finds the light of each pixel (probes/placed_lights.gd). Materials
## are known by their RIDs, so none is kept alive.

const DiffuseSource := preload("diffuse_source.gd")
const LightWorld := preload("light_world.gd")
const NeutralLight := preload("neutral_light.gd")
const OnDemand := preload("../on_demand.gd")

# The longest step of a fade in one frame, in seconds.
const _LONGEST_STEP := 0.1
const _NEUTRAL_WARNING := "res://addons/lobelight/runtime/warnings/neutral_warning.gd"
const _PLACED := "res://addons/lobelight/runtime/probes/placed_lights.gd"

# Resources may be created and freed on loader threads.
static var _mutex := Mutex.new()
# By material, what to call when it needs another variant of its shader.
static var _materials: Dictionary[RID, Callable] = {}
# By material, the light that it was given; it then ignores those of the worlds.
static var _own: Dictionary[RID, LobeLight] = {}
# By material, the box of that light, as the shader reads it.
static var _own_lists: Dictionary[RID, Texture2D] = {}
# The narrowest width of each one's lobes, where it is known.
static var _widths: Dictionary[RID, float] = {}
# The worlds by their scenarios, in the order in which they came.
static var _worlds: Dictionary[RID, LightWorld] = {}
# The neutral light: made with the first material, dropped with the last one.
static var _neutral: LobeLight
# What materials show: one light, or the lights of all places.
static var _shown: LobeLight
static var _placed: RefCounted
static var _placed_script: GDScript
# Whether it has been told that an export lacks the script.
static var _is_loss_told := false
static var _defines: PackedStringArray = []
# Whether what is kept here is dropped when the game ends.
static var _is_watched := false
static var _is_aging := false


## The #defines that shaders need for the current lights, without LOBELIGHT_.
static func get_defines(material: RID) -> PackedStringArray:
	_mutex.lock()
	var own: LobeLight = _own.get(material)
	var defines := _defines.duplicate()
	_mutex.unlock()
	if own == null:
		return defines
	defines = own.get_defines()
	if _has_own_place(own):
		defines.insert(0, "PLACED")
	return defines


## The same for where the diffuse light comes from, of a material that has any.
static func get_diffuse_defines(material: RID) -> PackedStringArray:
	_mutex.lock()
	var defines := DiffuseSource.get_defines(material)
	_mutex.unlock()
	return defines


static func set_diffuse_source(material: RID, source: DiffuseSource.Source) -> void:
	_mutex.lock()
	DiffuseSource.choose(material, source)
	if _materials.has(material):
		_ask_for_variant(material)
	_mutex.unlock()


## From now on the material shows the light of where it is. [param other_variant] is called when
## [method get_defines] has changed.
static func add_material(material: RID, other_variant: Callable) -> void:
	_mutex.lock()
	_watch()
	_materials[material] = other_variant
	_apply(material)
	_mutex.unlock()


## Hands the material its light once more.
static func apply_again(material: RID) -> void:
	_mutex.lock()
	if _materials.has(material):
		_apply(material)
	_mutex.unlock()


static func remove_material(material: RID) -> void:
	_mutex.lock()
	_materials.erase(material)
	_widths.erase(material)
	_own.erase(material)
	_own_lists.erase(material)
	DiffuseSource.forget_material(material)
	if _materials.is_empty():
		_neutral = null
		if _worlds.is_empty():
			_shown = null
	_mutex.unlock()


## Sets the narrowest width among a material's lobes, see [method LobeLight.apply]; 0 if it is not
## known.
static func set_width(material: RID, width: float) -> void:
	_mutex.lock()
	if _widths.get(material, 0.0) != width:
		_widths[material] = width
		var light: LobeLight = _own.get(material, _shown)
		if light != null and light.goes_by_width() and _materials.has(material):
			_apply(material)
	_mutex.unlock()


## Gives a material a light of its own; with [code]null[/code] it shows that of its place again.
static func set_own_light(material: RID, light: LobeLight) -> void:
	var problem := light.get_problem() if light != null else ""
	if problem:
		push_error(
			(
				"LobeMaterial3D: %s: %s"
				% [light.resource_path if light.resource_path else "Light", problem]
			)
		)
	elif light != null and light.has_box():
		_load_places()
	_mutex.lock()
	_own.erase(material)
	_own_lists.erase(material)
	if light != null and not problem:
		_own[material] = light
	if _materials.has(material):
		_apply(material)
		_ask_for_variant(material)
	_mutex.unlock()


## An environment of a world is about to make its first light: until it comes, the old one stays.
static func expect(world: World3D, owner: int) -> void:
	_mutex.lock()
	_get_world(world).pending[owner] = true
	_mutex.unlock()


## Makes a light the current one of a world, or replaces the one that the same owner offered before;
## it fades in over some [param seconds].
static func offer(world: World3D, owner: int, light: LobeLight, seconds := 0.0) -> void:
	if seconds > 0.0 or _is_other_world_lit(world):
		_load_places()
	DiffuseSource.load_watch()
	_mutex.lock()
	_watch()
	_get_world(world).offer(owner, light, seconds)
	_refresh()
	_mutex.unlock()


## Gives a probe's light to a world, or replaces it.
static func add_probe(world: World3D, owner: int, light: LobeLight) -> void:
	_load_places()
	DiffuseSource.load_watch()
	_mutex.lock()
	_watch()
	_get_world(world).probes[owner] = light
	_refresh()
	_mutex.unlock()


## To be called when lights have moved or a probe's light has been drawn: chooses again what
## materials show.
static func refresh() -> void:
	_mutex.lock()
	_refresh()
	_mutex.unlock()


## Hands on a light's rotation, energy and box after they have changed.
## [param is_drawing] says that the frame's drawing begins, and nobody else will change anything.
static func update_placement(light: LobeLight, is_drawing := false) -> void:
	_mutex.lock()
	if _placed != null and is_drawing:
		_placed.write()
	elif _placed != null:
		_placed.mark_moved()
	elif light == _shown:
		for material: RID in _materials:
			if not _own.has(material):
				light.apply_placement(material)
	for material: RID in _own:
		if _own[material] == light and _materials.has(material):
			_apply(material)
	_mutex.unlock()


## Sources have come into a light or gone: materials that have it for their own need other shaders.
static func follow_sources(light: LobeLight) -> void:
	_mutex.lock()
	for material: RID in _own:
		if _own[material] == light and _materials.has(material):
			_apply(material)
			_ask_for_variant(material)
	_mutex.unlock()


## Takes back what an environment or a probe has offered or announced, in all worlds.
static func withdraw(owner: int) -> void:
	_mutex.lock()
	var changed := false
	for scenario: RID in _worlds.keys():
		var world := _worlds[scenario]
		changed = world.withdraw(owner) or changed
		changed = world.probes.erase(owner) or changed
		world.pending.erase(owner)
		if world.is_empty():
			_worlds.erase(scenario)
	if changed:
		_refresh()
	_mutex.unlock()


## Whether there are materials, but no light for them in any world, nor one to come.
static func is_unlit() -> bool:
	_mutex.lock()
	var found := not _materials.is_empty()
	for scenario in _worlds:
		found = found and not _worlds[scenario].is_lit() and _worlds[scenario].pending.is_empty()
	_mutex.unlock()
	return found


## Whether a material shows the light of its place rather than one of its own.
static func awaits_light(material: RID) -> bool:
	_mutex.lock()
	var found := _materials.has(material) and not _own.has(material)
	_mutex.unlock()
	return found


## What finds the light of each pixel; null while there is one light for all.
static func get_placed() -> RefCounted:
	return _placed


## Why lights cannot be told by their places in this export; empty if they can.
static func find_loss() -> String:
	return OnDemand.find_loss(_PLACED, OnDemand.PLACES)


# Not to be called under the lock: loading a script may wait for other threads, which may wait for
# the lock.
static func _load_places() -> void:
	if _placed_script == null and not _is_loss_told:
		_placed_script = OnDemand.fetch(_PLACED, OnDemand.PLACES) as GDScript
		_is_loss_told = _placed_script == null


## Whether an environment other than [param owner] lights a world, or has until now.
static func is_lit_by_other(world: World3D, owner: int) -> bool:
	_mutex.lock()
	var found := _worlds.has(world.scenario) and _worlds[world.scenario].is_lit_by_other(owner)
	_mutex.unlock()
	return found


## Whether materials need other shaders to show the first light of a world, which they get before
## the next frame. [param has_sources] says whether it will have [member LobeLight.sources].
static func needs_variants(world: World3D, is_even: bool, has_sources: bool) -> bool:
	if _is_other_world_lit(world):
		return true
	_mutex.lock()
	var found := _placed != null or ("STRETCHED_LEVELS" in _defines) == is_even
	found = found or ("SOURCES" in _defines) != has_sources
	_mutex.unlock()
	return found


# Whether there is light in another world that has not gone.
static func _is_other_world_lit(world: World3D) -> bool:
	_mutex.lock()
	var found := false
	for scenario in _worlds:
		var other := _worlds[scenario]
		found = found or scenario != world.scenario and other.is_lit() and not other.has_gone()
	_mutex.unlock()
	return found


static func _get_world(world: World3D) -> LightWorld:
	if not _worlds.has(world.scenario):
		_worlds[world.scenario] = LightWorld.new(world)
	return _worlds[world.scenario]


# Static variables outlive the tree, and if a lambda's object dies after the tree, the engine
# crashes (Godot 4.6). So all is dropped when the tree ends. Nodes may be connected to on the main
# thread only.
static func _watch() -> void:
	var tree := Engine.get_main_loop() as SceneTree
	if _is_watched or tree == null or OS.get_thread_caller_id() != OS.get_main_thread_id():
		return
	tree.root.tree_exiting.connect(_forget)
	_is_watched = true
	# The editor warns by itself, and exports leave out what does it here.
	if not Engine.is_editor_hint() and ResourceLoader.exists(_NEUTRAL_WARNING):
		load(_NEUTRAL_WARNING).begin.call_deferred(tree)


static func _forget() -> void:
	_mutex.lock()
	_is_watched = false
	_materials.clear()
	_own.clear()
	_own_lists.clear()
	_widths.clear()
	_worlds.clear()
	_neutral = null
	_shown = null
	_end_places()
	_placed_script = null
	DiffuseSource.forget()
	if _is_aging:
		RenderingServer.frame_post_draw.disconnect(_age)
	_is_aging = false
	_mutex.unlock()


# The worlds that have a light, in the order in which they came.
static func _find_lit() -> Array[LightWorld]:
	var lit: Array[LightWorld] = []
	for scenario: RID in _worlds.keys():
		var world := _worlds[scenario]
		if world.has_gone():
			_worlds.erase(scenario)
			continue
		if world.is_lit():
			lit.append(world)
	return lit


# Chooses again what materials show.
static func _refresh() -> void:
	var lit := _find_lit()
	var places := lit.size()
	for world in lit:
		places += world.probes.size() + world.faded.size()
	var before := _placed
	if places > 1 and _placed_script != null:
		if _placed == null:
			_placed = _placed_script.new()
		_placed.show(_worlds, _get_neutral())
	else:
		_end_places()
	_shown = null
	if _placed == null:
		_shown = lit.back().get_light() if not lit.is_empty() else null
	if _shown == null:
		_shown = _get_neutral()
	var defines: PackedStringArray = (
		_placed.get_defines() if _placed != null else _shown.get_defines()
	)
	var has_changed := defines != _defines
	_defines = defines
	if _placed == null or _placed != before or _placed.has_other_textures():
		for material: RID in _materials:
			_apply(material)
	if _follow_engine(lit) or has_changed:
		_ask_for_variants()
	_start_aging()


# Looks at the engine's own light in the lit worlds; returns whether that has changed.
static func _follow_engine(lit: Array[LightWorld]) -> bool:
	var worlds: Array[World3D] = []
	var with_probes: Array[World3D] = []
	for world in lit:
		if world.get_world() != null:
			worlds.append(world.get_world())
			if not world.probes.is_empty():
				with_probes.append(world.get_world())
	return DiffuseSource.follow(worlds, with_probes, _ask_for_variants)


static func _end_places() -> void:
	if _placed != null:
		_placed.end()
	_placed = null


static func _get_neutral() -> LobeLight:
	if _neutral == null:
		_neutral = NeutralLight.make()
	return _neutral


static func _apply(material: RID) -> void:
	if _own.has(material):
		var own := _own[material]
		# Lobes may see less of a box from a place inside than from its middle.
		own.apply(material, 0.0 if own.has_box() else _widths.get(material, 0.0))
		if _has_own_place(own):
			_own_lists[material] = _placed_script.make_list(own)
			var list := _own_lists[material].get_rid()
			RenderingServer.material_set_param(material, &"lobelight_lights", list)
	elif _placed != null:
		_placed.apply(material)
	else:
		if _shown == null:
			_shown = _get_neutral()
		_shown.apply(material, _widths.get(material, 0.0))


static func _has_own_place(light: LobeLight) -> bool:
	return light.has_box() and _placed_script != null


static func _ask_for_variants() -> void:
	_mutex.lock()
	for material: RID in _materials:
		_ask_for_variant(material)
	_mutex.unlock()


static func _ask_for_variant(material: RID) -> void:
	# The object may have gone without having said so.
	if _materials[material].is_valid():
		_materials[material].call_deferred()


# Called in each frame while a light goes or fades, and only then.
static func _start_aging() -> void:
	var ages := _worlds.values().any(func(world: LightWorld) -> bool: return world.is_aging())
	if ages and not _is_aging:
		RenderingServer.frame_post_draw.connect(_age)
	elif not ages and _is_aging:
		RenderingServer.frame_post_draw.disconnect(_age)
	_is_aging = ages


static func _age() -> void:
	_mutex.lock()
	# Other shaders may have been compiled in this frame; what fades is not to jump for it.
	var frame_time := (Engine.get_main_loop() as SceneTree).root.get_process_delta_time()
	var seconds := minf(frame_time, _LONGEST_STEP)
	var changed := false
	for scenario: RID in _worlds.keys():
		changed = _worlds[scenario].age(seconds) or changed
		if _worlds[scenario].is_empty():
			_worlds.erase(scenario)
	if changed:
		_refresh()
	else:
		_start_aging()
	_mutex.unlock()
