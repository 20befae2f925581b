@tool
extends EditorExportPlugin
## Keeps out of exported projects what only the editor needs of this addon: the native library with
## its .gdextension, the editor's scripts, and the classes' icons. No filter has to be written.

const ExtensionList := preload("extension_list.gd")

const ADDON := "res://addons/lobelight/"
const EDITOR_ONLY: PackedStringArray = ["editor/", "bin/", "doc_classes/", "icons/"]

var _extension_list := ExtensionList.new()


# The engine calls plugins in the order of their names. This one has to come before the engine's own
# "GDExtension", which would take the library along, or warn that there is none for the system.
func _get_name() -> String:
	return "AddonLobelight"


func _export_begin(
	_features: PackedStringArray, _is_debug: bool, _path: String, _flags: int
) -> void:
	_extension_list.leave_out(ADDON)


func _export_file(path: String, _type: String, _features: PackedStringArray) -> void:
	if not path.begins_with(ADDON) or path == _project_icon():
		return
	var name := path.trim_prefix(ADDON)
	if name.get_extension() == "gdextension":
		skip()
		return
	for folder in EDITOR_ONLY:
		if name.begins_with(folder):
			skip()
			return


func _export_end() -> void:
	_extension_list.restore()


static func _project_icon() -> String:
	var icon: String = ProjectSettings.get_setting("application/config/icon", "")
	return ResourceUID.ensure_path(icon)
