extends Node3D
## The demo: a few metals on a plinth, lit by one of two environments.

## The tables or the environment have changed.
signal changed

const DemoObject := preload("demo_object.gd")
const DemoTables := preload("demo_tables.gd")
const LOBE_COUNTS: PackedInt32Array = [4, 8, 16]


## An environment map, and how it is shown.
class Setting:
	extends RefCounted
	var title: String
	var panorama: Texture2D
	## Factor from radiance to what the tone mapper takes.
	var exposure: float
	## How far the environment is turned about the vertical axis, in degrees.
	var turn: float

	func _init(
		setting_title: String, map: Texture2D, setting_exposure: float, setting_turn: float
	) -> void:
		title = setting_title
		panorama = map
		exposure = setting_exposure
		turn = setting_turn


## Which of [member settings] is shown.
var environment_index := 0:
	set(value):
		environment_index = value
		_show_environment()
## Lobes of each material.
var lobe_count := 8:
	set(value):
		lobe_count = value
		_load_tables()
## How far the environment is turned by the user, in radians.
var turn := 0.0:
	set(value):
		turn = value
		_turn_environment()
## Tables that could not be loaded.
var missing_tables: PackedStringArray = []
var settings: Array[Setting] = [
	Setting.new("Hall", preload("environments/hall.exr"), 1.1, 305.0),
	Setting.new("Sunset", preload("environments/sunset.exr"), 0.75, 200.0),
]

@onready var _light: LobeEnvironment3D = $Light
@onready var _backdrop: ShaderMaterial = ($Backdrop as MeshInstance3D).material_override
@onready var _world: Environment = ($World as WorldEnvironment).environment


func _ready() -> void:
	_load_tables()
	_show_environment()


func _load_tables() -> void:
	missing_tables.clear()
	for node in find_children("*", "MeshInstance3D", true, false):
		var object := node as DemoObject
		if object == null:
			continue
		var table := DemoTables.load_table(object.recipe, lobe_count)
		if table == null:
			var path := DemoTables.path_of(object.recipe, lobe_count)
			if path not in missing_tables:
				missing_tables.append(path)
		(object.material_override as LobeMaterial3D).table = table
	if missing_tables:
		printerr("Tables are missing, run ./dev demo to bake them: ", ", ".join(missing_tables))
	changed.emit()


func _show_environment() -> void:
	if not is_node_ready():
		return
	var setting := settings[environment_index]
	_light.panorama = setting.panorama
	_backdrop.set_shader_parameter(&"panorama", setting.panorama)
	_world.tonemap_exposure = setting.exposure
	_turn_environment()
	changed.emit()


func _turn_environment() -> void:
	_light.rotation.y = turn + deg_to_rad(settings[environment_index].turn)
	_backdrop.set_shader_parameter(&"environment_rotation", _light.global_basis.inverse())


## Makes the light of the environment that is shown. Returns "" once it is there, or one sentence.
func prepare_light() -> String:
	return "" if await _light.rebuild() else _light.get_rebuild_error()
