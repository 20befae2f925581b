extends GdUnitTestSuite
## Sets of tables: what the library fits, and that the shipped ones are what it would fit.

const SMALL := {"brdf": "ward", "widths": [0.1, 0.15, 0.2], "lobes": 2, "views": [4, 3]}
const SHIPPED := [
	["ward", "res://addons/lobelight/tables/ward_8.res"],
	["ggx", "res://addons/lobelight/tables/ggx_8.res"],
	["charlie", "res://addons/lobelight/tables/charlie_4.res"],
	["ggx", "res://addons/lobelight/tables/coat_4.res"],
]

## A recipe's value that is refused, and what the sentence about it says.
const REFUSED := [
	["widths", [0.1], "widths has 1 numbers"],
	["widths", [0.2, 0.1], "must rise"],
	["widths", "all", 'widths is "all" (String)'],
	["widths", [0.1, "0.2"], "an Array of numbers"],
	["brdf", "x.binary", "models only"],
	["views", [16, 0], "1 azimuth."],
	["lobes", 33, "lobes is 33"],
	["alpha", 0.1, '"alpha" is not a key of a recipe for a set of tables'],
]


func test_set_has_the_documented_shape() -> void:
	var result := LobeBaker.new().bake(SMALL)
	assert_array(result.keys()).contains_exactly_in_any_order(
		["brdf", "widths", "lobes", "views", "seed", "width", "height", "data", "seconds"]
	)
	assert_array(result.widths).is_equal([0.1, 0.15, 0.2])
	var tables := LobeTableSet.from_baked(result)
	assert_str(tables.get_problem()).is_empty()
	assert_int(tables.get_table_count()).is_equal(9)


func test_what_is_baked_is_saved_with_its_checksum() -> void:
	var path := "user://table_sets_test.res"
	var result := LobeBaker.new().bake(SMALL)
	ResourceSaver.save(LobeTableSet.from_baked(result), path)
	var loaded: LobeTableSet = ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)
	assert_str(loaded.get_problem()).is_empty()
	# The same texels, baked again.
	var again := LobeTableSet.from_baked(LobeBaker.new().bake(SMALL))
	assert_int(loaded.checksum).is_equal(again.checksum).is_not_equal(0)
	DirAccess.remove_absolute(path)


func test_weights_of_interpolated_tables_add_up_to_the_albedo() -> void:
	var tables := LobeTableSet.from_baked(LobeBaker.new().bake(SMALL))
	for alpha: Vector2 in [Vector2(0.12, 0.12), Vector2(0.17, 0.12), Vector2(0.12, 0.17)]:
		var table := tables.table_at(alpha)
		var view := table.get_view(2, 0)
		var albedo := LobeBaker.directional_albedo("ward", alpha, view)
		# The albedo is nearly linear in the logarithms of widths so close to one another.
		assert_float(table.directional_albedo(view)).is_equal_approx(albedo, 0.01 * albedo)


func test_each_table_can_be_fitted_again() -> void:
	var tables := LobeTableSet.from_baked(LobeBaker.new().bake(SMALL))
	for table in tables.get_table_count():
		var again := LobeBaker.new().refit(SMALL, tables.image.get_data(), table)
		assert_array(again.keys()).contains_exactly(["data"])
		assert_bool(again.data == tables.get_table_data(table)).is_true()


func test_refit_refuses_what_is_no_set() -> void:
	var data: PackedByteArray = LobeBaker.new().bake(SMALL).data
	assert_str(LobeBaker.new().refit(SMALL, data, 9).error).contains("no table of this number")
	assert_str(LobeBaker.new().refit(SMALL, data, -1).error).contains("no table of this number")
	assert_str(LobeBaker.new().refit(SMALL, data.slice(8), 0).error).contains("size of the set")


func test_bad_recipe_is_refused_by_name(
	key: String, value: Variant, named: String, _test_parameters := REFUSED
) -> void:
	var recipe := SMALL.duplicate()
	recipe[key] = value
	var result := LobeBaker.new().bake(recipe)
	assert_array(result.keys()).contains_exactly(["error"])
	assert_str(result.get("error", "")).contains(named)


func test_shipped_sets_are_what_the_library_fits(
	brdf: String, path: String, _test_parameters := SHIPPED
) -> void:
	var tables: LobeTableSet = load(path)
	assert_str(tables.get_problem()).is_empty()
	assert_str(tables.brdf).is_equal(brdf)
	var recipe := {
		"brdf": brdf,
		"widths": Array(tables.widths),
		"lobes": tables.lobe_count,
		"views": tables.views,
		"seed": tables.seed,
	}
	var data := tables.image.get_data()
	# Three anisotropic tables: narrow, of a high ratio, on the diagonal; and an isotropic one. None is
	# among those that ./dev bake-tables --check fits again.
	var numbers := range(tables.get_table_count()) if tables.is_isotropic() else [1, 110, 209, 245]
	for table: int in numbers:
		var again := LobeBaker.new().refit(recipe, data, table)
		assert_bool(again.get("data") == tables.get_table_data(table)).is_true()
