extends GdUnitTestSuite
## LinearViewport: what it reads back and what it measures.

var _view: LinearViewport


func before_test() -> void:
	_view = LinearViewport.new(32)
	add_child(_view)


func after_test() -> void:
	_view.free()


func test_background_is_empty() -> void:
	var image: Image = await _view.capture()
	assert_int(image.get_format()).is_equal(Image.FORMAT_RGBAF)
	assert_vector(image.get_size()).is_equal(Vector2i(32, 32))
	assert_object(image.get_pixel(5, 5)).is_equal(Color(0.0, 0.0, 0.0, 0.0))


func test_size_of_the_picture() -> void:
	# Two units are shown, so that half a unit from the middle is a quarter of the picture.
	var quad := QuadMesh.new()
	quad.size = Vector2(1.0, 2.0)
	quad.material = LobeMaterial3D.new()
	var instance := MeshInstance3D.new()
	instance.mesh = quad
	_view.add_child(instance)
	var image: Image = await _view.capture()
	for x in 32:
		var inside := x >= 8 and x < 24
		assert_float(image.get_pixel(x, 16).a).is_equal(1.0 if inside else 0.0)


func test_gpu_time() -> void:
	var instance := SphereImpostor.make(LobeTable.make_single_lobe())
	_view.add_child(instance)
	var times: PackedFloat32Array = await _view.measure_gpu_time(5)
	assert_int(times.size()).is_equal(5)
	assert_float(times[0]).is_greater(0.0)


func test_median() -> void:
	assert_float(LinearViewport.median([3.0, 1.0, 9.0])).is_equal(3.0)
	assert_float(LinearViewport.median([4.0, 1.0, 9.0, 2.0])).is_equal(3.0)
	assert_float(LinearViewport.median([])).is_equal(0.0)
