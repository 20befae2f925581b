@tool
extends RefCounted
## A shader as one text: its includes are in it, what its #defines leave out is not.
##
## Branches that only the game can decide, by its renderer, stay branches.

# Of a branch: what it has been decided to be.
enum { LEFT_OUT, TAKEN, DONE, OPEN }

# What the engine defines when it compiles.
const _ENGINES: PackedStringArray = [
	"CURRENT_RENDERER", "RENDERER_COMPATIBILITY", "RENDERER_MOBILE", "RENDERER_FORWARD_PLUS"
]

## The text.
var code := ""
## Why there is none, in a sentence.
var problem := ""

var _lines: PackedStringArray = []
var _defines: Dictionary[String, String] = {}
# Names of which it is not known whether they are defined, or as what.
var _unknown: Dictionary[String, bool] = {}
# The branches around a line, the innermost last.
var _branches: Array[int] = []
var _name := RegEx.create_from_string("[A-Za-z_]\\w*")
var _asked := RegEx.create_from_string("\\bdefined\\s*\\(\\s*(\\w+)\\s*\\)")


static func of(text: String) -> RefCounted:
	var flat := new()
	for name in _ENGINES:
		flat._unknown[name] = true
	flat._read(text, "")
	flat._forget_unused()
	if flat.problem.is_empty():
		flat.code = "\n".join(flat._lines) + "\n"
	return flat


func _read(text: String, file: String) -> void:
	if "/*" in text:
		problem = "%s has a comment of several lines" % file
	for line in text.replace("\\\n", " ").split("\n"):
		_read_line(line.strip_edges(), file)


func _read_line(line: String, file: String) -> void:
	var words := line.split(" ", false, 1)
	var directive := words[0] if not words.is_empty() else ""
	var rest := words[1].get_slice("//", 0).strip_edges() if words.size() > 1 else ""
	match directive:
		"#if", "#ifdef", "#ifndef":
			_begin(directive, rest)
		"#elif", "#else":
			_go_on(directive, rest)
		"#endif":
			var branch: int = _branches.pop_back()
			if branch == OPEN and _is_kept():
				_lines.append("#endif")
		_:
			if _is_kept():
				_keep(directive, rest, line, file)


func _is_kept() -> bool:
	return _branches.all(func(branch: int) -> bool: return branch == TAKEN or branch == OPEN)


func _keep(directive: String, rest: String, line: String, file: String) -> void:
	match directive:
		"#include":
			# What the path has for a comment is a part of it.
			var path := line.get_slice('"', 1)
			if not path.begins_with("res://"):
				path = file.get_base_dir().path_join(path).simplify_path()
			if FileAccess.file_exists(path):
				_read(FileAccess.get_file_as_string(path), path)
			else:
				problem = "%s is not there" % path
			return
		"#define":
			var name := _name.search(rest).get_string()
			_defines[name] = rest.trim_prefix(name).strip_edges()
			if OPEN in _branches:
				_unknown[name] = true
		"#undef":
			problem = "%s takes back what it has defined" % file
	var text := line.get_slice("//", 0).strip_edges()
	if text:
		_lines.append(text)


func _begin(directive: String, condition: String) -> void:
	if not _is_kept():
		_branches.append(DONE)
		return
	var found: Variant = _decide(directive, condition)
	if found == null:
		_lines.append("%s %s" % [directive, condition])
		_branches.append(OPEN)
	else:
		_branches.append(TAKEN if found else LEFT_OUT)


func _go_on(directive: String, condition: String) -> void:
	var branch: int = _branches.pop_back()
	if branch == LEFT_OUT and directive == "#elif":
		_begin("#if", condition)
		return
	if branch == OPEN and _is_kept():
		_lines.append(("%s %s" % [directive, condition]).strip_edges())
	match branch:
		LEFT_OUT:
			branch = TAKEN
		TAKEN:
			branch = DONE
	_branches.append(branch)


# Whether a condition holds; null if only the game knows.
func _decide(directive: String, condition: String) -> Variant:
	for found in _name.search_all(condition):
		if _unknown.has(found.get_string()):
			return null
	if directive != "#if":
		return _defines.has(condition) == (directive == "#ifdef")
	var text := condition
	for found in _asked.search_all(condition):
		var answer := "true" if _defines.has(found.get_string(1)) else "false"
		text = text.replace(found.get_string(), answer)
	for found in _name.search_all(text):
		var name := found.get_string()
		if name not in ["true", "false"]:
			if not _defines.has(name):
				return null
			text = RegEx.create_from_string("\\b%s\\b" % name).sub(text, _defines[name], true)
	var expression := Expression.new()
	if expression.parse(text) != OK:
		return null
	var value: Variant = expression.execute([], null, false)
	return null if expression.has_execute_failed() else bool(value)


# What is defined and named nowhere.
func _forget_unused() -> void:
	var is_done := false
	while not is_done:
		is_done = true
		var counts: Dictionary[String, int] = {}
		for line in _lines:
			for found in _name.search_all(line):
				counts[found.get_string()] = counts.get(found.get_string(), 0) + 1
		for i in range(_lines.size() - 1, -1, -1):
			if (
				_lines[i].begins_with("#define ")
				and counts[_name.search(_lines[i], 7).get_string()] == 1
			):
				_lines.remove_at(i)
				is_done = false
