@tool
extends RefCounted
## Where the light of a [LobeEnvironment3D] comes from at the moment: which kind of source it is,
## whether it has changed, and the chain that draws it.

## A panorama of the node's, the same light from all sides as there is no sky, the panorama of a
## sky, views of a sky, views of the scene.
enum Kind { NONE, PANORAMA, EVEN, SKY_PANORAMA, SKY_VIEWS, SCENE_VIEWS }

const LightSettings := preload("../light/light_settings.gd")
const LiveTextures := preload("../light/live_textures.gd")
const FaceViews := preload("../pyramid/face_views.gd")
const Pyramid := preload("../pyramid/pyramid.gd")
const HandedSources := preload("../pyramid/handed_sources.gd")
const SourceSearch := preload("sources/source_search.gd")
const PyramidChain := preload("../pyramid/pyramid_chain.gd")
const WorldLight := preload("../light/world_light.gd")

## The setting with the milliseconds of the GPU in which a slice is to be drawn; 0 for as long as it
## takes.
const BUDGET_SETTING := "lobelight/environments/budget_ms"
const DEFAULT_BUDGET := 2.0
## Where nothing says how fine the light is.
const DEFAULT_SIZE := 256
# Pixels of a view along the side of a texel. Skies have suns of few texels; scenes cost more.
const _SKY_SAMPLES := 2
const _SCENE_SAMPLES := 1
# After this many frames without sources they count as gone, and materials get other shaders. It is
# so long that a cloud before the sun does not change shaders.
const _PATIENCE := 30

# 0 or 1 once it is known.
static var _is_compatible := -1

var _settings: LightSettings
var _kind := Kind.NONE
# Null while the light is that of the node's own panorama.
var _world: WorldLight
# What the last chain was made for, and the light that it gives.
var _key: Array = []
var _light: LobeLight
# Whether sources are taken out, and materials draw them; for how many frames there have been none.
var _takes_sources := false
var _gone := 0


func _init(settings: LightSettings) -> void:
	_settings = settings


## Milliseconds of the GPU in which a slice is to be drawn; 0 for as long as it takes.
static func find_budget() -> float:
	if not ProjectSettings.has_setting(BUDGET_SETTING):
		return DEFAULT_BUDGET
	return maxf(ProjectSettings.get_setting_with_override(BUDGET_SETTING), 0.0)


## Which part of the run time is missing because the export has left it out, in a sentence; empty if
## none.
func find_loss() -> String:
	var losses: Array[String] = [PyramidChain.find_loss(), Pyramid.find_loss(_settings.filter)]
	if not _settings.takes_panorama():
		losses.append(WorldLight.find_loss())
	for loss in losses:
		if loss:
			return loss
	return ""


## Why there is no light to be had, in a sentence; empty if there is.
func find_obstacle() -> String:
	var panorama := _settings.panorama
	if not _settings.takes_panorama() and not _settings.node.is_inside_tree():
		if _settings.source == LightSettings.Source.AUTOMATIC:
			return "There is no panorama, and the node is in no world whose sky it could take."
		return "The node is in no world whose light it could take."
	if _settings.takes_panorama() and panorama == null:
		return "There is no panorama."
	if not Pyramid.has_renderer():
		return "There is no renderer to make the pyramid with: the engine runs headless."
	if _settings.takes_panorama() and (panorama.get_width() < 1 or panorama.get_height() < 1):
		return "The panorama is empty."
	return ""


## Looks at the source; returns whether it has changed since the last look. A panorama of a sky that
## is turned or has another energy counts as unchanged, see [method place].
func look() -> bool:
	if _settings.takes_panorama():
		_world = null
	elif _world == null:
		_world = WorldLight.of(_settings.node)
	var kind := _find_kind()
	var changed := kind != _kind
	_kind = kind
	if _world != null:
		changed = _world.look(_get_views()) or changed
	if _kind == Kind.PANORAMA or _kind == Kind.SKY_PANORAMA:
		changed = changed or LiveTextures.is_live(_find_panorama())
	return _make_key() != _key or changed


## The chain that draws the light. It takes over from [param chain], which may be null, what stays
## the same. Even light needs no drawing: null.
func make_chain(chain: PyramidChain) -> PyramidChain:
	var key := _make_key()
	if _kind == Kind.EVEN:
		_light = null if key != _key else _light
		_key = key
		_forget_sources()
		return null
	if chain != null and key == _key:
		if chain.views != null:
			_place_views(chain.views)
		if chain.search != null:
			(chain.search as SourceSearch).take_out(_takes_sources)
		return chain
	# A chain that was given back has left its cube map with the light.
	var old := _light.cubemap if chain == null and key == _key and _light != null else null
	var old_sources := _light.sources if old != null else null
	_key = key
	if old == null:
		_light = null
	var filter := _settings.filter
	if _kind >= Kind.SKY_VIEWS:
		var size: int = _settings.size if _settings.size > 0 else DEFAULT_SIZE
		var samples := _SKY_SAMPLES if _kind == Kind.SKY_VIEWS else _SCENE_SAMPLES
		var views := _world.make_views(samples, size)
		_place_views(views)
		chain = PyramidChain.new(views)
		if _settings.max_sources > 0:
			chain.search = SourceSearch.in_views(
				chain.pyramid,
				views.get_textures(),
				samples * size,
				_settings.max_sources,
				old_sources
			)
		chain.pyramid.set_up_views(views.get_textures(), samples, size, filter)
	else:
		var panorama := _find_panorama()
		var size := _settings.size if _settings.size > 0 else Pyramid.automatic_size(panorama)
		chain = PyramidChain.new()
		if _settings.max_sources > 0 and Pyramid.is_linear(panorama):
			var as_sky := _kind == Kind.SKY_PANORAMA
			chain.search = SourceSearch.in_panorama(
				chain.pyramid, panorama, as_sky, _settings.max_sources, old_sources
			)
		chain.pyramid.set_up_panorama(panorama, size, filter, _kind == Kind.SKY_PANORAMA)
		if not panorama.changed.is_connected(_settings.on_panorama_changed):
			panorama.changed.connect(_settings.on_panorama_changed)
	if chain.search != null:
		(chain.search as SourceSearch).take_out(_takes_sources)
	else:
		_forget_sources()
	chain.make_cube(old)
	if _settings.measure_cost:
		chain.measure()
	return chain


## The light that a chain has made, the same object for every update of the chain. Without one,
## even light.
func get_light(chain: PyramidChain) -> LobeLight:
	if chain == null:
		if _light == null:
			var even := Pyramid.is_round(_settings.filter)
			_light = LobeLight.make_constant(_world.find_even_light(), even)
		return _light
	if _light == null or _light.cubemap != chain.cube.texture:
		_light = LobeLight.new()
		_light.cubemap = chain.cube.texture
		_light.size = chain.pyramid.size
		_light.level_variance = Pyramid.LEVEL_VARIANCES[chain.pyramid.filter]
		_light.base_variance = chain.pyramid.level_0_variance
		_light.is_even = Pyramid.is_round(chain.pyramid.filter)
	var search := chain.search as SourceSearch
	_light.sources = search.handed.texture if search != null and search.takes_out else null
	return _light


## Whether the next light will have sources taken out of it.
func takes_sources() -> bool:
	return _takes_sources and _settings.max_sources > 0


## Whether another update is needed, because a search has found sources that are still in the
## light, or has found none for some time that are out of it. To be called once a frame.
func follow_search(chain: PyramidChain) -> bool:
	var search := chain.search as SourceSearch
	if search == null:
		return false
	match search.handed.take_answer():
		HandedSources.Answer.SOME:
			_gone = 0
			if not _takes_sources:
				_takes_sources = true
				return true
		HandedSources.Answer.NONE:
			_gone = maxi(_gone, 1)
	if _gone > 0 and _takes_sources:
		_gone += 1
		_takes_sources = _gone <= _PATIENCE
		return not _takes_sources
	return false


## Whether a search may still ask for another update.
func awaits_search(chain: PyramidChain) -> bool:
	var search := chain.search as SourceSearch
	if search == null:
		return false
	return search.handed.awaits_answer() or _gone > 0 and _takes_sources


## Whether what it shows does not come with the frame itself, as pictures of other viewports do.
func is_there_before_the_frame() -> bool:
	if _kind != Kind.PANORAMA and _kind != Kind.SKY_PANORAMA:
		return true
	return not LiveTextures.is_live(_find_panorama())


## Gives a light that was made from this kind of source its rotation and energy; whether they are
## others than before.
func place(light: LobeLight, kind: Kind) -> bool:
	var energy := _settings.energy
	var rotation := light.rotation if kind == Kind.PANORAMA else Basis.IDENTITY
	if kind == Kind.PANORAMA and _settings.node.is_inside_tree():
		rotation = _settings.node.global_basis.orthonormalized()
	elif kind == Kind.SKY_PANORAMA and _world != null:
		if not _settings.node.is_inside_tree() or _world.find_panorama() == null:
			return false
		energy *= _world.find_panorama_energy()
		rotation = _world.find_sky_rotation()
	if light.energy == energy and light.rotation == rotation:
		return false
	light.energy = energy
	light.rotation = rotation
	return true


func get_kind() -> Kind:
	return _kind


## Why even light is none, or shows nothing, and what to do, in a sentence; empty if it is as meant.
func find_shortage() -> String:
	return _world.find_shortage() if _kind == Kind.EVEN and _world != null else ""


## To be called when the node leaves its world; whether its light has been that world's.
func leave_world() -> bool:
	_world = null
	if _kind == Kind.PANORAMA or _kind == Kind.NONE:
		return false
	# That world may go on showing it.
	_light = null
	return true


# Without a search nothing would ever say that the sources have gone, so they are forgotten.
func _forget_sources() -> void:
	_takes_sources = false
	_gone = 0


func _find_kind() -> Kind:
	if _settings.takes_panorama():
		return Kind.PANORAMA
	if _settings.source == LightSettings.Source.CAPTURE:
		return Kind.SCENE_VIEWS
	if _world.is_even():
		return Kind.EVEN
	# Compatibility takes the colours of skies for sRGB. What comes of that, views show.
	if _is_compatibility():
		return Kind.SKY_VIEWS
	return Kind.SKY_VIEWS if _world.find_panorama() == null else Kind.SKY_PANORAMA


func _get_views() -> WorldLight.Views:
	match _kind:
		Kind.SKY_VIEWS:
			return WorldLight.Views.SKY
		Kind.SCENE_VIEWS:
			return WorldLight.Views.SCENE
	return WorldLight.Views.NONE


func _place_views(views: FaceViews) -> void:
	_settings.capture.origin = _settings.node.global_position
	_world.place(views, _settings.capture)


func _find_panorama() -> Texture2D:
	return _settings.panorama if _kind == Kind.PANORAMA else _world.find_panorama()


func _make_key() -> Array:
	if _kind == Kind.EVEN:
		return [_kind, _settings.filter, _world.find_even_light()]
	if _kind >= Kind.SKY_VIEWS:
		return [
			_kind, _settings.size, _settings.filter, _settings.measure_cost, _settings.max_sources
		]
	var panorama := _find_panorama()
	var texture := panorama.get_rid() if panorama != null else RID()
	var width := panorama.get_width() if panorama != null else 0
	return [
		_kind,
		_settings.size,
		_settings.filter,
		_settings.measure_cost,
		_settings.max_sources,
		texture,
		width
	]


# Asked in each frame.
static func _is_compatibility() -> bool:
	if _is_compatible == -1:
		var method := RenderingServer.get_current_rendering_method()
		_is_compatible = int(method == "gl_compatibility")
	return _is_compatible == 1
