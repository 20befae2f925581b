@tool
extends Object
## Brings the environment's light to the materials.
##
## Materials belong to no world, so all of them show the same light: the one that was offered last,
## the neutral light while there is none. They are known by their RIDs; nothing is kept alive.

const EnvironmentLight := preload("environment_light.gd")
const NeutralLight := preload("neutral_light.gd")

# Resources may be created and freed on loader threads.
static var _mutex := Mutex.new()
# What asks each of them for another variant of its shader; this keeps no material alive either.
static var _materials: Dictionary[RID, Callable] = {}
# By the instance id of who offers it, in the order of the offers.
static var _lights: Dictionary[int, EnvironmentLight] = {}
# Made when the first material comes, dropped with the last one.
static var _neutral: EnvironmentLight
static var _has_stretched_levels := false
# Whether what is kept here is dropped when the game ends.
static var _is_watched := false


## Whether shaders need LOBELIGHT_STRETCHED_LEVELS for the current light.
static func has_stretched_levels() -> bool:
	return _has_stretched_levels


## From now on the material shows the current light. [param other_variant] is called when
## [method has_stretched_levels] has changed.
static func add_material(material: RID, other_variant: Callable) -> void:
	_mutex.lock()
	_watch()
	_materials[material] = other_variant
	_current().apply(material)
	_mutex.unlock()


static func remove_material(material: RID) -> void:
	_mutex.lock()
	_materials.erase(material)
	if _materials.is_empty():
		_neutral = null
	_mutex.unlock()


## Makes a light the current one, or replaces the one that the same owner offered before.
## Whether there are offers of others.
static func offer(owner: int, light: EnvironmentLight) -> bool:
	_mutex.lock()
	_watch()
	_lights[owner] = light
	var has_others := _lights.size() > 1
	_apply_to_all()
	_mutex.unlock()
	return has_others


## Hands on an offered light's rotation and energy after they have changed.
static func update_placement(owner: int) -> void:
	_mutex.lock()
	if _lights.has(owner) and _current() == _lights[owner]:
		for material: RID in _materials:
			_lights[owner].apply_placement(material)
	_mutex.unlock()


## Takes an offer back; the light offered before it is the current one again.
static func withdraw(owner: int) -> void:
	_mutex.lock()
	if _lights.erase(owner):
		_apply_to_all()
	_mutex.unlock()


# What scripts keep in static variables outlives the tree, and a lambda whose object dies after
# that ends the engine by a signal (Godot 4.6). Nodes take connections on the main thread only.
static func _watch() -> void:
	var tree := Engine.get_main_loop() as SceneTree
	if _is_watched or tree == null or OS.get_thread_caller_id() != OS.get_main_thread_id():
		return
	tree.root.tree_exiting.connect(_forget)
	_is_watched = true


static func _forget() -> void:
	_mutex.lock()
	_is_watched = false
	_materials.clear()
	_lights.clear()
	_neutral = null
	_mutex.unlock()


static func _current() -> EnvironmentLight:
	if not _lights.is_empty():
		return _lights.values().back()
	if _neutral == null:
		_neutral = NeutralLight.make()
	return _neutral


static func _apply_to_all() -> void:
	if _materials.is_empty() and _lights.is_empty():
		_has_stretched_levels = false
		return
	var light := _current()
	var has_changed := _has_stretched_levels == light.is_even
	_has_stretched_levels = not light.is_even
	for material: RID in _materials:
		light.apply(material)
		# The object may have gone without having said so.
		if has_changed and _materials[material].is_valid():
			_materials[material].call_deferred()
