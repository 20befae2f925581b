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
static var _materials: Dictionary[RID, bool] = {}
# By the instance id of who offers it, in the order of the offers.
static var _lights: Dictionary[int, EnvironmentLight] = {}
# Made when the first material comes, dropped with the last one.
static var _neutral: EnvironmentLight


## From now on the material shows the current light.
static func add_material(material: RID) -> void:
	_mutex.lock()
	_materials[material] = true
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


static func _current() -> EnvironmentLight:
	if not _lights.is_empty():
		return _lights.values().back()
	if _neutral == null:
		_neutral = NeutralLight.make()
	return _neutral


static func _apply_to_all() -> void:
	if _materials.is_empty():
		return
	var light := _current()
	for material: RID in _materials:
		light.apply(material)
