extends GdUnitTestSuite
## What `./dev report` asks of a [Comparison]: other settings than the usual, and methods that
## cannot be drawn left out with their reason.

const ComparatorKit := preload("support/comparator_kit.gd")

const METHODS: PackedStringArray = ["gmm4", "fis8", "no-such-method", "reference"]

var _folder := ""
var _map := ""


func before() -> void:
	_folder = create_temp_dir("comparison")
	_map = ProjectSettings.globalize_path(_folder.path_join("lamps.exr"))
	assert_str(ComparatorKit.save_lamps(_map)).is_empty()


func after() -> void:
	clean_temp_dir()


func test_methods_that_cannot_be_drawn_are_an_error() -> void:
	assert_str(await _make().run()).contains("no-such-method")


func test_they_are_left_out_where_that_is_wanted() -> void:
	var comparison := _make()
	comparison.tolerant = true
	assert_str(await comparison.run()).is_empty()
	var plan := _plan(comparison)
	assert_array(_names(plan)).is_equal(["gmm4", "fis8", "reference"])
	assert_str(plan["unavailable"]["no-such-method"]).contains("unknown")
	# What a report says of where it was measured.
	for key: String in ["driver", "driver_version", "engine", "renderer"]:
		assert_str(str(plan[key])).is_not_empty()


func test_settings_reach_the_methods() -> void:
	var comparison := _make()
	comparison.tolerant = true
	comparison.stage.filter = "box"
	comparison.stage.pyramid_size = 32
	comparison.stage.table_views = Vector2i(5, 1)
	comparison.stage.fis_bias = 1.0
	assert_str(await comparison.run()).is_empty()
	var methods: Array = _plan(comparison)["methods"]
	var lobes: Dictionary = methods[0]["settings"]
	# Four lobes of half floats in each of five views.
	assert_array([lobes["pyramid"], lobes["face_size"]]).is_equal(["box", 32.0])
	assert_array([lobes["views"], lobes["table_bytes"]]).is_equal([[5.0, 1.0], 160.0])
	var samples: Dictionary = methods[1]["settings"]
	assert_array([samples["face_size"], samples["level_bias"]]).is_equal([32.0, 1.0])


func test_times_are_taken_at_their_own_size() -> void:
	# And those of a sphere that reflects nothing beside them.
	var comparison := _make()
	comparison.names = ["fis8", "splitsum", "reference"]
	comparison.timing_rounds = 2
	comparison.timing_size = 24
	assert_str(await comparison.run()).is_empty()
	var plan := _plan(comparison)
	assert_float(plan["timing_size"]).is_equal(24.0)
	assert_array(_names(plan)).is_equal(["fis8", "splitsum", "reference"])
	# The engine has no GPU times of updates in Compatibility.
	var cost := "prefilter_wall_ms" if LinearViewport.is_compatibility() else "prefilter_ms"
	for index in 2:
		var method: Dictionary = plan["methods"][index]
		assert_int((method["gpu_ms_rounds"] as Array).size()).is_equal(2)
		assert_float(method["settings"][cost]).is_greater(0.0)
	assert_int((plan["fixed_ms_rounds"] as Array).size()).is_equal(2)
	assert_array(plan["methods"][2]["gpu_ms_rounds"]).is_empty()


func test_tables_are_fitted_once() -> void:
	var comparison := _make()
	comparison.tolerant = true
	assert_str(await comparison.run()).is_empty()
	assert_int(comparison.stage.tables.size()).is_equal(1)
	var table: LobeTable = comparison.stage.tables.values()[0]
	assert_str(await comparison.run()).is_empty()
	assert_object(comparison.stage.tables.values()[0]).is_same(table)


func _make() -> Comparison:
	var comparison := Comparison.new()
	comparison.environment_path = _map
	comparison.brdf = "ward"
	comparison.alpha = [0.2, 0.2]
	comparison.names = METHODS
	comparison.size = 16
	comparison.samples = 16
	comparison.timing_rounds = 0
	comparison.out = ProjectSettings.globalize_path(_folder.path_join("pictures"))
	comparison.stage = ComparisonStage.new(get_tree())
	comparison.stage.panorama = Comparison.load_panorama(_map)["texture"]
	return comparison


func _plan(comparison: Comparison) -> Dictionary:
	return JSON.parse_string(FileAccess.get_file_as_string(comparison.out.path_join("plan.json")))


func _names(plan: Dictionary) -> Array:
	return (plan["methods"] as Array).map(func(entry: Dictionary) -> String: return entry["method"])
