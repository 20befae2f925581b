@tool
extends EditorExportPlugin
## Keeps out of exported projects what only the editor needs of this addon: the native library with
## its .gdextension, the editor's scripts, and the classes' icons. No filter has to be written.
## [br][br]
## Of the ready tables and of the run time it exports what the project can reach, prints what it
## did, and keeps a report in the project's data folder. The preset's option "lobelight/cut_tables"
## turns that off. Environments of automatic size get the size that the sharpest lobe needs, and
## their panoramas as many texels as that shows, unless "lobelight/fit_environments" is off.
## Materials that nothing changes go along as shaders and numbers, without what makes these of their
## properties, unless "lobelight/freeze_materials" is off. With a
## "lobelight/target_psnr", materials get the fewest lobes that reach it. With a
## "lobelight/panorama_width", all panoramas are halved while they have as many texels in a row:
## pages load them faster.

const Diet := preload("diet.gd")
const ExtensionList := preload("extension_list.gd")
const LightVariant := preload("light_variant.gd")
const PanoramaFit := preload("panorama_fit.gd")
const ProjectFiles := preload("project_files.gd")
const Reach := preload("reach.gd")
const TableChoice := preload("../../runtime/material/table_choice.gd")

const ADDON := "res://addons/lobelight/"
const EDITOR_ONLY: PackedStringArray = ["editor/", "bin/", "doc_classes/", "icons/"]
const TABLE_CHOICE := "res://addons/lobelight/runtime/material/table_choice.gd"
const OWN_SHADERS := "res://addons/lobelight/runtime/own_shaders/shader_binding.gd"
const FOR_OTHERS := "res://addons/lobelight/lobelight.gdshaderinc"
const CUT_TABLES := "lobelight/cut_tables"
const FIT_ENVIRONMENTS := "lobelight/fit_environments"
const FREEZE_MATERIALS := "lobelight/freeze_materials"
const TARGET_PSNR := "lobelight/target_psnr"
const PANORAMA_WIDTH := "lobelight/panorama_width"
const REPORT := "res://.godot/lobelight_export.json"

var _extension_list := ExtensionList.new()
var _diet: Diet
# The sets, and what others include, that have been seen to.
var _done: Dictionary[String, bool] = {}


# The engine calls plugins in the order of their names. This one has to come before the engine's own
# "GDExtension", which would take the library along, or warn that there is none for the system.
func _get_name() -> String:
	return "AddonLobelight"


func _get_export_options(_platform: EditorExportPlatform) -> Array[Dictionary]:
	var options: Array[Dictionary] = []
	for name: String in [CUT_TABLES, FIT_ENVIRONMENTS, FREEZE_MATERIALS]:
		options.append({"option": {"name": name, "type": TYPE_BOOL}, "default_value": true})
	var target := {
		"name": TARGET_PSNR,
		"type": TYPE_FLOAT,
		"hint": PROPERTY_HINT_RANGE,
		"hint_string": "0,46,0.5,suffix:dB",
	}
	options.append({"option": target, "default_value": 0.0})
	var width := {
		"name": PANORAMA_WIDTH,
		"type": TYPE_INT,
		"hint": PROPERTY_HINT_RANGE,
		"hint_string": "0,8192,1,or_greater,suffix:px",
	}
	options.append({"option": width, "default_value": 0})
	return options


# The engine's shader baker, whose name comes later, asks materials that have just been loaded for
# their shaders; those of this addon are made a little later.
func _begin_customize_resources(
	_platform: EditorExportPlatform, features: PackedStringArray
) -> bool:
	return "shader_baker" in features


func _customize_resource(resource: Resource, _path: String) -> Resource:
	if resource is LobeMaterial3D:
		(resource as LobeMaterial3D).update_now()
	return null


# Shaders are made for the renderer and the engine that export.
func _get_customization_configuration_hash() -> int:
	return hash([Engine.get_version_info(), RenderingServer.get_current_rendering_method()])


func _export_begin(
	_features: PackedStringArray, _is_debug: bool, _path: String, _flags: int
) -> void:
	_extension_list.leave_out(ADDON)
	_done.clear()
	_diet = null
	if get_option(CUT_TABLES) != false:
		var target: float = get_option(TARGET_PSNR)
		var files := ProjectFiles.of_preset(get_export_preset())
		_diet = Diet.of_files(
			files,
			target,
			get_option(FIT_ENVIRONMENTS) != false,
			get_option(FREEZE_MATERIALS) != false
		)
		var shared := _diet.get_shared_files()
		for path in shared:
			add_file(path, shared[path], false)


func _export_file(path: String, type: String, features: PackedStringArray) -> void:
	if _diet != null and type == "CompressedTexture2D":
		_narrow_panorama(path)
	if _diet != null and _diet.panoramas.shares.has(path):
		_export_panorama(_diet.panoramas.shares[path])
		return
	if _diet != null:
		var edited := _diet.edit(path)
		if not edited.is_empty():
			var name := path.md5_text() + (".scn" if type == "PackedScene" else ".res")
			add_file(Diet.EDITED + name, edited, true)
			return
	if not path.begins_with(ADDON) or path == _project_icon():
		if LightVariant.is_asked_for(features):
			_export_variant(path, type)
		return
	var name := path.trim_prefix(ADDON)
	if name.get_extension() == "gdextension":
		skip()
		return
	for folder in EDITOR_ONLY:
		if name.begins_with(folder):
			skip()
			return
	if path == TABLE_CHOICE:
		# It loads sets by their paths, which an export of chosen scenes does not know of.
		_export_table(TableChoice.DEFAULT_SET, false)
		_export_table(TableChoice.COAT_SET, false)
		_export_table(TableChoice.SHEEN_SET, false)
	elif path.begins_with(Reach.TABLES) and _export_table(path, true):
		skip()
	if path == OWN_SHADERS:
		# Dependencies do not tell of includes, either.
		_export_for_others()
	elif path == FOR_OTHERS:
		if _done.has(path):
			skip()
			return
		_done[path] = true
	if _diet != null and _diet.code.files.has(path):
		_export_code(path, _diet.code.files[path])


# A light that phones take in other blocks.
func _export_variant(path: String, type: String) -> void:
	var bytes := LightVariant.of(path, type)
	if not bytes.is_empty():
		add_file(Diet.EDITED + path.md5_text() + ".res", bytes, true)


# What nothing but the preset makes smaller, or what that makes smaller still.
func _narrow_panorama(path: String) -> void:
	var width: Variant = get_option(PANORAMA_WIDTH)
	var share: PanoramaFit.Share = _diet.panoramas.shares.get(path)
	if not width is int or width <= 0 or share != null and share.is_left_out:
		return
	var narrowed := PanoramaFit.narrow(path, width)
	if narrowed != null and (share == null or narrowed.after < share.after):
		_diet.panoramas.shares[path] = narrowed


# A panorama that is left out or made smaller, not by the engine's way to put a file in the place of
# another: the loader of textures wants the type that a .import file names.
func _export_panorama(share: Diet.PanoramaFit.Share) -> void:
	if share.is_left_out:
		skip()
	elif not share.bytes.is_empty():
		var file := Diet.EDITED + share.path.md5_text() + ".ctex"
		add_file(file, share.bytes, false)
		add_file(share.path + ".import", share.make_import(file), false)
		skip()


# A file of the run time that is left out or replaced; the others are left to the engine.
func _export_code(path: String, file: Diet.CodeFiles.CodeFile) -> void:
	if file.after == 0:
		skip()
	elif not file.bytes.is_empty():
		add_file(path, file.bytes, false)
		skip()


func _export_for_others() -> void:
	if _done.has(FOR_OTHERS):
		return
	_done[FOR_OTHERS] = true
	var file: Diet.CodeFiles.CodeFile = _diet.code.files[FOR_OTHERS] if _diet != null else null
	if file == null:
		add_file(FOR_OTHERS, FileAccess.get_file_as_bytes(FOR_OTHERS), false)
	elif file.after > 0:
		add_file(FOR_OTHERS, file.bytes, false)


# Adds what the export takes of a set. Returns false if the engine is to export the file as it is,
# which it can only where the file's turn has come.
func _export_table(path: String, is_its_turn: bool) -> bool:
	if _done.has(path) or not FileAccess.file_exists(path):
		return true
	_done[path] = true
	var share: Diet.Share = _diet.shares.get(path) if _diet != null else null
	if share != null and share.is_left_out():
		return true
	var is_cut := share != null and not share.bytes.is_empty()
	if is_its_turn and not is_cut:
		return false
	add_file(path, share.bytes if is_cut else FileAccess.get_file_as_bytes(path), false)
	return true


func _export_end() -> void:
	_extension_list.restore()
	if _diet == null:
		return
	for line: String in _diet.describe():
		print(line)
	var file := FileAccess.open(REPORT, FileAccess.WRITE)
	if file != null:
		file.store_string(JSON.stringify(_diet.to_dictionary(), "  ", false) + "\n")
	_diet = null


static func _project_icon() -> String:
	var icon: String = ProjectSettings.get_setting("application/config/icon", "")
	return ResourceUID.ensure_path(icon)
