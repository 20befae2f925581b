@tool
extends Object
## Where the diffuse light of materials comes from: from the environments and probes of this addon,
## or from the engine, with its ambient light, lightmaps and global illumination. Decided here, for
## all materials.
##
## A script that is loaded on demand watches what engine light the lit worlds have
## (engine_light/engine_watch.gd); exports leave it out if no file of the project has such light.

enum Source { AUTOMATIC, ENVIRONMENT, ENGINE }

const OnDemand := preload("../on_demand.gd")

## What AUTOMATIC stands for, project-wide.
const SETTING := "lobelight/materials/diffuse_light"
const _WATCH := "res://addons/lobelight/runtime/engine_light/engine_watch.gd"

# By material, what is not AUTOMATIC. Under the registry's lock.
static var _choices: Dictionary[RID, Source] = {}
static var _watch_script: GDScript
static var _watch: RefCounted


static func choose(material: RID, source: Source) -> void:
	if source == Source.AUTOMATIC:
		_choices.erase(material)
	else:
		_choices[material] = source


static func forget_material(material: RID) -> void:
	_choices.erase(material)


## The #defines of a material with diffuse light, without LOBELIGHT_.
static func get_defines(material: RID) -> PackedStringArray:
	var source: Source = _choices.get(material, Source.AUTOMATIC)
	if source == Source.AUTOMATIC:
		source = ProjectSettings.get_setting(SETTING, Source.AUTOMATIC)
	if source == Source.AUTOMATIC:
		var has_engines: bool = _watch != null and _watch.has_global_illumination
		source = Source.ENGINE if has_engines else Source.ENVIRONMENT
	if source == Source.ENGINE and OnDemand.fetch(_WATCH, OnDemand.ENGINE_LIGHT) != null:
		return ["ENGINE", "ENGINE_DIFFUSE"]
	if _watch != null and _watch.has_screen_occlusion:
		return ["ENGINE", "SCREEN_OCCLUSION"]
	return []


## Loads the script. Not to be called under the registry's lock: loading may wait for threads that
## wait for the lock.
static func load_watch() -> void:
	if _watch_script == null and OnDemand.find_loss(_WATCH, OnDemand.ENGINE_LIGHT).is_empty():
		_watch_script = OnDemand.fetch(_WATCH, OnDemand.ENGINE_LIGHT) as GDScript


## These worlds are lit, some of them [param with_probes]: what the engine has in them counts from
## now on. Whether that is something else than before; [param on_change] is called when it becomes
## so later.
static func follow(
	worlds: Array[World3D], with_probes: Array[World3D], on_change: Callable
) -> bool:
	if worlds.is_empty() or _watch_script == null:
		var had_any: bool = _watch != null and _watch.has_any()
		end()
		return had_any
	if _watch == null:
		_watch = _watch_script.new(on_change)
	return _watch.follow(worlds, with_probes)


static func end() -> void:
	if _watch != null:
		_watch.end()
	_watch = null


static func forget() -> void:
	end()
	_watch_script = null
	_choices.clear()
