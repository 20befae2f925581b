@tool
extends "../light/world_light.gd"
## The light of the world around a node: its sky, alone or with the scene before it, seen by six
## cameras; or the panorama of its sky.

const LightRegistry := preload("../light/light_registry.gd")
const SixViews := preload("six_views.gd")
const SkyStage := preload("sky_stage.gd")
const Surroundings := preload("surroundings.gd")

# The sky has no depth.
const _SKY_NEAR := 0.05
const _SKY_FAR := 10.0

var _node: Node3D
var _views := Views.NONE
var _surroundings: Surroundings
var _stage: SkyStage


func _init(node: Node3D) -> void:
	_node = node
	_surroundings = Surroundings.new(node, false)


func find_panorama() -> Texture2D:
	return _surroundings.find_panorama()


func find_panorama_energy() -> float:
	return _surroundings.find_panorama_energy()


func is_even() -> bool:
	return _surroundings.is_even()


func find_even_light() -> Color:
	return _surroundings.find_even_light()


func find_shortage() -> String:
	return _surroundings.find_shortage()


func find_sky_rotation() -> Basis:
	return _surroundings.find_sky_rotation()


func look(views: Views) -> bool:
	if views != _views:
		_views = views
		_surroundings = Surroundings.new(_node, views == Views.SCENE)
		_stage = SkyStage.new(_node) if views == Views.SKY else null
	var changed := false
	if views != Views.NONE:
		changed = _surroundings.update()
	if _stage != null:
		changed = _stage.update() or changed
	return changed


func make_views(samples: int, face_size: int) -> FaceViews:
	var is_sky := _views == Views.SKY
	var world := _node.get_world_3d()
	var scenario := _stage.scenario if is_sky else world.scenario
	var owner: RefCounted = _stage if is_sky else world
	return SixViews.new(samples * face_size, scenario, owner, not is_sky)


func place(views: FaceViews, place: ViewPlace) -> void:
	var six := views as SixViews
	var placed := LightRegistry.get_placed()
	var world := 0
	if placed != null:
		world = placed.get_camera_bits(_node.get_world_3d().scenario, place.is_probe)
	if _views == Views.SCENE:
		six.show(_surroundings.copy if place.sees_background else _make_dark())
		six.place(place.origin, place.basis, place.near, place.far, place.cull_mask | world)
	elif _views == Views.SKY:
		# From where the camera is, since shaders may ask.
		var camera := _surroundings.find_camera()
		var origin := camera.global_position if camera != null else _node.global_position
		var mask := camera.cull_mask if camera != null else 0xFFFFF
		six.show(_surroundings.copy)
		six.place(origin, Basis.IDENTITY, _SKY_NEAR, _SKY_FAR, mask | world)


# The same light for the scene, with nothing behind it.
func _make_dark() -> Environment:
	var dark: Environment = _surroundings.copy.duplicate()
	dark.background_mode = Environment.BG_COLOR
	dark.background_color = Color.BLACK
	dark.background_energy_multiplier = 1.0
	return dark
