@tool
extends RefCounted
## Which files of the run time an export needs, and how short they can be.
##
## A script or shader that nothing names, neither the project's files nor a file of the run time
## that is needed, stays out. Folders of features (features.gd) stay or go whole. Of a feature that
## nothing reaches, shader includes that a script preloads have to be there, and go along empty.
## lobelight.gdshaderinc, which lies above the run time, is part of the folder that goes with it.
## What stays loses its comments; scripts do so by the engine.

const Features := preload("features.gd")
const OnDemand := preload("../../runtime/on_demand.gd")
const ProjectFiles := preload("project_files.gd")
const ShaderText := preload("shader_text.gd")

const ADDON := "res://addons/lobelight/"
const RUN_TIME := Features.RUN_TIME
const TABLES := ADDON + "tables/"
const TABLE_SET := RUN_TIME + "table/lobe_table_set.gd"
const SHADERS: PackedStringArray = ["gdshader", "gdshaderinc"]
const CODE: PackedStringArray = ["gd", "gdshader", "gdshaderinc"]
const EMPTY_INCLUDE := "\n"
# Shaders that nobody has seen may ask for a line.
const NO_LINES := "#define LOBELIGHT_NO_LINES\n"
# What names others without being resources.
const TEXTS: PackedStringArray = ["gd", "cs", "gdshader", "gdshaderinc"]


## What becomes of a file.
class CodeFile:
	extends RefCounted
	## Bytes of the source, which exports may compile.
	var before := 0
	var after := 0
	var why := ""
	## What is exported in its place, where that is not the file itself.
	var bytes := PackedByteArray()


## By the files' paths.
var files: Dictionary[String, CodeFile] = {}

var _features: Features
var _dependencies: Dictionary[String, PackedStringArray] = {}
var _classes: Dictionary[String, String] = {}
# Who needs a file. Grows at its end while it is gone through.
var _needed_by: Dictionary[String, String] = {}
# What scripts that go along preload.
var _preloaded: Dictionary[String, bool] = {}
var _preload := RegEx.create_from_string('preload\\("([^"]+)')
var _named_path := RegEx.create_from_string("[\\w./:]+\\.(gdshaderinc|gdshader|gd|res)\\b")
var _named_uid := RegEx.create_from_string("uid://\\w+")
var _string := RegEx.create_from_string('"[^"\\n]*"')
var _word := RegEx.create_from_string("\\b[A-Z]\\w+\\b")


## What the files of a project need. Of files that are exchanged, [param dependencies] has what
## stands in for them depend on.
static func of_files(
	project_files: PackedStringArray,
	features: Features,
	dependencies: Dictionary[String, PackedStringArray] = {}
) -> RefCounted:
	var code := new()
	code._dependencies = dependencies
	code._features = features
	features.look_at_settings()
	code._list(RUN_TIME)
	code._add(Features.FOR_OTHERS)
	for entry: Dictionary in ProjectSettings.get_global_class_list():
		var path: String = entry["path"]
		if path.begins_with(RUN_TIME):
			code._classes[String(entry["class"])] = path
	for file in project_files:
		if not file.begins_with(ADDON):
			code._look_at(file)
	code._follow_all()
	for path: String in code.files:
		code._decide(path)
	return code


func get_size_before() -> int:
	return files.values().reduce(func(sum: int, file: CodeFile) -> int: return sum + file.before, 0)


func get_size_after() -> int:
	return files.values().reduce(func(sum: int, file: CodeFile) -> int: return sum + file.after, 0)


func _list(folder: String) -> void:
	for name in DirAccess.get_files_at(folder):
		if name.get_extension() in CODE:
			_add(folder + name)
	for name in DirAccess.get_directories_at(folder):
		_list(folder + name + "/")


func _add(path: String) -> void:
	var file := CodeFile.new()
	file.before = FileAccess.get_file_as_bytes(path).size()
	files[path] = file


func _look_at(file: String) -> void:
	if file.get_extension() in TEXTS:
		_read(file, _get_code(file))
		return
	var paths := ProjectFiles.get_dependencies(file)
	for path: String in _dependencies.get(file, paths):
		_need(path, file)


# What is needed, file by file, names more.
func _follow_all() -> void:
	# What the project's own files name they reach.
	for path in _needed_by:
		if Features.of_file(path):
			_features.add(Features.of_file(path), _needed_by[path])
	var next := 0
	while next < _needed_by.size():
		var path: String = _needed_by.keys()[next]
		next += 1
		if not _is_unreached(path):
			_need_folder(path)
			_follow(path)


func _need_folder(path: String) -> void:
	var feature := Features.of_file(path)
	if feature.is_empty():
		return
	for other in files:
		if Features.of_file(other) == feature:
			_need(other, _needed_by[path])


func _follow(path: String) -> void:
	var code: PackedStringArray = []
	for line in _get_code(path).split("\n"):
		if not line.strip_edges().begins_with("#") or "#include" in line:
			code.append(line)
	for found in _preload.search_all("\n".join(code)):
		_preloaded[_absolute(found.get_string(1), path)] = true
	_read(path, "\n".join(code))


# Comments of shaders name what the reader may want to know of.
static func _get_code(path: String) -> String:
	var text := FileAccess.get_file_as_string(path)
	return ShaderText.without_comments(text) if path.get_extension() in SHADERS else text


static func _absolute(path: String, file: String) -> String:
	if path.begins_with("res://"):
		return path
	return file.get_base_dir().path_join(path).simplify_path()


func _read(file: String, text: String) -> void:
	var named := false
	for found in _named_path.search_all(text):
		named = _need(_absolute(found.get_string(), file), file) or named
	for found in _named_uid.search_all(text):
		var id := ResourceUID.text_to_id(found.get_string())
		if id != ResourceUID.INVALID_ID and ResourceUID.has_id(id):
			named = _need(ResourceUID.get_id_path(id), file) or named
	# The run time names classes in messages, too.
	var words := _string.sub(text, "", true) if file.begins_with(RUN_TIME) else text
	for found in _word.search_all(words):
		if _classes.has(found.get_string()):
			named = _need(_classes[found.get_string()], file) or named
	# It may put a path together.
	if not named and "addons/lobelight" in text:
		for path in files:
			_need(path, file)


# Whether the path is the addon's.
func _need(path: String, by: String) -> bool:
	if not path.begins_with(ADDON):
		return false
	if path.begins_with(TABLES):
		path = TABLE_SET
	if not files.has(path):
		return false
	if not _needed_by.has(path):
		_needed_by[path] = by
	return true


func _is_unreached(path: String) -> bool:
	var feature := Features.of_file(path)
	return not feature.is_empty() and not _features.reached.has(feature)


func _decide(path: String) -> void:
	var file := files[path]
	var feature := Features.of_file(path)
	file.after = file.before
	if not _needed_by.has(path):
		file.after = 0
		file.why = "nothing names it"
	elif _is_unreached(path):
		file.why = "nothing reaches %s" % feature
		if path.get_extension() == "gdshaderinc" and _preloaded.has(path):
			file.bytes = EMPTY_INCLUDE.to_utf8_buffer()
			file.why = "empty, " + file.why
		else:
			file.after = 0
	elif path.get_extension() in SHADERS:
		file.bytes = _shorten(path).to_utf8_buffer()
		file.why = "without comments, for %s" % _features.reached.get(feature, _needed_by[path])
	else:
		file.why = "for %s" % _features.reached.get(feature, _needed_by[path])
	if not file.bytes.is_empty():
		file.after = file.bytes.size()


func _shorten(path: String) -> String:
	var shader := FileAccess.get_file_as_string(path)
	if path == Features.FOR_OTHERS and not _features.reached.has(OnDemand.LINES):
		shader = NO_LINES + shader
	for feature in Features.DEFINES:
		if not _features.reached.has(feature):
			shader = ShaderText.without(shader, Features.DEFINES[feature])
	return ShaderText.strip(shader)
