@tool
extends RefCounted
## The lights of one world: what its environments and probes have given, and what is shown until
## they have.

# A light that is taken back stays for this many frames, in case the next scene has an environment.
# While that one makes its first light, the old light stays longer.
const _GRACE := 3
# The most lights that are still seen under those that fade in; older ones are dropped.
const _MOST_FADED := 2

## The lights of environments, by the instance ids of who offers them, in the order of the offers.
var environments: Dictionary[int, LobeLight] = {}
## The lights of probes, by the probes' instance ids.
var probes: Dictionary[int, LobeLight] = {}
## The environments that are making their first light.
var pending: Dictionary[int, bool] = {}
## The lights that the current one fades in over, the newest first.
var faded: Array[LobeLight] = []
## By the same index: the share, from 0 to 1, of what has faded in over that light.
var shares: Array[float] = []

# By the same index, in seconds.
var _fade_times: Array[float] = []
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


## The world; null if it has gone.
func get_world() -> World3D:
	return _world.get_ref()


## Whether there is anything to show.
func is_lit() -> bool:
	return get_light() != null or not probes.is_empty()


## Whether what is shown is not from this owner.
func is_lit_by_other(owner: int) -> bool:
	if environments.is_empty():
		return _kept != null and _kept_owner != owner
	return environments.keys().back() != owner


func is_empty() -> bool:
	return environments.is_empty() and probes.is_empty() and pending.is_empty() and _kept == null


## Whether [method age] has to be called once a frame.
func is_aging() -> bool:
	return _kept != null or not faded.is_empty()


func offer(owner: int, light: LobeLight, seconds: float) -> void:
	var before := get_light()
	pending.erase(owner)
	environments[owner] = light
	_kept = null
	if seconds <= 0.0 or before == null or before == light or get_light() != light:
		return
	faded.push_front(before)
	shares.push_front(0.0)
	_fade_times.push_front(seconds)
	_forget_faded(_MOST_FADED)


## Whether there was such an offer.
func withdraw(owner: int) -> bool:
	var before := get_light()
	if not environments.erase(owner):
		return false
	if environments.is_empty():
		_kept = before
		_kept_owner = owner
		_grace = _GRACE
	elif get_light() != before:
		_forget_faded(0)
	return true


## A frame has passed; whether what is shown has changed.
func age(seconds: float) -> bool:
	var changed := not faded.is_empty()
	for i in faded.size():
		shares[i] = minf(shares[i] + seconds / _fade_times[i], 1.0)
		if shares[i] == 1.0:
			_forget_faded(i)
			break
	if _kept != null and pending.is_empty():
		_grace -= 1
		if _grace <= 0:
			_kept = null
			_forget_faded(0)
			changed = true
	return changed


func _forget_faded(count: int) -> void:
	if faded.size() > count:
		faded.resize(count)
		shares.resize(count)
		_fade_times.resize(count)
