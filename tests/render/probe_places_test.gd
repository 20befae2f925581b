extends GdUnitTestSuite
## Which probes show, where there are more than a renderer can show at once: in Compatibility the
## four nearest to the camera, in the others all.

const Kit := preload("support/render_kit.gd")
const LightStore := preload("res://addons/lobelight/runtime/probes/light_store.gd")
const SkyKit := preload("support/sky_kit.gd")
const SIDE := 160
const COUNT := 6
const SPACING := 10.0
const OUTSIDE := 0.9
# Seconds until the camera's place is looked at again, and some more.
const PATIENCE := 0.3

var _view: LinearViewport
var _probes: Array[LobeProbe3D] = []
var _window_size: Vector2i


func before() -> void:
	# Frames take as long as the window takes to be shown.
	_window_size = get_window().size
	get_window().size = Vector2i(64, 64)
	ProjectSettings.set_setting(LightStore.SETTING, 16)


func after() -> void:
	get_window().size = _window_size
	ProjectSettings.set_setting(LightStore.SETTING, null)


# A row of balls, each with a probe around it that has seen another colour. A pixel is a metre.
func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_view.camera.set_orthogonal(SIDE, 0.1, 20.0)
	_probes.clear()
	var light := LobeEnvironment3D.new()
	light.panorama = Kit.constant(OUTSIDE)
	light.size = 8
	_view.add_child(light)
	for i in COUNT:
		var ball := SkyKit.make_mirror()
		ball.position.x = SPACING * i
		ball.scale = 2.0 * Vector3.ONE
		ball.layers = 2
		_view.add_child(ball)
		var probe := LobeProbe3D.new()
		probe.cull_mask = 1
		probe.position.x = SPACING * i
		probe.size = 6.0 * Vector3.ONE
		_view.camera.environment.background_color = Color(0.0, _value_of(i), 0.0)
		_view.add_child(probe)
		_probes.append(probe)
		assert_bool(await probe.rebuild()).is_true()
	_view.camera.environment.background_color = Color.BLACK


func after_test() -> void:
	_view.free()


func test_the_nearest_show() -> void:
	var all := range(COUNT)
	_view.camera.position.x = 0.0
	await _assert_shown(all if _has_array() else [0, 1, 2, 3])
	_view.camera.position.x = SPACING * (COUNT - 1)
	await _assert_shown(all if _has_array() else [2, 3, 4, 5])
	# A step back and forth where two are about as near changes nothing.
	for offset: float in [2.0, 2.1, 1.9]:
		_view.camera.position.x = SPACING * offset + 5.0
		await _assert_shown(all if _has_array() else [1, 2, 3, 4])
	_view.camera.position.x = 0.0
	await _assert_shown(all if _has_array() else [0, 1, 2, 3])
	# One that goes makes room.
	_probes[1].hide()
	all.erase(1)
	await _assert_shown(all if _has_array() else [0, 2, 3, 4])


func test_worlds_take_from_the_places() -> void:
	var other := LinearViewport.new(8)
	add_child(other)
	var light := LobeEnvironment3D.new()
	light.panorama = Kit.constant(2.0)
	light.size = 8
	other.add_child(light)
	other.add_child(SkyKit.make_mirror())
	await get_tree().create_timer(PATIENCE).timeout
	_view.camera.position.x = 0.0
	await _assert_shown(range(COUNT) if _has_array() else [0, 1, 2])
	var image: Image = await other.capture()
	assert_float(image.get_pixel(4, 4).g).is_equal_approx(2.0, 0.02)
	other.free()


func _value_of(index: int) -> float:
	return 0.1 + 0.1 * index


func _has_array() -> bool:
	return not LinearViewport.is_compatibility()


# That these probes show in their boxes, and the environment in those of the others.
func _assert_shown(expected: Array) -> void:
	await get_tree().create_timer(PATIENCE).timeout
	var image: Image = await _view.capture()
	for i in COUNT:
		var x := SIDE / 2.0 + SPACING * i - _view.camera.position.x
		if x < 0.0 or x >= SIDE:
			continue
		var got := image.get_pixel(floori(x), floori(0.5 * SIDE)).g
		var wanted := OUTSIDE
		if i in expected:
			wanted = Color(0.0, _value_of(i), 0.0).srgb_to_linear().g
		assert_float(got).append_failure_message("probe %d" % i).is_equal_approx(wanted, 0.02)
