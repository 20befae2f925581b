@tool
extends RefCounted
## The lights of one world: what its environments and probes have given, and what is shown until
## they have.

# Frames for which a light that has been taken back stays, so that the environment of the next
# scene can come; while that one makes its light, the old one stays for longer.
const _GRACE := 3

## By the instance id of who offers it, in the order of the offers.
var environments: Dictionary[int, LobeLight] = {}
## By the instance id of the probe.
var probes: Dictionary[int, LobeLight] = {}
## The environments that are making their first light.
var pending: Dictionary[int, bool] = {}
## What the current light fades in over, and its share from 0 to 1; null if it does not.
var faded: LobeLight
var share := 1.0
var fade_time := 0.0

# What was shown before the last offer was taken back.
var _kept: LobeLight
var _kept_owner := 0
var _grace := 0
var _world: WeakRef


func _init(world: World3D) -> void:
	_world = weakref(world)


## Whether nothing can be shown any more.
func has_gone() -> bool:
	return _world.get_ref() == null and environments.is_empty() and probes.is_empty()


## What the environment of this world shows; null if there is nothing.
func get_light() -> LobeLight:
	return environments.values().back() if not environments.is_empty() else _kept


## Whether what is shown is not from this owner.
func is_lit_by_other(owner: int) -> bool:
	if environments.is_empty():
		return _kept != null and _kept_owner != owner
	return environments.keys().back() != owner


func is_empty() -> bool:
	return environments.is_empty() and probes.is_empty() and pending.is_empty() and _kept == null


## Whether [method age] has to be called once a frame.
func is_aging() -> bool:
	return _kept != null and environments.is_empty() or faded != null


func offer(owner: int, light: LobeLight, seconds: float) -> void:
	var before := get_light()
	pending.erase(owner)
	environments[owner] = light
	_kept = null
	if seconds > 0.0 and before != null and before != light and get_light() == light:
		faded = before
		share = 0.0
		fade_time = seconds


## Whether there was such an offer.
func withdraw(owner: int) -> bool:
	var before := get_light()
	if not environments.erase(owner):
		return false
	faded = null
	share = 1.0
	if environments.is_empty():
		_kept = before
		_kept_owner = owner
		_grace = _GRACE
	return true


## A frame has passed; whether what is shown has changed.
func age(seconds: float) -> bool:
	var changed := false
	if faded != null:
		share = minf(share + seconds / fade_time, 1.0)
		if share == 1.0:
			faded = null
		changed = true
	if _kept != null and pending.is_empty():
		_grace -= 1
		if _grace <= 0:
			_kept = null
			changed = true
	return changed
