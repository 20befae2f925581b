@tool
extends EditorPlugin
## The editor's side of Lobelight.
##
## The types of the run time register themselves by their class names, and the baker by the native
## library. What is added here: inspectors with bakes, plots and warnings, gizmos, importers,
## conversions of materials, menus for scenes, and the filter of exports.

const BakeDialog := preload("bake/bake_dialog.gd")
const BakeQueue := preload("bake/bake_queue.gd")
const CreateButton := preload("create/create_button.gd")
const CreateMenu := preload("create/create_menu.gd")
const ExportPlugin := preload("export/export_plugin.gd")
const GltfImport := preload("import/gltf_import.gd")
const LightBakes := preload("light/light_bakes.gd")
const LightDialog := preload("light/light_dialog.gd")
const LightImporter := preload("import/light_importer.gd")
const LightInspector := preload("light/light_inspector.gd")
const MaterialConversionPlugin := preload("conversion/material_conversion_plugin.gd")
const MeasuredImporter := preload("import/measured_importer.gd")
const NormalVarianceInspector := preload("antialiasing/normal_variance_inspector.gd")
const PanoramaImporter := preload("import/panorama_importer.gd")
const OwnShaderInspector := preload("own_shaders/own_shader_inspector.gd")
const PresetInspector := preload("presets/preset_inspector.gd")
const ProbeGizmo := preload("gizmos/probe_gizmo.gd")
const ProjectSettingsPage := preload("project_settings.gd")
const SceneConversionMenu := preload("conversion/scene_conversion_menu.gd")
const TableInspector := preload("bake/table_inspector.gd")
const TangentWarning := preload("tangent_warning.gd")
const ToolsMenu := preload("menu/tools_menu.gd")
const WarningInspector := preload("warnings/warning_inspector.gd")
const WarningRefresh := preload("warnings/warning_refresh.gd")

var _export_plugin: ExportPlugin
var _conversions: Array[MaterialConversionPlugin] = []
var _scene_menu: SceneConversionMenu
var _tangent_warning: TangentWarning
var _bakes: BakeQueue
var _bake_dialog: BakeDialog
var _table_inspector: TableInspector
var _importers: Array[EditorImportPlugin] = []
var _gltf_import: GltfImport
var _preset_inspector: PresetInspector
var _warning_inspector: WarningInspector
var _own_shaders: OwnShaderInspector
var _create_menu: CreateMenu
var _create_button: CreateButton
var _tools_menu: ToolsMenu
var _probe_gizmo: ProbeGizmo
var _light_bakes: LightBakes
var _light_dialog: LightDialog
var _light_inspector: LightInspector
var _normal_variance: NormalVarianceInspector


func _enter_tree() -> void:
	ProjectSettingsPage.register()
	_export_plugin = ExportPlugin.new()
	add_export_plugin(_export_plugin)
	for to_lobes: bool in [true, false]:
		var conversion := MaterialConversionPlugin.new(to_lobes)
		_conversions.append(conversion)
		add_resource_conversion_plugin(conversion)
	_scene_menu = SceneConversionMenu.new(get_undo_redo())
	add_context_menu_plugin(EditorContextMenuPlugin.CONTEXT_SLOT_SCENE_TREE, _scene_menu)
	_tangent_warning = TangentWarning.new()
	add_inspector_plugin(_tangent_warning)
	_bakes = BakeQueue.new(get_undo_redo())
	add_child(_bakes)
	_bake_dialog = BakeDialog.new(_bakes)
	EditorInterface.get_base_control().add_child(_bake_dialog)
	_table_inspector = TableInspector.new(_bakes)
	add_inspector_plugin(_table_inspector)
	var panoramas := PanoramaImporter.new()
	# The editor listens first and reloads what it finds loaded.
	EditorInterface.get_resource_filesystem().resources_reimported.connect(panoramas.on_reimported)
	_importers = [panoramas, LightImporter.new(), MeasuredImporter.new()]
	for importer in _importers:
		add_import_plugin(importer)
	_gltf_import = GltfImport.new()
	_gltf_import.start()
	add_scene_post_import_plugin(_gltf_import)
	_preset_inspector = PresetInspector.new(get_undo_redo())
	add_inspector_plugin(_preset_inspector)
	_warning_inspector = WarningInspector.new()
	add_inspector_plugin(_warning_inspector)
	# Freed with the plugin.
	add_child(WarningRefresh.new())
	_light_bakes = LightBakes.new(get_undo_redo())
	_light_dialog = LightDialog.new(_light_bakes)
	EditorInterface.get_base_control().add_child(_light_dialog)
	_light_inspector = LightInspector.new(_light_bakes)
	add_inspector_plugin(_light_inspector)
	_normal_variance = NormalVarianceInspector.new(get_undo_redo())
	add_inspector_plugin(_normal_variance)
	_own_shaders = OwnShaderInspector.new(get_undo_redo())
	add_inspector_plugin(_own_shaders)
	_create_menu = CreateMenu.new(get_undo_redo())
	_create_button = CreateButton.new(_create_menu)
	add_control_to_container(CONTAINER_SPATIAL_EDITOR_MENU, _create_button)
	_tools_menu = ToolsMenu.new(_bakes, _light_bakes, _scene_menu, _create_menu)
	add_tool_submenu_item(ToolsMenu.TITLE, _tools_menu)
	_probe_gizmo = ProbeGizmo.new(get_undo_redo())
	add_node_3d_gizmo_plugin(_probe_gizmo)


func _exit_tree() -> void:
	remove_export_plugin(_export_plugin)
	_export_plugin = null
	for conversion in _conversions:
		remove_resource_conversion_plugin(conversion)
	_conversions.clear()
	remove_context_menu_plugin(_scene_menu)
	_scene_menu.close()
	_scene_menu = null
	remove_inspector_plugin(_tangent_warning)
	_tangent_warning = null
	remove_inspector_plugin(_table_inspector)
	_table_inspector = null
	remove_inspector_plugin(_preset_inspector)
	_preset_inspector = null
	remove_inspector_plugin(_warning_inspector)
	_warning_inspector = null
	remove_inspector_plugin(_light_inspector)
	_light_inspector = null
	remove_inspector_plugin(_normal_variance)
	_normal_variance = null
	remove_inspector_plugin(_own_shaders)
	_own_shaders = null
	_light_dialog.queue_free()
	# It lives until a capture under way has ended.
	_light_bakes.cancel_all()
	_light_bakes = null
	remove_node_3d_gizmo_plugin(_probe_gizmo)
	_probe_gizmo = null
	remove_control_from_container(CONTAINER_SPATIAL_EDITOR_MENU, _create_button)
	_create_button.queue_free()
	_create_menu = null
	# It is freed with its item.
	remove_tool_menu_item(ToolsMenu.TITLE)
	for importer in _importers:
		remove_import_plugin(importer)
	_importers.clear()
	remove_scene_post_import_plugin(_gltf_import)
	_gltf_import.stop()
	_gltf_import = null
	_bake_dialog.queue_free()
	# A bake under way stops before the queue is gone.
	_bakes.stop()
	_bakes.queue_free()


## Project > Tools > Lobelight.
func get_tools_menu() -> ToolsMenu:
	return _tools_menu


## What is added to scenes.
func get_create_menu() -> CreateMenu:
	return _create_menu


## What the 3D view shows of probes.
func get_probe_gizmo() -> ProbeGizmo:
	return _probe_gizmo


## The bakes of lights under way.
func get_light_bakes() -> LightBakes:
	return _light_bakes


## The bakes of tables under way.
func get_bakes() -> BakeQueue:
	return _bakes
