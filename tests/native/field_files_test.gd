extends GdUnitTestSuite
## Files as people meet them in the field, and what LobeImageFile says of each.

# Why each file of tests/data/field is refused, or what is remarked on it;
# empty where there is nothing to say.
const FIELD := {
	"20000_wide.hdr":
	"has 20000 x 2 texels, but a texture holds 16384 along a side; make it smaller",
	"cross_3x4.hdr":
	(
		"is 48 x 64 texels, but a panorama (latitude-longitude, 360 x 180 degrees) is"
		+ " twice as wide as high; this may be a cross of a cube"
	),
	"flat_looks_like_rle.hdr": "",
	"format_space.hdr": "",
	"inf_sun.exr":
	(
		"has 12 texels that are infinite and have 65504 now; how bright the light was"
		+ " there, the file does not say"
	),
	"lowercase_rgb.exr": "",
	"plus_x_minus_y.hdr": "",
	"plus_y.hdr": "",
	"position_xyz.exr":
	(
		"has no colours but coordinates, such as positions or normals (X, Y, Z);"
		+ " save CIE XYZ as R, G and B with its chromaticities"
	),
	"red_green_blue.exr": "",
	"resolution_space.hdr": "",
	"sun_1e6.hdr":
	(
		"has 4 texels that are brighter than 65504 and have that now: 92.4 % of the light"
		+ " is lost; an Exposure of -4.0 EV keeps it"
	),
	"xyze.hdr":
	(
		"was converted from CIE XYZ to Rec. 709;"
		+ " has 840 texels with negative channels, which are 0 now"
	),
}


func test_files_from_the_field() -> void:
	var folder := "res://tests/data/field"
	var files := Array(DirAccess.get_files_at(folder))
	assert_array(files).contains_exactly_in_any_order(FIELD.keys())
	for file: String in FIELD:
		var path := folder.path_join(file)
		var read := LobeImageFile.load_half_panorama(path)
		var said := "; ".join(PackedStringArray(read.get("notes", []) + read.get("warnings", [])))
		if read.has("error"):
			said = read.error.trim_prefix(ProjectSettings.globalize_path(path) + ": ")
		assert_str(said).append_failure_message(file).is_equal(FIELD[file])


# Whatever their headers say in whatever way, the picture is one.
func test_field_files_of_one_picture_are_equal() -> void:
	var folder := "res://tests/data/field"
	var expected := LobeImageFile.load_panorama(folder.path_join("format_space.hdr"))
	var pixels: PackedFloat32Array = expected.pixels
	# Red grows to the right, green downwards, blue is even.
	assert_float(pixels[0]).is_equal(102.0 / 512.0)
	assert_float(pixels[3 * 63]).is_greater(5.0 * pixels[0])
	assert_float(pixels[3 * 31 * 64 + 1]).is_greater(5.0 * pixels[1])
	for file: String in ["resolution_space.hdr", "plus_y.hdr", "plus_x_minus_y.hdr"]:
		var read := LobeImageFile.load_panorama(folder.path_join(file))
		assert_int(read.width).is_equal(64)
		assert_bool(read.pixels == pixels).append_failure_message(file).is_true()
	# But for the first texel, which looks like the beginning of a run.
	var flat := LobeImageFile.load_panorama(folder.path_join("flat_looks_like_rle.hdr"))
	assert_bool(flat.pixels.slice(3) == pixels.slice(3)).is_true()
	assert_float(flat.pixels[0]).is_less(1e-20)
	for file: String in ["lowercase_rgb.exr", "red_green_blue.exr"]:
		var read := LobeImageFile.load_panorama(folder.path_join(file))
		assert_bool(read.pixels.slice(0, 3) == PackedFloat32Array([0.0, 0.0, 0.25])).is_true()
		var last: PackedFloat32Array = read.pixels.slice(-3)
		assert_bool(last == PackedFloat32Array([0.984375, 0.96875, 0.25])).is_true()


func test_comparisons_pass_on_what_is_said() -> void:
	var cross := Comparison.load_panorama("res://tests/data/field/cross_3x4.hdr")
	assert_array(cross.keys()).contains_exactly_in_any_order(["texture", "remarks"])
	assert_str(cross["remarks"][0]).contains("cross_3x4.hdr: is 48 x 64 texels")
	var wide := Comparison.load_panorama("res://tests/data/field/20000_wide.hdr")
	assert_str(wide["error"]).contains("20000_wide.hdr: has 20000 texels along a side")
