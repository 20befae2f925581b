extends GdUnitTestSuite
## What probes capture of rooms whose walls show the light of probes themselves.

const Kit := preload("support/render_kit.gd")
const LightStore := preload("res://addons/lobelight/runtime/probes/light_store.gd")
const SkyKit := preload("support/sky_kit.gd")
const SIDE := 8
const MIDDLE := 4
# Half the side of the room.
const WALL := 4.0
const ALBEDO := 0.6
const SKY := 1.0

var _view: LinearViewport
var _walls: Array[MeshInstance3D] = []
var _window_size: Vector2i


func before() -> void:
	# Frames take as long as the window takes to be shown.
	_window_size = get_window().size
	get_window().size = Vector2i(64, 64)
	ProjectSettings.set_setting(LightStore.SETTING, 16)


func after() -> void:
	get_window().size = _window_size
	ProjectSettings.set_setting(LightStore.SETTING, null)


# A closed room under a bright sky.
func before_test() -> void:
	_view = LinearViewport.new(SIDE)
	add_child(_view)
	_view.camera.environment.background_color = Color.WHITE
	_walls.clear()
	for axis in SkyKit.AXES:
		_walls.append(_add_wall(axis))
	var light := LobeEnvironment3D.new()
	light.panorama = Kit.constant(SKY)
	light.size = 8
	_view.add_child(light)


func after_test() -> void:
	_view.free()


func test_a_closed_room_without_a_lamp_is_dark() -> void:
	await _settle()
	var probe := _add_probe()
	# It is lit by the sky until the room has been captured, and then it is dark.
	var seen: Array[float] = []
	for i in 40:
		var image: Image = await _view.capture()
		seen.append(image.get_pixel(MIDDLE, MIDDLE).g)
	var told := "%s" % [seen]
	assert_float(seen[0]).append_failure_message(told).is_greater(0.3)
	assert_float(seen.back()).append_failure_message(told).is_less(1e-6)
	for value in seen:
		var is_either := absf(value - seen[0]) < 0.01 or value < 0.001
		assert_bool(is_either).append_failure_message(told).is_true()
	# But for the rounding of a wall's place, which is the end of the box.
	assert_float(_mean(probe)).is_less(1e-6)


func test_the_sky_is_captured_where_it_is_seen() -> void:
	await _settle()
	_walls[0].free()
	var probe := _add_probe()
	assert_bool(await probe.rebuild()).is_true()
	assert_float(_mean(probe)).is_greater(0.2)
	# Unless the probe is for what is inside.
	probe.interior = true
	probe.update_mode = LobeProbe3D.UpdateMode.EVERY_FRAME
	for i in 40:
		await RenderingServer.frame_post_draw
	assert_float(_mean(probe)).is_less(0.01)


func test_few_captures_come_to_what_endless_ones_show() -> void:
	_material_of(_walls[0]).emission = Color.WHITE
	await _settle()
	var probe := _add_probe()
	assert_bool(await probe.rebuild()).is_true()
	var few := _mean(probe)
	probe.update_mode = LobeProbe3D.UpdateMode.EVERY_FRAME
	for i in 24:
		await RenderingServer.frame_post_draw
	var endless := _mean(probe)
	assert_float(endless).is_greater(0.1)
	assert_float(few / endless).is_between(0.85, 1.0)


# Until the engine has compiled its shaders, with those that stand in a capture may be black: a
# probe that is thrown away sees light.
func _settle() -> void:
	var material := _material_of(_walls[0])
	var before := material.emission
	material.emission = Color.WHITE
	material.emission_enabled = true
	var probe := _add_probe()
	for i in 500:
		await probe.rebuild()
		if _mean(probe) > 0.15:
			break
	probe.free()
	material.emission = before
	material.emission_enabled = true
	for i in 6:
		await RenderingServer.frame_post_draw


func _add_probe() -> LobeProbe3D:
	var probe := LobeProbe3D.new()
	probe.size = 2.0 * WALL * Vector3.ONE
	_view.add_child(probe)
	return probe


# What the probe's light comes to, over all texels.
func _mean(probe: LobeProbe3D) -> float:
	var sum := 0.0
	var count := 0
	for face in probe.get_light().faces:
		for y in face.get_height():
			for x in face.get_width():
				sum += face.get_pixel(x, y).g
				count += 1
	return sum / count


func _material_of(wall: MeshInstance3D) -> LobeMaterial3D:
	return (wall.mesh as QuadMesh).material as LobeMaterial3D


func _add_wall(axis: Vector3) -> MeshInstance3D:
	var material := LobeMaterial3D.new()
	material.roughness = 0.4
	material.albedo_color = Color(ALBEDO, ALBEDO, ALBEDO)
	material.metallic = 0.0
	material.cull_mode = BaseMaterial3D.CULL_DISABLED
	var mesh := QuadMesh.new()
	mesh.size = 2.0 * WALL * Vector2.ONE
	mesh.material = material
	var wall := MeshInstance3D.new()
	wall.mesh = mesh
	_view.add_child(wall)
	var up := Vector3.UP if absf(axis.y) < 0.9 else Vector3.BACK
	wall.look_at_from_position(WALL * axis, 2.0 * WALL * axis, up)
	return wall
