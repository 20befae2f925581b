extends GdUnitTestSuite
## Suns of panoramas in the lights that are made of them and saved: all of their energy, in every
## format, in copies and in what is exported.

const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const LightImporter := preload("res://addons/lobelight/editor/import/light_importer.gd")
const LightVariant := preload("res://addons/lobelight/editor/export/light_variant.gd")
const Progress := preload("res://addons/lobelight/editor/import/import_progress.gd")
const Pyramid := preload("res://addons/lobelight/runtime/pyramid/pyramid.gd")

const SUN := "res://tests/data/field/sun_1e6.hdr"
const PATH := "user://light_sources_test.res"
const OPTIONS := {
	"size": 32,
	"filter": Pyramid.Filter.DISC,
	"format": LightFormats.Format.HALF,
	"layer": "",
	"exposure": 0.0,
	"max_sources": 4,
}
const FORMATS := [
	[LightFormats.Format.HALF],
	[LightFormats.Format.SHARED_EXPONENT],
	[LightFormats.Format.BPTC],
]
# First byte of the half floats' texel that is looked at: the coarsest level.
const COARSEST := -8


func after_test() -> void:
	if FileAccess.file_exists(PATH):
		DirAccess.remove_absolute(PATH)


func test_the_light_of_a_file_has_all_of_its_sun(
	format: LightFormats.Format, _test_parameters := FORMATS
) -> void:
	var read := LightImporter.read_file(SUN, OPTIONS)
	assert_str(read.get("error", "")).is_empty()
	var light := _filter(read, {"format": format})
	# Nothing is lost, and nothing is said to be.
	assert_str(" ".join(read["warnings"])).not_contains("65504")
	var sums := _integrate(read)
	var sources := light.sources.get_image()
	assert_that(sources.get_size()).is_equal(LobeLight.SOURCES_SIZE)
	for channel in 3:
		var energy := 0.0
		for column in 4:
			energy += sources.get_pixel(column, 1)[channel]
		# The sky is less than 1 % beside this sun.
		assert_float(energy / sums[channel]).is_between(0.98, 1.0)
		var mean := _mean_of(light, channel) * 4.0 * PI
		if format == LightFormats.Format.HALF:
			assert_float((energy + mean) / sums[channel]).is_between(0.999, 1.001)


func test_files_keep_sources_and_others_have_none() -> void:
	var read := LightImporter.read_file(SUN, OPTIONS)
	var light := _filter(read, {})
	var texels := light.source_texels
	light.seal()
	assert_int(light.version).is_equal(3)
	assert_int(ResourceSaver.save(light, PATH)).is_equal(OK)
	var loaded: LobeLight = ResourceLoader.load(PATH, "", ResourceLoader.CACHE_MODE_IGNORE)
	assert_str(loaded.get_problem()).is_empty()
	assert_that(loaded.source_texels).is_equal(texels)
	assert_int(loaded.count_sources()).is_equal(1)
	assert_array(Array(loaded.get_defines())).contains(["SOURCES"])
	assert_object(loaded.at_another_place().sources).is_same(loaded.sources)
	loaded.source_texels[16] *= 2.0
	loaded.source_texels = loaded.source_texels
	assert_str(loaded.get_problem()).contains("checksum")
	# What has no sources is what it was before there were any.
	var without := _filter(read, {"max_sources": 0})
	without.seal()
	assert_int(without.version).is_equal(2)
	assert_object(without.sources).is_null()
	assert_int(without.count_sources()).is_equal(0)
	assert_array(Array(without.get_defines())).is_empty()


func test_what_is_exported_for_phones_keeps_them() -> void:
	var light := _filter(
		LightImporter.read_file(SUN, OPTIONS), {"format": LightFormats.Format.BPTC}
	)
	light.seal()
	var variant := light.duplicate() as LobeLight
	var problem := LightVariant.encode(variant)
	# Not every build of the engine has the encoder.
	if problem.is_empty():
		assert_str(variant.get_problem()).is_empty()
		assert_that(variant.source_texels).is_equal(light.source_texels)


func test_lights_of_maps_without_suns_have_no_sources() -> void:
	var read := LightImporter.read_file("res://tests/data/forest.exr", OPTIONS)
	assert_int(_filter(read, {}).source_texels.size()).is_equal(0)


func _filter(read: Dictionary, options: Dictionary) -> LobeLight:
	var made: Variant = LightImporter.filter(
		read.duplicate(true), OPTIONS.merged(options, true), Progress.new("test")
	)
	assert_bool(made is LobeLight).append_failure_message(str(made)).is_true()
	return made


# Of radiance over solid angle, by channel.
func _integrate(read: Dictionary) -> Vector3:
	var width: int = read["width"]
	var height: int = read["height"]
	var pixels: PackedFloat32Array = read["pixels"]
	var sums := Vector3.ZERO
	for row in height:
		var strip := Vector3.ZERO
		for at in range(3 * width * row, 3 * width * (row + 1), 3):
			strip += Vector3(pixels[at], pixels[at + 1], pixels[at + 2])
		var polar := cos(PI * row / height) - cos(PI * (row + 1) / height)
		sums += strip * polar * TAU / width
	return sums


# Over the six texels of the coarsest level.
func _mean_of(light: LobeLight, channel: int) -> float:
	var sum := 0.0
	for face in light.faces:
		var data := face.get_data()
		sum += data.decode_half(data.size() + COARSEST + 2 * channel) if data.size() > 8 else 0.0
	return sum / 6.0
