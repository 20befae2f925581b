extends GdUnitTestSuite
## What has to be written in more than one language, or in two layers that do not know each other,
## says the same everywhere.

const DiffuseSource := preload("res://addons/lobelight/runtime/light/diffuse_source.gd")
const LightSettings := preload("res://addons/lobelight/runtime/light/light_settings.gd")
const NeutralLight := preload("res://addons/lobelight/runtime/light/neutral_light.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")
const Widths := preload("res://addons/lobelight/runtime/table/widths.gd")

const RUN_TIME := "res://addons/lobelight/runtime/"
const LIBRARY := "res://gdextension/src/"
const NUMBER := "(-?[\\d.]+)"


func test_enumerations_are_alike() -> void:
	assert_dict(Pyramid.Filter as Dictionary).is_equal(LobeEnvironment3D.Filter as Dictionary)
	assert_dict(LightSettings.Source as Dictionary).is_equal(LobeEnvironment3D.Source as Dictionary)
	assert_dict(LightSettings.UpdateMode as Dictionary).is_equal(
		LobeEnvironment3D.UpdateMode as Dictionary
	)
	assert_dict(DiffuseSource.Source as Dictionary).is_equal(
		LobeMaterial3D.DiffuseLight as Dictionary
	)


# The directions of a face's corners, as three languages have them.
func test_faces_lie_alike() -> void:
	var shader := _directions_of(
		RUN_TIME + "shaders/cube_faces.gdshaderinc", "return vec3\\((.*)\\);"
	)
	var library := _directions_of(LIBRARY + "image/cube_faces.h", "return \\{(.*)\\};")
	for places: Array[String] in [shader, library]:
		assert_int(places.size()).is_equal(6)
		for face in 6:
			var expression := Expression.new()
			assert_int(expression.parse("Vector3(%s)" % places[face], ["p"])).is_equal(OK)
			for p: Vector2 in [Vector2(-1.0, 0.5), Vector2(0.25, 1.0)]:
				var direction: Vector3 = expression.execute([p])
				assert_vector(NeutralLight.face_direction(face, p)).is_equal(direction)


# That they are those of OpenGL 4.6, table 8.19: the axis, and what goes to the right and down.
func test_faces_are_those_of_cube_maps() -> void:
	const TABLE: Array[String] = [
		"+x -z -y", "-x +z -y", "+y +x +z", "-y +x -z", "+z +x -y", "-z -x -y"
	]
	for face in 6:
		var axes := Array(TABLE[face].split(" ")).map(_axis)
		var middle := NeutralLight.face_direction(face, Vector2.ZERO)
		assert_vector(middle).is_equal(axes[0])
		assert_vector(NeutralLight.face_direction(face, Vector2.RIGHT) - middle).is_equal(axes[1])
		assert_vector(NeutralLight.face_direction(face, Vector2.DOWN) - middle).is_equal(axes[2])


# Kernels of the pyramid: on the GPU, in the library, and their names where they are asked for.
func test_filters_are_alike() -> void:
	var library := FileAccess.get_file_as_string(LIBRARY + "image/round_kernel.h")
	var discs := _find(library, "\\{false, %s, %s, %s\\}" % [NUMBER, NUMBER, NUMBER])
	assert_int(discs.size()).is_equal(Pyramid.COARSE_DISCS.size())
	for level in discs.size():
		var disc := Vector3(
			discs[level].get_string(1).to_float(),
			discs[level].get_string(2).to_float(),
			discs[level].get_string(3).to_float()
		)
		assert_vector(Pyramid.COARSE_DISCS[1 << level]).is_equal(disc)
	var options := FileAccess.get_file_as_string(LIBRARY + "image/pyramid.h")
	var variance := _find(options, "level_variance = %s / %s;" % [NUMBER, NUMBER])[0]
	var parts := variance.get_string(1).to_float() / variance.get_string(2).to_float()
	for filter: Pyramid.Filter in [Pyramid.Filter.DISC, Pyramid.Filter.GAUSSIAN]:
		assert_float(Pyramid.LEVEL_VARIANCES[filter]).is_equal_approx(parts, 1e-12)
	var shader := FileAccess.get_file_as_string(RUN_TIME + "shaders/round_kernel.gdshaderinc")
	var constants: Dictionary[String, String] = {
		"REACH": "kKernelReach",
		"REACHED_SHARE": "kReachedShare",
		"RIM_VARIANCE": "kRimVariance",
		"MOST_REACH": "kMostReach",
	}
	for name in constants:
		var drawn := _find(shader, "\\b%s = %s;" % [name, NUMBER])
		var filtered := _find(library, "\\b%s = %s;" % [constants[name], NUMBER])
		assert_array([drawn.size(), filtered.size()]).is_equal([1, 1])
		assert_str(drawn[0].get_string(1)).is_equal(filtered[0].get_string(1))


# Widths of a roughness and an anisotropy, where a shader has the formula and where a script has.
func test_widths_are_alike() -> void:
	var formula := RegEx.create_from_string(
		"max\\(1\\.0 - %s \\* \\w*anisotropy\\w*, %s\\)" % [NUMBER, NUMBER]
	)
	var shaders: Array[String] = [
		"shaders/widths.gdshaderinc",
		"antialiasing/normal_variance.gdshaderinc",
		"sources/source_highlights.gdshaderinc",
	]
	for path in shaders:
		var found := formula.search_all(FileAccess.get_file_as_string(RUN_TIME + path))
		assert_int(found.size()).override_failure_message(path).is_equal(1)
		var strength := found[0].get_string(1).to_float()
		var least := found[0].get_string(2).to_float()
		for anisotropy: float in [-1.0, 0.0, 0.7, 1.0, 1.0999, 1.3]:
			var ratio := maxf(1.0 - strength * anisotropy, least)
			var widths := Widths.from_roughness(0.5, anisotropy)
			assert_float(widths.y / widths.x).is_equal_approx(ratio, 1e-6)


static func _directions_of(path: String, pattern: String) -> Array[String]:
	var found: Array[String] = []
	for match in _find(FileAccess.get_file_as_string(path), pattern):
		# Those of directions, not of places.
		if match.get_string(1).count(",") == 2 and found.size() < 6:
			found.append(match.get_string(1))
	return found


static func _find(text: String, pattern: String) -> Array[RegExMatch]:
	return RegEx.create_from_string(pattern).search_all(text)


static func _axis(name: String) -> Vector3:
	var axis := Vector3.ZERO
	axis["xyz".find(name[1])] = -1.0 if name[0] == "-" else 1.0
	return axis
