@tool
extends Object
## Shader code as exports take it along.


## The code without comments, indents and blank lines.
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


## The code without comments of either kind.
static func without_comments(code: String) -> String:
	# Paths hold what elsewhere begins a comment.
	var parts := RegEx.create_from_string('"[^"\\n]*"|//[^\\n]*|/\\*[\\s\\S]*?\\*/')
	var kept := ""
	var at := 0
	for found in parts.search_all(code):
		if not found.get_string().begins_with('"'):
			kept += code.substr(at, found.get_start() - at) + " "
			at = found.get_end()
	return kept + code.substr(at)


## The code without what is drawn only where [param define] is set: branches of [code]#ifdef[/code]
## and [code]#ifndef[/code] that ask for it alone. Code that asks in another way stays as it is.
static func without(code: String, define: String) -> String:
	var kept: PackedStringArray = []
	# Of each branch around the line: whether it asks for the define, and whether it is kept.
	var branches: Array[Array] = []
	for line in code.split("\n"):
		var words := line.strip_edges().split(" ", false)
		var directive := words[0] if not words.is_empty() else ""
		var asks := directive in ["#ifdef", "#ifndef"] and words[1] == define
		if directive in ["#ifdef", "#ifndef", "#if"]:
			branches.append([asks, not asks or directive == "#ifndef"])
		elif directive in ["#else", "#elif", "#endif"]:
			asks = branches.back()[0]
			if asks and directive == "#elif":
				return code
			if directive == "#endif":
				branches.pop_back()
			elif asks:
				branches.back()[1] = not branches.back()[1]
		if not asks and branches.all(func(branch: Array) -> bool: return branch[1]):
			kept.append(line)
	return "\n".join(kept)
