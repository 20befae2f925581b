extends GdUnitTestSuite
## The cube map that takes a pyramid without leaving the GPU says when it could not.

const CanvasPass := preload("res://addons/lobelight/runtime/pyramid/canvas_pass.gd")
const GpuCube := preload("res://addons/lobelight/runtime/rendering_device/gpu_cube.gd")
const SIZE := 4


func test_what_is_gone_is_not_received() -> void:
	if LinearViewport.is_compatibility():
		assert_object(RenderingServer.get_rendering_device()).is_null()
		return
	var levels: Array[CanvasPass] = [CanvasPass.new(Vector2i(3, 2) * SIZE, true)]
	var cube := GpuCube.new(SIZE, levels)
	await RenderingServer.frame_post_draw
	assert_bool(cube.receive(0)).is_true()
	levels.clear()
	await RenderingServer.frame_post_draw
	assert_bool(cube.receive(0)).is_false()
