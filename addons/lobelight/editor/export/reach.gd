@tool
extends RefCounted
## Which ready sets of tables a project's files can reach, and which widths of them.
##
## Scenes and resources are loaded and looked through; scripts are read as text. A number that a
## script assigns counts; anything else that it does with a width is unknown, and then all widths
## are kept. A scene can say what its scripts do: the metadata [code]lobelight_reach[/code] of its
## root, as [code]{"roughness": [0.2, 0.5], "anisotropy": [0.0, 0.9]}[/code], stands in for what is
## not known of them.

const Features := preload("features.gd")
const FrozenMaterials := preload("frozen_materials.gd")
const LobeReduction := preload("lobe_reduction.gd")
const OwnShaders := preload("own_shaders.gd")
const ProjectFiles := preload("project_files.gd")
const SetReach := preload("set_reach.gd")
const OnDemand := preload("../../runtime/on_demand.gd")
const TableChoice := preload("../../runtime/material/table_choice.gd")
const Widths := preload("../../runtime/table/widths.gd")

const TABLES := "res://addons/lobelight/tables/"
const DECLARATION := "metadata/lobelight_reach"
const WIDTHS := "roughness|anisotropy|clearcoat_roughness|clearcoat"
const TEXTURES := "roughness_texture|orm_texture|anisotropy_flowmap"

## By the path of the set.
var sets: Dictionary[String, SetReach] = {}
## What of them stays where materials are frozen: what shaders of one's own draw.
var sets_of_others: Dictionary[String, SetReach] = {}
## How many materials of the addon were found.
var material_count := 0
var features := Features.new()
## Whether materials can be frozen.
var frozen := FrozenMaterials.new()
## Tables of materials that are of no set: [file, table].
var own_tables: Array[Array] = []
## Materials that draw fewer lobes than their sets have.
var lobes := LobeReduction.new()

# Each is [file, material].
var _materials: Array[Array] = []
var _own_shaders := OwnShaders.new()
var _numbers: Dictionary[String, PackedFloat64Array] = {}
var _unknown: PackedStringArray = []
var _declared := false
# Files that may make materials; those have what a new one has, and what scripts assign.
var _made_by_script: Dictionary[String, bool] = {}
# Whether a script may switch anisotropy or quality, so that a table draws long widths.
var _switches_anisotropy := false
# A script that names what sheens have.
var _sheen_script := ""
var _named_sets: Dictionary[String, String] = {}
var _seen: Dictionary[int, bool] = {}
var _assignment := RegEx.create_from_string(
	"\\.(%s)\\s*=\\s*(-?[0-9]*\\.?[0-9]+)\\s*;?\\s*(#.*|//.*)?$" % WIDTHS
)
var _mention := RegEx.create_from_string("\\b(%s|%s)\\b" % [WIDTHS, TEXTURES])
# Properties whose names are not written there.
var _dynamic := RegEx.create_from_string(
	(
		"\\.(set|set_deferred|set_indexed|Set|SetDeferred|SetIndexed)\\(\\s*[^\"'&^\\s)]"
		+ "|\\b(tween_property|TweenProperty)\\([^,]+,\\s*[^\"'&^\\s]"
	)
)
# Where the class is named only to say what a variable holds.
var _type := RegEx.create_from_string(
	"(:|->|\\bas\\b|\\bis\\b|\\bnot\\b|\\[|,)\\s*LobeMaterial3D\\b(?!\\s*\\.)"
)
# Materials with widths that the line does not tell.
var _other_widths := RegEx.create_from_string(
	(
		"\\bLobeGLTFExtension\\b|\\bextends\\s+(LobeMaterial3D|.*lobe_material_3d)"
		+ "|\\b(from_standard|table_at)\\("
		+ "|\\b(table|table_set)\\s*=\\s*null\\b"
	)
)
var _mentioned_set := RegEx.create_from_string("(\\w+)\\.res\\b")


## What a list of files reaches. Files of this addon say nothing. With a [param target], in dB,
## materials get the fewest lobes that reach it.
static func of_files(files: PackedStringArray, target := 0.0) -> RefCounted:
	var reach := new()
	reach.lobes.target = target
	for file in files:
		if not file.begins_with("res://addons/lobelight/"):
			reach._read(file)
	reach._conclude()
	return reach


func _read(file: String) -> void:
	var ending := file.get_extension()
	if ending in ProjectFiles.SCRIPTS:
		_read_script(file, FileAccess.get_file_as_string(file))
	elif ending in ProjectFiles.SCENES:
		_look_at_scene(file, ResourceLoader.load(file) as PackedScene)
	elif ending in ProjectFiles.RESOURCES:
		_look_at(file, ResourceLoader.load(file))
	elif ending in ProjectFiles.SHADERS:
		_own_shaders.look_at_file(file)


func _look_at_scene(file: String, scene: PackedScene) -> void:
	if scene == null:
		_unknown.append("%s cannot be read" % file)
		frozen.add_all(file)
		return
	var state := scene.get_state()
	for node in state.get_node_count():
		var properties := {}
		for property in state.get_node_property_count(node):
			var value: Variant = state.get_node_property_value(node, property)
			properties[String(state.get_node_property_name(node, property))] = value
			if state.get_node_property_name(node, property) == DECLARATION and value is Dictionary:
				_declare(value)
			else:
				_look_at(file, value)
		features.look_at_node(file, properties, state.get_node_type(node))


func _declare(ranges: Dictionary) -> void:
	_declared = true
	for key: String in ["roughness", "anisotropy"]:
		for number: float in ranges.get(key, []):
			_add_number(key, number)


# A value of a property, and what it holds.
func _look_at(file: String, value: Variant) -> void:
	if value is Array or value is Dictionary:
		for part: Variant in value if value is Array else (value as Dictionary).values():
			_look_at(file, part)
		return
	var resource := value as Resource if value is Object else null
	if resource == null or _seen.has(resource.get_instance_id()):
		return
	_seen[resource.get_instance_id()] = true
	if resource is PackedScene:
		_look_at_scene(file, resource)
	elif resource is Script:
		if resource.resource_path.is_empty() or "::" in resource.resource_path:
			_read_script(file, (resource as Script).source_code)
	elif resource is LobeMaterial3D:
		_materials.append([file, resource])
		features.look_at_material(file, resource)
		frozen.look_at_material(file, resource)
		_look_at(file, (resource as LobeMaterial3D).next_pass)
		_look_at(file, (resource as LobeMaterial3D).light)
	elif resource is LobeLight:
		features.look_at_light(file, resource)
		frozen.look_at_light(file, resource)
	elif resource is LobeTableSet:
		# A script may give it to a material.
		_named_sets[resource.resource_path] = file
	elif resource is Animation:
		_look_at_animation(file, resource)
	else:
		features.look_at_resource(file, resource)
		if resource is PanoramaSkyMaterial:
			lobes.add_panorama((resource as PanoramaSkyMaterial).panorama)
		if resource is Shader:
			_own_shaders.look_at_shader(file, resource)
		if resource is LobeShaderMaterial:
			_own_shaders.look_at_material(resource)
		_look_at_properties(file, resource)


func _look_at_properties(file: String, resource: Resource) -> void:
	for property in resource.get_property_list():
		# Which of a set's tables such a material draws says its shader.
		var is_set: bool = resource is LobeShaderMaterial and property["name"] == "table_set"
		if property["usage"] & PROPERTY_USAGE_STORAGE and not is_set:
			_look_at(file, resource.get(property["name"]))


func _look_at_animation(file: String, animation: Animation) -> void:
	for track in animation.get_track_count():
		var path := String(animation.track_get_path(track))
		features.read_line(file, path)
		frozen.read_line(file, path)
		if _mention.search(path) != null:
			_unknown.append("%s animates %s" % [file, path])


func _read_script(file: String, text: String) -> void:
	for line in text.split("\n"):
		var code := line.strip_edges()
		if code.begins_with("#") or code.begins_with("//"):
			continue
		features.read_line(file, code)
		frozen.read_line(file, code)
		_own_shaders.read_line(file, code)
		if _dynamic.search(code) != null or _other_widths.search(code) != null:
			features.add_all(file)
			frozen.add_all(file)
		var assigned := _assignment.search(code)
		if "anisotropy_enabled" in code or "quality" in code:
			_switches_anisotropy = true
		if "sheen_" in code:
			_sheen_script = file
		if "clearcoat_enabled" in code:
			_add_number("clearcoat", 1.0)
		if assigned != null:
			_add_number(assigned.get_string(1), assigned.get_string(2).to_float())
		elif _mention.search(code) != null or _dynamic.search(code) != null:
			_unknown.append("%s: %s" % [file, code.left(80)])
		for found in _mentioned_set.search_all(code):
			var path := TABLES + found.get_string(0)
			if FileAccess.file_exists(path):
				_named_sets[path] = file
		var no_types := _type.sub(code, "", true)
		if "LobeMaterial3D" in no_types or "lobe_material_3d" in no_types:
			_made_by_script[file] = true
		if _other_widths.search(code) != null:
			_unknown.append("%s: %s" % [file, code.left(80)])
			_made_by_script[file] = true


func _add_number(property: String, number: float) -> void:
	if not _numbers.has(property):
		_numbers[property] = PackedFloat64Array()
	_numbers[property].append(number)


func _conclude() -> void:
	material_count = _materials.size() + _made_by_script.size()
	for environment in features.environments:
		lobes.add_panorama((environment[1] as Dictionary).get("panorama"))
	if _declared or not _unknown.is_empty() or not _numbers.is_empty():
		lobes.why_none = (
			"scripts or animations change widths, those of materials without the metadata %s"
			% LobeReduction.FIXED
		)
	for entry in _materials:
		if not lobes.reduce(entry[0], entry[1]):
			_include(entry[0], entry[1])
	for table: LobeReduction.ReducedTable in lobes.tables.values():
		own_tables.append([table.users[0], table.table])
	for file in _made_by_script:
		_include(file, LobeMaterial3D.new())
	_include_coats()
	_include_sheens()
	_include_own_shaders()
	for path in _named_sets:
		var named := _get_set(path)
		# The script may ask it for any table.
		named.whole_because = "%s names it" % _named_sets[path]
		named.add_user(_named_sets[path])
		if features.reached.has(OnDemand.OWN_SHADERS):
			sets_of_others[path] = named
	for reach: SetReach in sets.values():
		reach.is_filled = _declared
		if not _declared and not _unknown.is_empty() and reach.whole_because.is_empty():
			reach.whole_because = _unknown[0]


func _include_coats() -> void:
	if not features.reached.has(Features.COAT):
		return
	var coats := _get_set(TableChoice.COAT_SET)
	for entry in _materials:
		_include_coat(coats, entry[0], entry[1])
	for file in _made_by_script:
		_include_coat(coats, file, LobeMaterial3D.new())
	if coats.surfaces.is_empty():
		coats.whole_because = "a script may ask for any"
		coats.add_user(features.reached[Features.COAT])


func _include_coat(coats: SetReach, file: String, material: LobeMaterial3D) -> void:
	var own := material.clearcoat if material.clearcoat_enabled else 0.0
	if _all_of("clearcoat", own).max() <= 0.0:
		return
	coats.add_user(file)
	for roughness in _all_of("clearcoat_roughness", material.clearcoat_roughness):
		coats.add_surface(Vector2.ONE * Widths.from_coat_roughness(roughness))


func _include_sheens() -> void:
	if not features.reached.has(Features.SHEEN):
		return
	var sheens := _get_set(TableChoice.SHEEN_SET)
	for entry in _materials:
		var material: LobeMaterial3D = entry[1]
		if material.has_sheen():
			sheens.add_user(entry[0])
			sheens.add_surface(Vector2.ONE * material.sheen_roughness * material.sheen_roughness)
	if sheens.surfaces.is_empty() or not _sheen_script.is_empty():
		sheens.whole_because = "a script may ask for any"
		sheens.add_user(features.reached[Features.SHEEN])


func _include_own_shaders() -> void:
	_own_shaders.conclude(features)
	sets_of_others = _own_shaders.sets
	for path in sets_of_others:
		var reach := _get_set(path)
		for file in sets_of_others[path].needed_by:
			reach.add_user(file)
		for surface in sets_of_others[path].surfaces:
			reach.add_surface(surface)
		if reach.whole_because.is_empty():
			reach.whole_because = sets_of_others[path].whole_because
		if reach.isotropic_because.is_empty():
			reach.isotropic_because = sets_of_others[path].isotropic_because


func _get_set(path: String) -> SetReach:
	if not sets.has(path):
		sets[path] = SetReach.new()
	return sets[path]


func _include(file: String, material: LobeMaterial3D) -> void:
	if material.table != null:
		own_tables.append([file, material.table])
		return
	var path := TableChoice.DEFAULT_SET
	if material.table_set != null:
		path = material.table_set.resource_path
	var anisotropies := _all_of("anisotropy", material.anisotropy)
	var surfaces: Array[Vector2] = []
	for roughness in _all_of("roughness", material.roughness):
		for anisotropy in anisotropies:
			if not _has_line_alone(material, roughness, anisotropy):
				surfaces.append(Widths.from_roughness(roughness, anisotropy))
	if surfaces.is_empty():
		return
	var reach := _get_set(path)
	reach.add_user(file)
	if material.varies():
		if anisotropies.max() == 0.0 and anisotropies.min() == 0.0:
			reach.isotropic_because = "%s has a texture of widths" % file
		else:
			reach.whole_because = "%s has a texture of widths" % file
	for surface in surfaces:
		reach.add_surface(surface)


# Whether widths need no table. Where a script does with them what is not known, nothing is.
func _has_line_alone(material: LobeMaterial3D, roughness: float, anisotropy: float) -> bool:
	if not (_unknown.is_empty() or _declared) or _switches_anisotropy:
		return false
	if not material.anisotropy_enabled:
		return false
	var line := TableChoice.find_line(material, roughness, anisotropy)
	return line.count > 0 and not line.fades


# A material's own value and those that scripts may give it.
func _all_of(property: String, own: float) -> Array[float]:
	var all: Array[float] = [own]
	all.append_array(_numbers.get(property, PackedFloat64Array()))
	return all
