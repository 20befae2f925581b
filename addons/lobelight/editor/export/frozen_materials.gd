@tool
extends RefCounted
## Materials that nothing changes while the game runs, as exports can have them: as a shader of one
## text and what it takes (runtime/frozen/frozen_material.gd). What makes these of a material's
## properties, tables and all, then stays out of the export. All materials of a project are frozen,
## or none: one that is not needs all of that.
##
## Where lights may have sources, each material has a second shader for these.
##
## A script that names the class of materials, or a property or method of theirs, may change one,
## and so may an animation. The light may change as long as every light takes the same shader.

const Features := preload("features.gd")
const FileBytes := preload("file_bytes.gd")
const FlatShader := preload("flat_shader.gd")
const FrozenMaterial := preload("../../runtime/frozen/frozen_material.gd")
const GivenParameters := preload("../../runtime/material/given_parameters.gd")
const LobeReduction := preload("lobe_reduction.gd")
const MaterialParameters := preload("../../runtime/material/material_parameters.gd")
const OnDemand := preload("../../runtime/on_demand.gd")
const TableChoice := preload("../../runtime/material/table_choice.gd")

## What has other shaders for other lights.
const _LIGHTS: PackedStringArray = [OnDemand.PLACES, OnDemand.ENGINE_LIGHT, OnDemand.FILTERS]
# Where exports have the shaders.
const _FOLDER := "res://addons/lobelight/frozen/"
const _CLASSES := "Lobe(Base)?Material3D|LobeTable(Set)?|LobeLight|LobeGLTFExtension"
const _LIMITED := "#define LOBELIGHT_LIMITED_BY_ENGINE\n"
const _LIMITED_AT_RUN_TIME := (
	"#if CURRENT_RENDERER != RENDERER_COMPATIBILITY\n" + _LIMITED + "#endif\n"
)
const _LIMITER := "rendering/anti_aliasing/screen_space_roughness_limiter/enabled"

## Why materials stay as they are, in a sentence; empty if they are frozen.
var why_not := ""
## What is exported in place of files with materials, by their paths.
var files: Dictionary[String, PackedByteArray] = {}
## By the same paths: what these files depend on.
var dependencies: Dictionary[String, PackedStringArray] = {}
## The shaders' files, by their paths in the export.
var shaders: Dictionary[String, PackedByteArray] = {}

# The files that have materials.
var _homes: Dictionary[String, bool] = {}
var _naming := RegEx.new()
# What concerns shaders of one's own.
var _of_others := RegEx.create_from_string(
	"\\bLobeLight\\.(un)?bind\\b|\\baddons/lobelight/lobelight\\.gdshaderinc\\b"
)
var _made: Dictionary[int, FrozenMaterial] = {}
var _shaders: Dictionary[String, Shader] = {}
var _count := 0
var _has_sources := false


func _init() -> void:
	var names: PackedStringArray = []
	for script: Script in [LobeMaterial3D as Script, LobeBaseMaterial3D as Script]:
		for property in script.get_script_property_list():
			if property["usage"] & PROPERTY_USAGE_SCRIPT_VARIABLE:
				names.append(property["name"])
		for method in script.get_script_method_list():
			names.append(method["name"])
	var public := Array(names).filter(func(name: String) -> bool: return name[0] not in "_@")
	var words := "|".join(PackedStringArray(public))
	_naming.compile("\\b(%s)\\b|addons/lobelight|[.\"'&^:/](%s)\\b" % [_CLASSES, words])


## A line of a script, or the path of an animation's track.
func read_line(file: String, line: String) -> void:
	var found := _naming.search(_of_others.sub(line, "", true))
	if found != null:
		_refuse("%s names %s" % [file, found.get_string().lstrip(".\"'&^:/")])


## For what may set any property.
func add_all(file: String) -> void:
	_refuse("%s sets properties that it does not name" % file)


func look_at_light(file: String, light: LobeLight) -> void:
	if not light.is_even:
		_refuse("the light in %s takes another shader than most" % file)


func look_at_material(file: String, material: LobeMaterial3D) -> void:
	var home := material.resource_path.get_slice("::", 0)
	home = home if home else file
	_homes[home] = true
	if material.get_script() != LobeMaterial3D:
		_refuse("%s has a material of another class" % home)
	elif not LobeReduction.can_edit(home):
		_refuse("%s is imported, and exported as it is" % home)
	elif material.has_stencil_pass():
		_refuse("%s has a material with a second pass for its stencil" % home)


func is_frozen() -> bool:
	return why_not.is_empty()


## [param find] gives, by its path, a resource as it is to be exported.
func freeze(features: Features, find: Callable) -> void:
	_has_sources = features.reached.has(OnDemand.SOURCES)
	for feature in _LIGHTS:
		if features.reached.has(feature):
			_refuse("%s asks for %s" % [features.reached[feature], feature])
	if _homes.is_empty():
		_refuse("there are none")
	for file in _homes:
		if why_not.is_empty():
			_freeze_file(file, find.call(file))
	if why_not.is_empty():
		for code in _shaders:
			shaders[_shaders[code].resource_path] = FileBytes.of(_shaders[code], "res")
	else:
		files.clear()
	_made.clear()


func get_shader_size() -> int:
	return shaders.values().reduce(
		func(sum: int, bytes: PackedByteArray) -> int: return sum + bytes.size(), 0
	)


func describe() -> String:
	if why_not:
		return "Materials keep their properties: %s" % why_not
	return (
		"Materials are frozen: no script or animation names what they have; shaders: %d bytes"
		% get_shader_size()
	)


func _refuse(why: String) -> void:
	if why_not.is_empty():
		why_not = why


func _freeze_file(file: String, resource: Resource) -> void:
	_count = 0
	var frozen := _replace(resource, {}) as Resource
	var named: Array[String] = []
	var bytes := FileBytes.of(frozen, "scn" if frozen is PackedScene else "res", named)
	if bytes.is_empty():
		_refuse("%s cannot be written" % file)
	for path in named:
		if path.begins_with(Features.RUN_TIME + "material/"):
			_refuse("%s has a material that cannot be exchanged" % file)
	files[file] = bytes
	dependencies[file] = PackedStringArray(named)


# What stands in for a value: another one, or itself, where materials in it have been exchanged.
func _replace(value: Variant, seen: Dictionary[int, bool]) -> Variant:
	if value is Array:
		for i in (value as Array).size():
			value[i] = _replace(value[i], seen)
	elif value is Dictionary:
		for key: Variant in value:
			value[key] = _replace(value[key], seen)
	elif value is LobeMaterial3D and (seen.is_empty() or _is_part(value)):
		seen[value.get_instance_id()] = true
		return _get_frozen(value, seen)
	elif value is Resource and (seen.is_empty() or _is_part(value)):
		if not seen.has(value.get_instance_id()):
			seen[value.get_instance_id()] = true
			_replace_in(value, seen)
	return value


# Whether a resource has no file of its own: those that have are exchanged there.
static func _is_part(resource: Resource) -> bool:
	return resource.resource_path.is_empty() or resource.resource_path.contains("::")


func _replace_in(resource: Resource, seen: Dictionary[int, bool]) -> void:
	if resource is ArrayMesh:
		_replace_in_mesh(resource, seen)
	elif resource is not Script:
		for property in resource.get_property_list():
			if property["usage"] & PROPERTY_USAGE_STORAGE:
				_replace_property(resource, property["name"], seen)


func _replace_property(resource: Resource, name: StringName, seen: Dictionary[int, bool]) -> void:
	var before: Variant = resource.get(name)
	if before is Array or before is Dictionary or before is Object:
		var count := _count
		var after: Variant = _replace(before, seen)
		if count != _count:
			resource.set(name, after)


func _replace_in_mesh(mesh: ArrayMesh, seen: Dictionary[int, bool]) -> void:
	for surface in mesh.get_surface_count():
		mesh.surface_set_material(
			surface, _replace(mesh.surface_get_material(surface), seen) as Material
		)


func _get_frozen(material: LobeMaterial3D, seen: Dictionary[int, bool]) -> ShaderMaterial:
	_count += 1
	var id := material.get_instance_id()
	if not _made.has(id):
		_made[id] = make(material)
		_made[id].next_pass = _replace(material.next_pass, seen) as Material
	return _made[id]


## A material as exports have it, but for its next pass. It is given a light of its own.
func make(material: LobeMaterial3D) -> FrozenMaterial:
	var frozen := FrozenMaterial.new()
	frozen.resource_name = material.resource_name
	frozen.resource_local_to_scene = material.resource_local_to_scene
	frozen.render_priority = material.render_priority
	frozen.light = material.light
	for key in material.get_meta_list():
		frozen.set_meta(key, material.get_meta(key))
	# What the scenes that are open in the editor have is not to count.
	if material.light == null:
		material.light = LobeLight.make_dark(true)
	elif material.light.has_box():
		_refuse("a material shows the light of a box wherever it is")
	frozen.shader = _get_shader(_find_code(material))
	if _has_sources and frozen.light == null:
		material.light.sources = PlaceholderTexture2D.new()
		frozen.shader_for_sources = _get_shader(_find_code(material))
	var choice := TableChoice.new()
	choice.choose(material)
	frozen.width = choice.get_narrowest()
	var give := MaterialParameters.apply.bind(material, choice)
	var given := GivenParameters.hear(material.get_rid(), give)
	var textures := _find_textures(material, choice)
	for name: StringName in given.keys():
		if given[name] is RID:
			given[name] = textures.get(given[name])
			if given[name] == null:
				_refuse("a texture of a material, %s, cannot be written" % name)
		elif given[name] == null:
			given.erase(name)
	frozen.parameters = given
	return frozen


func _find_code(material: LobeMaterial3D) -> String:
	var code := material.get_shader_code().replace(_LIMITED, "")
	if "#define LOBELIGHT_ENGINE\n" in code:
		_refuse("the engine lights what is open in the editor")
	if material.is_antialiased() and ProjectSettings.get_setting(_LIMITER, true):
		code = code.replace("#include", _LIMITED_AT_RUN_TIME + "#include")
	return code


# The textures that a material's parameters may be, by their ids.
static func _find_textures(
	material: LobeMaterial3D, choice: TableChoice
) -> Dictionary[RID, Texture]:
	var found: Array[Texture] = []
	for property in material.get_property_list():
		var value: Variant = material.get(property["name"])
		if value is Texture:
			found.append(value)
	for table: LobeTable in [choice.table, choice.coat, choice.sheen]:
		if table != null:
			found.append(table.get_texture())
	if choice.widths_texture != null:
		found.append(choice.widths_texture.texture)
	var by_id: Dictionary[RID, Texture] = {}
	for texture in found:
		# What is made of several pictures, an engine without a renderer cannot give back.
		if texture is Texture2D:
			by_id[texture.get_rid()] = texture
	return by_id


func _get_shader(code: String) -> Shader:
	if not _shaders.has(code):
		var flat := FlatShader.of(code)
		if flat.problem:
			_refuse(flat.problem)
		var shader := Shader.new()
		shader.code = flat.code
		# That of an earlier export may still be there.
		shader.take_over_path(_FOLDER + flat.code.md5_text() + ".res")
		_shaders[code] = shader
	return _shaders[code]
