@tool
extends RefCounted
## What the camera of a node's viewport sees around the scene: the environment that the engine would
## take, a copy of it for the views, and whether it has changed.

const EvenLight := preload("even_light.gd")
const LiveTextures := preload("../light/live_textures.gd")

# What there is behind the scene, and the fog before it.
const _BACKGROUND: Array[StringName] = [
	&"background_mode",
	&"background_color",
	&"background_energy_multiplier",
	&"background_intensity",
	&"sky",
	&"sky_rotation",
	&"fog_enabled",
	&"fog_mode",
	&"fog_light_color",
	&"fog_light_energy",
	&"fog_sun_scatter",
	&"fog_density",
	&"fog_aerial_perspective",
	&"fog_sky_affect",
]
# What counts with fog only.
const _FOG: Array[StringName] = [
	&"fog_mode",
	&"fog_light_color",
	&"fog_light_energy",
	&"fog_sun_scatter",
	&"fog_density",
	&"fog_aerial_perspective",
	&"fog_sky_affect",
	&"fog_height",
	&"fog_height_density",
	&"fog_depth_curve",
	&"fog_depth_begin",
	&"fog_depth_end",
]
# What else there is to objects in it.
const _LIGHTING: Array[StringName] = [
	&"ambient_light_source",
	&"ambient_light_color",
	&"ambient_light_energy",
	&"ambient_light_sky_contribution",
	&"reflected_light_source",
	&"fog_height",
	&"fog_height_density",
	&"fog_depth_curve",
	&"fog_depth_begin",
	&"fog_depth_end",
]

## What the views are to be drawn with: the same background and, for scenes, the same ambient light,
## without the camera's tone mapping and effects.
var copy := Environment.new()

var _node: Node3D
var _with_scene: bool
# The values that the last look saw, and how many of them this look has compared.
var _seen: Array = []
var _count := 0
var _differs := false
var _texture_changed := false
# A short form of these, for a quick look, and whether a texture of the sky changes by itself.
var _state: Array = []
var _is_live := false
# The sky material whose properties these are, and its shader.
var _material: Material
var _shader: Shader
var _names: Array[StringName] = []


func _init(node: Node3D, with_scene: bool) -> void:
	_node = node
	_with_scene = with_scene
	copy.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	copy.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	copy.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED


## The environment that the engine takes for the viewport's camera; null if there is none.
func find_environment() -> Environment:
	var camera := find_camera()
	if camera != null and camera.environment != null:
		return camera.environment
	var world := _node.get_world_3d()
	return world.environment if world.environment != null else world.fallback_environment


## The camera that sees the sky: null in the editor, and where nothing is shown.
func find_camera() -> Camera3D:
	return _node.get_viewport().get_camera_3d()


## Whether light comes evenly from all sides: there is no sky that lights anything, and no fog
## before the background, which the sun would colour.
func is_even() -> bool:
	var environment := find_environment()
	if environment == null:
		return true
	return not _is_lit_by_sky(environment) and not _is_fog_seen(environment)


## That light, linear: what the engine takes for ambient light, or where it is to take none, the
## background's colour. [EvenLight] has the rules.
func find_even_light() -> Color:
	return EvenLight.of(find_environment())


## Why that light is none, or shows nothing, and what to do, in a sentence; empty if it is as meant.
func find_shortage() -> String:
	return EvenLight.find_shortage(find_environment())


## The panorama, if it is all that there is to the sky; otherwise null.
func find_panorama() -> Texture2D:
	var environment := find_environment()
	if environment == null or environment.fog_enabled or not _is_lit_by_sky(environment):
		return null
	var material := environment.sky.sky_material as PanoramaSkyMaterial
	return material.panorama if material != null else null


## What the panorama's light is multiplied by.
func find_panorama_energy() -> float:
	var environment := find_environment()
	var material := environment.sky.sky_material as PanoramaSkyMaterial
	var factor := material.energy_multiplier * environment.background_energy_multiplier
	if ProjectSettings.get_setting("rendering/lights_and_shadows/use_physical_light_units"):
		factor *= environment.background_intensity
	return factor


## From the sky to the world.
func find_sky_rotation() -> Basis:
	return Basis.from_euler(find_environment().sky_rotation)


## Brings [member copy] up to date; whether anything that shows has changed since the last call.
func update() -> bool:
	if not _has_moved():
		return false
	_count = 0
	_is_live = false
	_differs = _texture_changed
	_texture_changed = false
	var environment := find_environment()
	_look_at(environment)
	if environment == null:
		copy.background_mode = Environment.BG_CLEAR_COLOR
		copy.fog_enabled = false
	else:
		_copy_properties(environment, _BACKGROUND)
		if _with_scene:
			_copy_properties(environment, _LIGHTING)
		_copy_background(environment)
		if environment.sky != null:
			_look_at_sky(environment.sky)
	_look_at(RenderingServer.get_default_clear_color())
	_seen.resize(_count)
	return _differs


# Whether a look in detail is needed. It is asked in each frame, and calls as little as it can.
func _has_moved() -> bool:
	var environment := find_environment()
	var material: Material = null
	var state := [environment, RenderingServer.get_default_clear_color()]
	if environment != null:
		var sky := environment.sky
		material = sky.sky_material if sky != null else null
		(
			state
			. append_array(
				[
					sky,
					material,
					(material as ShaderMaterial).shader if material is ShaderMaterial else null,
					environment.background_mode,
					environment.background_color,
					environment.background_energy_multiplier,
					environment.background_intensity,
					environment.sky_rotation,
					environment.ambient_light_source,
					environment.reflected_light_source,
					environment.fog_enabled,
				]
			)
		)
		if environment.fog_enabled:
			for name in _FOG:
				state.append(environment.get(name))
		if _with_scene:
			(
				state
				. append_array(
					[
						environment.ambient_light_color,
						environment.ambient_light_energy,
						environment.ambient_light_sky_contribution,
					]
				)
			)
	if material != null and material == _material:
		for name in _names:
			state.append(material.get(name))
	var has_moved := _texture_changed or _is_live or state != _state
	_state = state
	return has_moved


func _copy_background(environment: Environment) -> void:
	copy.background_mode = environment.background_mode
	copy.background_color = environment.background_color
	var is_sky := not _with_scene and _is_lit_by_sky(environment)
	_look_at(is_sky)
	if is_sky:
		# Seen or not.
		copy.background_mode = Environment.BG_SKY
	elif environment.background_mode > Environment.BG_SKY:
		# Canvases, camera feeds and "keep" are no light.
		copy.background_mode = Environment.BG_COLOR
		copy.background_color = Color.BLACK


# As the engine asks (Godot 4.6, render_scene_data_rd.cpp, update_ubo): a sky may light what is
# before another background.
static func _is_lit_by_sky(environment: Environment) -> bool:
	if environment.sky == null:
		return false
	return (
		environment.background_mode == Environment.BG_SKY
		or environment.ambient_light_source == Environment.AMBIENT_SOURCE_SKY
		or environment.reflected_light_source == Environment.REFLECTION_SOURCE_SKY
	)


static func _is_fog_seen(environment: Environment) -> bool:
	return (
		environment.fog_enabled
		and environment.fog_sky_affect > 0.0
		and environment.background_mode in [Environment.BG_CLEAR_COLOR, Environment.BG_COLOR]
	)


func _copy_properties(environment: Environment, names: Array[StringName]) -> void:
	for name in names:
		var value: Variant = environment.get(name)
		if _look_at(value):
			copy.set(name, value)


func _look_at_sky(sky: Sky) -> void:
	var material := sky.sky_material
	_look_at(material)
	if material == null:
		return
	var shader: Shader = (material as ShaderMaterial).shader if material is ShaderMaterial else null
	if material != _material or shader != _shader:
		_material = material
		_shader = shader
		_names = _stored_names(material)
	for name in _names:
		var value: Variant = material.get(name)
		if _look_at(value) and value is Texture2D:
			var texture: Texture2D = value
			if not texture.changed.is_connected(_on_texture_changed):
				texture.changed.connect(_on_texture_changed)
		_is_live = _is_live or LiveTextures.is_live(value)
	_differs = _differs or _is_live


# Whether a value is another than at the last look.
func _look_at(value: Variant) -> bool:
	var differs := true
	if _count < _seen.size():
		differs = typeof(_seen[_count]) != typeof(value) or _seen[_count] != value
		_seen[_count] = value
	else:
		_seen.append(value)
	_count += 1
	_differs = _differs or differs
	return differs


func _on_texture_changed() -> void:
	_texture_changed = true


static func _stored_names(object: Object) -> Array[StringName]:
	var names: Array[StringName] = []
	for property in object.get_property_list():
		if property.usage & PROPERTY_USAGE_STORAGE and not property.name.begins_with("resource_"):
			names.append(property.name)
	return names
