@tool
extends RefCounted
## Shaders of the project's own that include lobelight.gdshaderinc, and what they need of the addon.
##
## They are read as text, with what they include of the project. A #define of
## LOBELIGHT_ISOTROPIC or LOBELIGHT_QUALITY counts where the include is sure to see it: one that
## stands in a branch, only if the include stands in that branch, too. Widths are those of pixels,
## so that all of a set's may be asked for.
##
## Only what somebody binds takes lobes: materials of the class LobeShaderMaterial do so
## themselves, others are bound by scripts. Either may be given any of the shaders.

const Binding := preload("../../runtime/own_shaders/shader_binding.gd")
const CodeText := preload("shader_text.gd")
const Features := preload("features.gd")
const OnDemand := preload("../../runtime/on_demand.gd")
const SetReach := preload("set_reach.gd")
const TableChoice := preload("../../runtime/material/table_choice.gd")

const ADDON := "res://addons/lobelight/"
const INCLUDE := Features.FOR_OTHERS
# What graphs include in its place.
const NODES := Features.RUN_TIME + "visual_shader/nodes.gdshaderinc"
const ISOTROPIC := "LOBELIGHT_ISOTROPIC"
const QUALITY := "LOBELIGHT_QUALITY"
# Without a line.
const FEWEST := 8


## What a shader asks for; at first all of it.
class Found:
	extends RefCounted
	var is_lit := true
	var is_isotropic := false
	var has_line := true
	var scatters := true


## What a shader's text has been found to hold, up to a line.
class Reading:
	extends RefCounted
	## The numbers of the branches around the line.
	var branches: PackedInt32Array = []
	var branch_count := 0
	## By name, [value, the branches around it].
	var defines: Dictionary[String, Array] = {}
	var found := Found.new()
	var read: Dictionary[String, bool] = {}
	## The project's includes around the line.
	var within: PackedStringArray = []

	func _init() -> void:
		found.is_lit = false
		found.scatters = false

	## The value of what is defined for sure; null if nothing is.
	func get_value(name: String) -> Variant:
		if not defines.has(name):
			return null
		var around: PackedInt32Array = defines[name][1]
		return defines[name][0] if branches.slice(0, around.size()) == around else null

	func enter() -> void:
		branches.append(branch_count)
		branch_count += 1

	func leave() -> void:
		if not branches.is_empty():
			branches.resize(branches.size() - 1)


## By their paths: what they need of the sets.
var sets: Dictionary[String, SetReach] = {}

# Each is [file, what is known of a shader in it].
var _shaders: Array[Array] = []
# Those that are files, by their paths.
var _files: Dictionary[String, bool] = {}
# What materials of the class that binds itself draw, by its path; null for what others do.
var _tables: Dictionary[String, LobeTableSet] = {}
# Includes of the project that lead to the addon's, and whether a shader of a file has them.
var _leading: Dictionary[String, bool] = {}
# Scripts that have shaders as text.
var _writers: PackedStringArray = []
var _directive := RegEx.create_from_string("^\\s*#\\s*(\\w+)\\s*(.*?)\\s*$")
var _scattering := RegEx.create_from_string("\\blobelight_(diffuse|surface|gather)\\b")
var _named := RegEx.create_from_string("[\\w./:]+\\.gdshaderinc\\b|uid://\\w+")
# What may build graphs.
var _node := RegEx.create_from_string(
	"\\bVisualShaderNodeLobelight\\w+|/visual_shader/\\w+_node\\.gd"
)


## A .gdshader or .gdshaderinc.
func look_at_file(file: String) -> void:
	if file.get_extension() == "gdshaderinc":
		if _leads(file):
			_leading[file] = _leading.get(file, false)
	elif not _files.has(file):
		_files[file] = true
		_look_at_code(file, FileAccess.get_file_as_string(file), file)


## A shader, of a file of its own or not.
func look_at_shader(file: String, shader: Shader) -> void:
	var path := shader.resource_path.get_slice("::", 0)
	if path.get_extension() == "gdshader":
		look_at_file(path)
	else:
		_look_at_code(file, shader.code, path)


func look_at_material(material: LobeShaderMaterial) -> void:
	var tables := material.table_set
	_tables[TableChoice.DEFAULT_SET if tables == null else tables.resource_path] = tables


## A line of a script, which may have the text of a shader.
func read_line(file: String, line: String) -> void:
	if file not in _writers and _node.search(line) != null:
		_writers.append(file)
	for found in _named.search_all(line):
		if file not in _writers and _leads(find_path(found.get_string(), file)):
			_writers.append(file)


## When all has been seen: the features that are needed besides, and the sets.
func conclude(features: Features) -> void:
	# A script, or a scene's own word for it.
	var binder: String = features.reached.get(OnDemand.OWN_SHADERS, "")
	if binder:
		_tables[TableChoice.DEFAULT_SET] = null
	if features.declared.has(OnDemand.OWN_SHADERS):
		_writers.append(features.declared[OnDemand.OWN_SHADERS])
	for path in _leading:
		if not _leading[path]:
			_writers.append(path)
	for file in _writers:
		_shaders.append([file, Found.new()])
	for entry in _shaders:
		_add_features(features, entry[0], entry[1])
		for path in _tables:
			_add_set(path, _tables[path], entry[0], entry[1])


static func _add_features(features: Features, file: String, shader: Found) -> void:
	features.add(OnDemand.OWN_SHADERS, file)
	if shader.scatters:
		features.add(Features.DIFFUSE, file)
	if shader.has_line:
		features.add(OnDemand.LINES, file)


func _add_set(path: String, tables: LobeTableSet, file: String, shader: Found) -> void:
	if tables == null:
		tables = load(path)
	if not sets.has(path):
		sets[path] = SetReach.new()
	var reach := sets[path]
	reach.add_user(file)
	if shader.is_isotropic and not tables.widths.is_empty():
		reach.isotropic_because = "%s has a shader of its own" % file
		for end: int in [0, -1]:
			reach.add_surface(Vector2.ONE * tables.widths[end])
	else:
		reach.whole_because = "%s has a shader of its own" % file


func _look_at_code(file: String, code: String, path: String) -> void:
	var reading := Reading.new()
	_read(code, path, reading)
	if NODES in code:
		reading.found.is_lit = true
		reading.found.is_isotropic = Binding.is_round(code)
		reading.found.has_line = not reading.found.is_isotropic
	if reading.found.is_lit:
		_shaders.append([file, reading.found])
		for include in reading.read:
			if _leads(include):
				_leading[include] = true


func _read(code: String, path: String, reading: Reading) -> void:
	for line in CodeText.without_comments(code).split("\n"):
		var directive := _directive.search(line)
		if directive != null:
			_follow(directive.get_string(1), directive.get_string(2), path, reading)
		elif _scattering.search(line) != null:
			reading.found.scatters = true


func _follow(directive: String, rest: String, path: String, reading: Reading) -> void:
	match directive:
		"if", "ifdef", "ifndef":
			reading.enter()
		"else", "elif":
			reading.leave()
			reading.enter()
		"endif":
			reading.leave()
		"define":
			# A macro may do what functions do.
			if _scattering.search(rest) != null:
				reading.found.scatters = true
			var name := rest.get_slice(" ", 0).get_slice("\t", 0)
			if name in [ISOTROPIC, QUALITY]:
				var value := rest.trim_prefix(name).strip_edges()
				reading.defines[name] = [value, reading.branches.duplicate()]
		"undef":
			reading.defines.erase(rest)
		"include":
			_include(find_path(rest.trim_prefix('"').trim_suffix('"'), path), reading)


func _include(path: String, reading: Reading) -> void:
	if path == INCLUDE:
		var is_isotropic := reading.get_value(ISOTROPIC) != null
		var quality: Variant = reading.get_value(QUALITY)
		var is_few: bool = quality is String and quality.is_valid_int() and int(quality) <= FEWEST
		var has_line := not (is_isotropic or is_few)
		# Branches may each have one; that a file includes it twice changes nothing.
		var is_first := not reading.found.is_lit
		reading.found.is_lit = true
		if is_first or not reading.branches.is_empty():
			var found := reading.found
			found.is_isotropic = is_isotropic and (is_first or found.is_isotropic)
			found.has_line = has_line or not is_first and found.has_line
	# The engine includes a file once in a branch.
	elif not path.begins_with(ADDON) and path not in reading.within:
		reading.read[path] = true
		reading.within.append(path)
		if FileAccess.file_exists(path):
			_read(FileAccess.get_file_as_string(path), path, reading)
		reading.within.remove_at(reading.within.size() - 1)


# Whether a file is the addon's include, or includes it.
func _leads(path: String) -> bool:
	if path in [INCLUDE, NODES]:
		return true
	if path.begins_with(ADDON) or path.get_extension() != "gdshaderinc":
		return false
	if not FileAccess.file_exists(path):
		return false
	var reading := Reading.new()
	_read(FileAccess.get_file_as_string(path), path, reading)
	return reading.found.is_lit


## What a file names, as a path or as an id.
static func find_path(named: String, file: String) -> String:
	if named.begins_with("uid://"):
		var id := ResourceUID.text_to_id(named)
		return ResourceUID.get_id_path(id) if ResourceUID.has_id(id) else ""
	if named.contains("://"):
		return named.simplify_path()
	return file.get_base_dir().path_join(named).simplify_path()
