@tool
extends RefCounted
## Which files of the run time an export needs, and how short they can be.
##
## A script or shader that nothing names, neither the project's files nor a file of the run time
## that is needed, stays out, and so do files of features that nothing reaches (features.gd) if they
## are loaded on demand. The shader includes of such features have to be there, because materials
## preload them, but go along empty. What stays loses its comments; scripts do so by the engine.

const Features := preload("features.gd")
const ProjectFiles := preload("project_files.gd")

const ADDON := "res://addons/lobelight/"
const RUN_TIME := ADDON + "runtime/"
const SHADERS := RUN_TIME + "shaders/"
const TABLE_SET := RUN_TIME + "lobe_table_set.gd"
const CODE: PackedStringArray = ["gd", "gdshader", "gdshaderinc"]
const EMPTY_INCLUDE := "\n"
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
var _classes: Dictionary[String, String] = {}
# Who needs a file.
var _needed_by: Dictionary[String, String] = {}
var _named_path := RegEx.create_from_string("[\\w./:]+\\.(gdshaderinc|gdshader|gd|res)\\b")
var _named_uid := RegEx.create_from_string("uid://\\w+")
var _word := RegEx.create_from_string("\\b[A-Z]\\w+\\b")


## What the files of a project need.
static func of_files(project_files: PackedStringArray, features: Features) -> RefCounted:
	var code := new()
	code._features = features
	features.look_at_renderers()
	code._list(RUN_TIME)
	for entry: Dictionary in ProjectSettings.get_global_class_list():
		var path: String = entry["path"]
		if path.begins_with(RUN_TIME):
			code._classes[String(entry["class"])] = path
	for file in project_files:
		if not file.begins_with(ADDON):
			code._look_at(file)
	for path: String in code.files:
		code._decide(path)
	return code


func get_size_before() -> int:
	return files.values().reduce(func(sum: int, file: CodeFile) -> int: return sum + file.before, 0)


func get_size_after() -> int:
	return files.values().reduce(func(sum: int, file: CodeFile) -> int: return sum + file.after, 0)


## Shader code without comments, indents and blank lines.
static func strip(code: String) -> String:
	if "/*" in code:
		return code
	var kept := ""
	for line in code.split("\n"):
		var text := line.strip_edges()
		# The only strings of shaders are paths of others, which hold what elsewhere begins a comment.
		if not text.begins_with("#include"):
			text = text.get_slice("//", 0).strip_edges()
		if text:
			kept += text + "\n"
	return kept


func _list(folder: String) -> void:
	for name in DirAccess.get_files_at(folder):
		if name.get_extension() in CODE:
			var file := CodeFile.new()
			file.before = FileAccess.get_file_as_bytes(folder + name).size()
			files[folder + name] = file
	for name in DirAccess.get_directories_at(folder):
		_list(folder + name + "/")


func _look_at(file: String) -> void:
	if file.get_extension() in TEXTS:
		_read(file, FileAccess.get_file_as_string(file))
		return
	for path in ProjectFiles.get_dependencies(file):
		_need(path, file)


func _read(file: String, text: String) -> void:
	var named := false
	for found in _named_path.search_all(text):
		var path := found.get_string()
		if not path.begins_with("res://"):
			path = file.get_base_dir().path_join(path).simplify_path()
		named = _need(path, file) or named
	for found in _named_uid.search_all(text):
		var id := ResourceUID.text_to_id(found.get_string())
		if id != ResourceUID.INVALID_ID and ResourceUID.has_id(id):
			named = _need(ResourceUID.get_id_path(id), file) or named
	for found in _word.search_all(text):
		if _classes.has(found.get_string()):
			named = _need(_classes[found.get_string()], file) or named
	# It may put a path together.
	if not named and "addons/lobelight" in text:
		for path in files:
			_need(path, file)


# Whether the path is the addon's. Files that are needed name others.
func _need(path: String, by: String) -> bool:
	if not path.begins_with(ADDON):
		return false
	if path.get_extension() == "res":
		path = TABLE_SET
	if not files.has(path):
		return false
	# What the project's own files name is whole, even if the run time has named it before.
	if _needed_by.has(path) and (by.begins_with(RUN_TIME) or not _is_unreached(path)):
		return true
	_needed_by[path] = by
	if _is_unreached(path):
		return true
	var code: PackedStringArray = []
	for line in FileAccess.get_file_as_string(path).split("\n"):
		if not line.strip_edges().begins_with("#") or "#include" in line:
			code.append(line)
	_read(path, "\n".join(code))
	return true


# A file of a feature that nothing reaches, unless the project names it itself.
func _is_unreached(path: String) -> bool:
	var name := path.trim_prefix(RUN_TIME)
	if not Features.FILES.has(name) or _features.reached.has(Features.FILES[name]):
		return false
	return _needed_by[path].begins_with(RUN_TIME)


func _decide(path: String) -> void:
	var file := files[path]
	var feature: String = Features.FILES.get(path.trim_prefix(RUN_TIME), "")
	file.after = file.before
	if not _needed_by.has(path):
		file.after = 0
		file.why = "nothing names it"
	elif _is_unreached(path):
		file.why = "nothing reaches %s" % feature
		if path.get_extension() == "gdshaderinc":
			file.bytes = EMPTY_INCLUDE.to_utf8_buffer()
			file.why = "empty, " + file.why
		else:
			file.after = 0
	elif path.begins_with(SHADERS):
		file.bytes = strip(FileAccess.get_file_as_string(path)).to_utf8_buffer()
		file.why = "without comments, for %s" % _features.reached.get(feature, _needed_by[path])
	else:
		file.why = "for %s" % _features.reached.get(feature, _needed_by[path])
	if not file.bytes.is_empty():
		file.after = file.bytes.size()
