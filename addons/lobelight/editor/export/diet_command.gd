extends SceneTree
## Reports what an export takes along of the addon's tables: [code]--script …/diet_command.gd --
## [--scene res://X.tscn] [--target DB] [--json FILE][/code]. For [code]./dev diet[/code].

const Diet := preload("diet.gd")
const FileBytes := preload("file_bytes.gd")
const ProjectFiles := preload("project_files.gd")


func _initialize() -> void:
	var scene := _argument("--scene")
	var files := ProjectFiles.of_project() if scene.is_empty() else ProjectFiles.of_scene(scene)
	var diet := Diet.of_files(files, _argument("--target").to_float())
	print("\n".join(diet.describe()))
	quit(0 if _write(_argument("--json"), diet.to_dictionary()) else 1)


static func _argument(name: String) -> String:
	var arguments := OS.get_cmdline_user_args()
	var index := arguments.find(name)
	return arguments[index + 1] if index >= 0 and index + 1 < arguments.size() else ""


static func _write(path: String, report: Dictionary) -> bool:
	if path.is_empty():
		return true
	var text := JSON.stringify(report, "  ", false) + "\n"
	if FileBytes.write(path, text.to_utf8_buffer()):
		return true
	printerr("diet: %s: cannot be written" % path)
	return false
