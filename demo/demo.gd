extends Node3D
## The demo: a small hall of objects in environments to switch and to turn, and an interior with a
## light for each room, lit by one method or by two, side by side.

## What the interface shows has changed.
signal changed

const CapturedSky := preload("studio/captured_sky.gdshader")
const PanoramaSky := preload("panorama_sky.gdshader")
const CompareView := preload("compare/compare_view.gd")
const DemoObject := preload("demo_object.gd")
const DemoTables := preload("demo_tables.gd")
const Interior := preload("interior/interior.gd")
const Methods := preload("methods.gd")
const OrbitCamera := preload("orbit_camera.gd")
const RivalLight := preload("rivals/rival_light.gd")
const Studio := preload("studio/studio.gd")
const Sunset := preload("environments/sunset.exr")
## All objects have the sliders' widths.
const EVERY_OBJECT := -1
# Frames in which sources are taken out of a light after it has first been drawn, and some more.
const _SOURCE_FRAMES := 24
# Texels along the side of the captured map's faces: it is made in every frame.
const _CAPTURE_SIZE := 128


## An environment, and how it is shown.
class Setting:
	extends RefCounted
	var title: String
	## Null for the studio, which is captured.
	var panorama: Texture2D
	## Factor from radiance to what the tone mapper takes.
	var exposure: float
	## How far the environment is turned about the vertical axis, in degrees.
	var turn: float
	## Whether it shows the interior, rather than the hall's objects.
	var is_interior := false

	func _init(
		setting_title: String, map: Texture2D, setting_exposure: float, setting_turn: float
	) -> void:
		title = setting_title
		panorama = map
		exposure = setting_exposure
		turn = setting_turn

	static func of_interior(map: Texture2D, exposure: float, turn: float) -> Setting:
		var setting := Setting.new("Interior", map, exposure, turn)
		setting.is_interior = true
		return setting


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
## How far the environment is turned by the user, or the studio's lamp, or how far the interior's
## ball has rolled, in radians.
var turn := 0.0:
	set(value):
		turn = value
		_turn_environment()
## Of [enum Methods.Method].
var left_method: int = Methods.Method.OURS:
	set(value):
		left_method = value
		_show_methods()
## Of [enum Methods.Method], or NONE: the left method alone.
var right_method: int = Methods.NONE:
	set(value):
		right_method = value
		_show_methods()
## Where the right method begins, in widths of the picture.
var divider := 0.5:
	set(value):
		divider = clampf(value, 0.0, 1.0)
		compare_view.divider = divider
		changed.emit()
## Whose widths the sliders set: a number in [member objects], or EVERY_OBJECT.
var chosen := EVERY_OBJECT:
	set(value):
		chosen = value
		changed.emit()
## Sets of tables that have not been made.
var missing_tables: PackedStringArray = []
var settings: Array[Setting] = [
	Setting.new("Hall", preload("environments/hall.exr"), 1.1, 305.0),
	Setting.new("Sunset", Sunset, 0.75, 200.0),
	Setting.new("Studio, live", null, 0.9, 0.0),
	Setting.of_interior(Sunset, 1.3, 98.4),
]
## Those that the sliders are for, of what is shown.
var objects: Array[DemoObject] = []

# Objects, and what they stand on.
var _surfaces: Array[DemoObject] = []
var _hall: Array[DemoObject] = []
var _hall_view: OrbitCamera.View
var _sky: Sky
# Counts changes of the environment, so that a map which comes late is not taken.
var _light_request := 0

@onready var camera: OrbitCamera = $Camera
@onready var compare_view: CompareView = $CompareView
@onready var _light: LobeEnvironment3D = $Light
@onready var _backdrop: MeshInstance3D = $Backdrop
@onready var _studio: Studio = $Studio
@onready var _interior: Interior = $Interior
@onready var _world: Environment = ($World as WorldEnvironment).environment


func _ready() -> void:
	for node in find_children("*", "MeshInstance3D", true, false):
		var object := node as DemoObject
		if object != null:
			_surfaces.append(object)
			if object.title:
				_hall.append(object)
	objects = _hall
	_hall_view = camera.get_view()
	if get_viewport() is Window:
		get_viewport().msaa_3d = Viewport.MSAA_4X
	compare_view.set_up(camera)
	camera.tapped.connect(_choose_at)
	_light.rebuilt.connect(_on_light_rebuilt)
	_load_tables()
	_show_environment()
	_show_methods()


func _process(_delta: float) -> void:
	_backdrop.global_position = camera.global_position


static func is_compatibility() -> bool:
	return RenderingServer.get_current_rendering_method() == "gl_compatibility"


## Whether the environment is the studio.
func is_live() -> bool:
	return settings[environment_index].panorama == null


## Whether the interior is shown.
func is_inside() -> bool:
	return settings[environment_index].is_interior


## Whether the lamp in the interior is on.
func is_lamp_on() -> bool:
	return _interior.is_lamp_on


func switch_lamp(is_on: bool) -> void:
	_interior.is_lamp_on = is_on
	changed.emit()


## (roughness, anisotropy, the direction's angle in radians) of what is chosen; of several objects,
## those of the first.
func get_widths() -> Vector3:
	return objects[maxi(chosen, 0)].get_widths()


## Sets the same for what is chosen.
func set_widths(widths: Vector3) -> void:
	for object in _get_chosen():
		object.set_widths(widths)
	changed.emit()


## Gives what is chosen the widths that it had at the start.
func reset_widths() -> void:
	for object in _get_chosen():
		object.reset_widths()
	changed.emit()


## Whether one of the halves is drawn by a method.
func shows(method: Methods.Method) -> bool:
	return left_method == method or right_method == method


## Makes the light of what is shown, for all methods. Returns "" once it is there, or one sentence.
func prepare_light() -> String:
	var made := await _light.rebuild()
	# What is captured shows its own light from the second time on.
	if made and is_live():
		made = await _light.rebuild()
	if not made:
		return _light.get_rebuild_error()
	if _light.max_sources > 0:
		# Suns and lamps are taken out some frames later.
		for frame in _SOURCE_FRAMES:
			await RenderingServer.frame_post_draw
	if is_inside():
		var problem := await _interior.prepare_light()
		if problem:
			return problem
	await _light_rivals()
	return ""


func _get_chosen() -> Array[DemoObject]:
	if chosen == EVERY_OBJECT:
		return objects
	var one: Array[DemoObject] = [objects[chosen]]
	return one


func _load_tables() -> void:
	missing_tables.clear()
	var tables := DemoTables.set_of(lobe_count)
	if tables == null:
		missing_tables.append(DemoTables.path_of(lobe_count))
	# Other numbers than the ready sets' are to be seen as they are.
	var quality := LobeMaterial3D.Quality.LOBES_8
	if lobe_count == 8:
		quality = LobeMaterial3D.Quality.AUTOMATIC
	for surface in _surfaces:
		# Without them, the material takes the ready set.
		surface.material.table_set = tables
		surface.material.quality = quality
	_find_missing_thesis()
	changed.emit()


func _find_missing_thesis() -> void:
	if shows(Methods.Method.THESIS) and DemoTables.thesis_set() == null:
		missing_tables.append(DemoTables.THESIS)
	if missing_tables:
		var files := ", ".join(missing_tables)
		push_warning("Tables are missing, run ./dev demo to make them: " + files)


func _show_environment() -> void:
	if not is_node_ready():
		return
	var setting := settings[environment_index]
	var live := is_live()
	_show_interior()
	_studio.visible = live
	_backdrop.visible = not live
	_light.panorama = setting.panorama
	_light.size = _CAPTURE_SIZE if live else 0
	# The captured map is seen behind the scene, suns and all.
	_light.max_sources = 0 if live else 4
	if live:
		_light.source = LobeEnvironment3D.Source.CAPTURE
		# In Compatibility a face is read back at a time, which is enough for one frame.
		_light.update_mode = (
			LobeEnvironment3D.UpdateMode.TIME_SLICED
			if is_compatibility()
			else LobeEnvironment3D.UpdateMode.EVERY_FRAME
		)
	else:
		_light.source = LobeEnvironment3D.Source.PANORAMA
		_light.update_mode = LobeEnvironment3D.UpdateMode.WHEN_CHANGED
		var shown: ShaderMaterial = _backdrop.material_override
		shown.set_shader_parameter(&"panorama", setting.panorama)
	_world.tonemap_exposure = setting.exposure
	_world.sky_rotation = Vector3.ZERO
	_turn_environment()
	_show_stock_light()
	_light_rivals()
	changed.emit()


# The interior or the hall, each as it is seen at the start.
func _show_interior() -> void:
	var inside := is_inside()
	if inside == _interior.visible:
		return
	if inside and _interior.objects.is_empty():
		_interior.build()
		_surfaces.append_array(_interior.objects)
	_interior.visible = inside
	for part: Node3D in [$Plinth, $Objects, $Shadows]:
		part.visible = not inside
	objects = _interior.objects if inside else _hall
	chosen = EVERY_OBJECT
	if inside:
		# The methods before this one know of no rooms.
		left_method = _with_rooms(left_method, Methods.Method.OURS)
		right_method = _with_rooms(right_method, Methods.NONE)
	camera.frame(_interior.view if inside else _hall_view)
	_show_methods()


static func _with_rooms(method: int, otherwise: int) -> int:
	return method if Methods.has_rooms(method) else otherwise


func _turn_environment() -> void:
	if not is_node_ready():
		return
	if is_live():
		_studio.turn_lamp(turn)
		return
	var turned := turn
	if is_inside():
		turned = 0.0
		_interior.roll(turn)
		camera.target = _interior.get_target()
	_light.rotation.y = turned + deg_to_rad(settings[environment_index].turn)
	var shown: ShaderMaterial = _backdrop.material_override
	shown.set_shader_parameter(&"turn", _light.rotation.y / TAU)
	_world.sky_rotation = Vector3(0.0, _light.rotation.y, 0.0)


func _show_methods() -> void:
	if not is_node_ready():
		return
	compare_view.is_comparing = right_method != Methods.NONE
	for surface in _surfaces:
		surface.show_methods(left_method, right_method)
	_show_stock_light()
	_light_rivals()
	_load_tables()


# What the engine's own material is lit by: the engine's sky. Without that material there is none.
func _show_stock_light() -> void:
	var needed := shows(Methods.Method.STOCK)
	_interior.show_engine_probes(needed and is_inside())
	if needed:
		# One for all: Godot 4.6.3 leaks a sky in Compatibility that is freed before it has been drawn.
		if _sky == null:
			_sky = Sky.new()
		_sky.process_mode = Sky.PROCESS_MODE_REALTIME if is_live() else Sky.PROCESS_MODE_QUALITY
		_sky.sky_material = _captured_sky() if is_live() else _panorama_sky()
	_world.sky = _sky if needed else null
	_world.ambient_light_source = (
		Environment.AMBIENT_SOURCE_SKY if needed else Environment.AMBIENT_SOURCE_COLOR
	)
	_world.reflected_light_source = (
		Environment.REFLECTION_SOURCE_SKY if needed else Environment.REFLECTION_SOURCE_DISABLED
	)


func _panorama_sky() -> ShaderMaterial:
	return _make_sky(PanoramaSky, &"panorama", settings[environment_index].panorama)


func _captured_sky() -> ShaderMaterial:
	return _make_sky(CapturedSky, &"captured", _light.get_cubemap())


func _make_sky(shader: Shader, parameter: StringName, map: Texture) -> ShaderMaterial:
	var sky_material := ShaderMaterial.new()
	sky_material.shader = shader
	sky_material.set_shader_parameter(parameter, map)
	sky_material.set_shader_parameter(&"is_srgb", is_compatibility())
	return sky_material


# The map may be another one than before.
func _on_light_rebuilt() -> void:
	if is_live() and _world.sky != null:
		var sky_material := _sky.sky_material as ShaderMaterial
		if sky_material.get_shader_parameter(&"captured") != _light.get_cubemap():
			sky_material.set_shader_parameter(&"captured", _light.get_cubemap())


# The maps of the methods that need their own.
func _light_rivals() -> void:
	if not is_node_ready() or not RivalLight.Pyramid.has_renderer():
		return
	if not shows(Methods.Method.THESIS) and not shows(Methods.Method.SAMPLES):
		return
	_light_request += 1
	var request := _light_request
	var light: RivalLight
	if is_live():
		while _light.get_cubemap() == null or _light.get_cubemap().get_width() != _light.size:
			await _light.rebuild_finished
		light = RivalLight.of_environment(_light)
	else:
		light = await RivalLight.of_panorama(settings[environment_index].panorama)
	if request != _light_request:
		return
	for surface in _surfaces:
		surface.rival_light = light


# The object under a tap; all of them if there is none.
func _choose_at(at: Vector2) -> void:
	var origin := camera.project_ray_origin(at)
	var direction := camera.project_ray_normal(at)
	var best := EVERY_OBJECT
	var nearest := INF
	for index in objects.size():
		var to_object := objects[index].global_transform.affine_inverse()
		var triangles := objects[index].mesh.generate_triangle_mesh()
		var hit := triangles.intersect_ray(
			to_object * origin, (to_object.basis * direction).normalized()
		)
		if hit.is_empty():
			continue
		var at_object: Vector3 = hit["position"]
		var place := objects[index].global_transform * at_object
		if origin.distance_to(place) < nearest:
			nearest = origin.distance_to(place)
			best = index
	chosen = best
