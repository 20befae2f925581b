extends GdUnitTestSuite
## The library's filter makes of a panorama the light that the GPU makes of it.

const Kit := preload("support/render_kit.gd")
const PanoramaFilter := preload("res://addons/lobelight/editor/light/panorama_filter.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const PyramidChain := preload("res://addons/lobelight/runtime/pyramid/pyramid_chain.gd")

## Rows of the panorama, texels of a face, filter, whether texels lie as in the engine's sky.
const CASES := [
	[64, 64, Pyramid.Filter.DISC, false],
	[64, 64, Pyramid.Filter.GAUSSIAN, true],
	[256, 64, Pyramid.Filter.DISC, true],
	[512, 32, Pyramid.Filter.GAUSSIAN, false],
]


# Even light, a slope and lights as small as a panorama shows them, of any colour.
static func _radiance(direction: Vector3) -> Color:
	var value := Vector3(0.3, 0.5, 0.7) * (1.2 + 0.5 * direction.x - 0.4 * direction.y)
	for light: Vector3 in [Vector3(1, 0.2, 0), Vector3(1, 1, 0.1), Vector3(-1, 1, 1)]:
		value += 30.0 * light.abs() * exp(600.0 * (light.normalized().dot(direction) - 1.0))
	return Color(value.x, value.y, value.z)


func test_the_library_filters_as_the_gpu_does(
	height: int, size: int, filter: Pyramid.Filter, as_sky: bool, _test_parameters := CASES
) -> void:
	if not ClassDB.class_exists(&"LobeLightFilter"):
		fail("The native library is not loaded.")
		return
	var panorama: ImageTexture = Kit.make_panorama(height, _radiance)
	var chain := PyramidChain.new()
	chain.pyramid.set_up_panorama(panorama, size, filter, as_sky)
	chain.make_cube()
	chain.draw(-1)
	await RenderingServer.frame_post_draw
	assert_bool(chain.receive(-1)).is_true()
	var drawn: Array[Image] = chain.cube.get_faces()

	var request := PanoramaFilter.make_request(panorama.get_image(), size, filter, as_sky)
	var task: RefCounted = ClassDB.instantiate(&"LobeLightFilter")
	var result: Dictionary = task.call(&"filter", request)
	assert_str(result.get("error", "")).is_empty()
	var light := PanoramaFilter.make_light(request, result)
	assert_str(light.get_problem()).is_empty()
	assert_float(light.base_variance).is_equal(chain.pyramid.level_0_variance)

	# Half floats are ordered as the whole numbers of their bits.
	var steps: Dictionary[int, int] = {}
	var all := 0
	var worst := 0
	for face in 6:
		var expected := drawn[face].get_data()
		var got := light.faces[face].get_data()
		assert_int(got.size()).is_equal(expected.size())
		for at in range(0, got.size(), 2):
			var off := absi(got.decode_u16(at) - expected.decode_u16(at))
			steps[off] = steps.get(off, 0) + 1
			worst = maxi(worst, off)
			all += 1
	var equal: int = steps.get(0, 0)
	var near: int = equal + steps.get(1, 0)
	# Found are 0.9991 and more equal, and all within a step.
	assert_float(float(equal) / all).is_greater_equal(0.99)
	assert_float(float(near) / all).is_greater_equal(0.9999)
	assert_int(worst).is_less_equal(4)
