extends GdUnitTestSuite
## What of the ready sets scenes reach, and that what is left of a set draws as the whole set does.

const Diet := preload("res://addons/lobelight/editor/export/diet.gd")
const ProjectFiles := preload("res://addons/lobelight/editor/export/project_files.gd")
const Reach := preload("res://addons/lobelight/editor/export/reach.gd")
const SetCut := preload("res://addons/lobelight/editor/export/set_cut.gd")
const SetReach := preload("res://addons/lobelight/editor/export/set_reach.gd")
const Widths := preload("res://addons/lobelight/runtime/table/widths.gd")
const SCENES := "res://tests/diet/scenes/"
const GGX := "res://addons/lobelight/tables/ggx_8.res"
const CHARLIE := "res://addons/lobelight/tables/charlie_4.res"
const WARD := "res://addons/lobelight/tables/ward_8.res"

## A scene, what is left of the sets of GGX and of Ward at most, as shares.
const LEFT := [
	["empty", 0.0, 0.0],
	["isotropic", 0.005, 0.0],
	["anisotropic", 0.0, 0.0],
	["by_script", 0.06, 0.0],
	["declared", 0.25, 0.0],
	["worn", 0.05, 0.0],
]

## Lines of scripts after which not everything is known, and some that change nothing.
const LINES := [
	["material.roughness = 0.3", true],
	["material.anisotropy = -0.5  # brushed", true],
	["var material := LobeMaterial3D.new()", true],
	["position = Vector3(0.1, 0.2, 0.3)", true],
	['node.set("visible", false)', true],
	["material.roughness += 0.1", false],
	["material.roughness = wanted", false],
	['material.set("roughness", 0.1)', false],
	["material.set(property, 0.1)", false],
	['create_tween().tween_property(material, "anisotropy", 1.0, 2.0)', false],
	["create_tween().tween_property(material, property, 1.0, 2.0)", false],
	["mesh.material = LobeMaterial3D.from_standard(mesh.material)", false],
	["extends LobeMaterial3D", false],
	["set(value):", true],
	["material.orm_texture = texture", false],
	["material.table = null", false],
	["func use(material: LobeMaterial3D) -> void:", true],
]

## Pairs of roughness and anisotropy.
const SURFACES := [
	[0.35, 0.0],
	[0.35, 0.9],
	[0.35, -0.8],
	[0.05, 0.0],
	[1.0, 0.0],
	[0.2, 1.1],
	[0.02, 0.5],
	[0.7, 0.33],
	[0.5, 0.999],
]


func _diet(scene: String) -> Diet:
	return Diet.of_files(ProjectFiles.of_scene(SCENES + scene + ".tscn"), 0.0, true, false)


func test_left_of_the_sets(
	scene: String, ggx: float, ward: float, _test_parameters := LEFT
) -> void:
	var diet := _diet(scene)
	for wanted: Array in [[GGX, ggx], [WARD, ward]]:
		var share: Diet.Share = diet.shares[wanted[0]]
		assert_int(share.before).is_greater(1000000)
		assert_float(float(share.after) / share.before).is_less_equal(wanted[1])
		assert_bool(share.is_left_out()).is_equal(wanted[1] == 0.0)


func test_the_set_of_sheens_goes_along_where_one_is_drawn() -> void:
	assert_bool((_diet("everything").shares[CHARLIE] as Diet.Share).is_left_out()).is_true()
	var files: PackedStringArray = []
	for roughness: float in [0.5, 0.9]:
		var material := LobeMaterial3D.new()
		material.sheen_enabled = true
		material.sheen_roughness = roughness
		files.append("user://diet_sheen_%d.tres" % files.size())
		ResourceSaver.save(material, files[-1])
	var share: Diet.Share = Diet.of_files(files.slice(0, 1), 0.0, true, false).shares[CHARLIE]
	assert_bool(share.is_left_out()).is_false()
	assert_int(share.after).is_less(share.before)
	files.append("user://diet_sheen.res")
	var cut := FileAccess.open(files[-1], FileAccess.WRITE)
	cut.store_buffer(share.bytes)
	cut.close()
	var left: LobeTableSet = load(files[-1])
	var whole: LobeTableSet = load(CHARLIE)
	var width := Vector2(0.25, 0.25)
	var is_same := left.table_at(width).image.get_data() == whole.table_at(width).image.get_data()
	assert_bool(is_same).is_true()
	files.append("user://diet_sheen.gd")
	var file := FileAccess.open(files[-1], FileAccess.WRITE)
	file.store_string("extends Node\n\n\nfunc f(m):\n\tm.sheen_roughness = 0.2\n")
	file.close()
	share = Diet.of_files(files, 0.0, true, false).shares[CHARLIE]
	assert_int(share.after).is_equal(share.before)
	for path in files:
		DirAccess.remove_absolute(path)


# Widths per pixel of a material without anisotropy come from the isotropic tables.
func test_a_texture_of_roughness_keeps_all_isotropic_tables_and_no_other() -> void:
	var share: Diet.Share = _diet("worn").shares[GGX]
	assert_str(share.why).contains("21 of 252 tables")
	assert_str(share.why).contains("texture")


func test_at_least_four_fifths_of_our_bytes_are_gone_for_an_isotropic_scene() -> void:
	var report := _diet("isotropic").to_dictionary()
	assert_int(report["materials"]).is_equal(1)
	assert_float(float(report["after"]) / float(report["before"])).is_less_equal(0.2)
	assert_int(report["run_time"]).is_greater(50000)
	# Each thing has its reason.
	for entry: Dictionary in report["tables"] + report["files"]:
		assert_str(entry["why"]).is_not_empty()


func test_textures_keep_all_widths_and_coats_keep_the_set_that_draws_them() -> void:
	var diet := _diet("everything")
	assert_int(diet.shares[WARD].after).is_equal(diet.shares[WARD].before)
	assert_str(diet.shares[WARD].why).contains("texture")
	assert_bool(diet.shares[GGX].is_left_out()).is_true()


func test_what_a_script_does_is_kept_where_it_is_not_known() -> void:
	var share: Diet.Share = _diet("by_unknown").shares[GGX]
	assert_int(share.after).is_equal(share.before)
	assert_str(share.why).contains("by_unknown.gd")


func test_numbers_of_scripts_widen_the_range() -> void:
	var reach := Reach.of_files(ProjectFiles.of_scene(SCENES + "by_script.tscn"))
	var found: Vector2 = reach.sets[GGX].get_range()
	assert_float(found.y).is_equal_approx(Widths.from_roughness(0.35, 0.8).x, 1e-6)
	assert_float(found.x).is_equal_approx(Widths.from_roughness(0.25, 0.8).y, 1e-6)


func test_a_cut_set_gives_the_same_tables(
	roughness: float, anisotropy: float, _test_parameters := SURFACES
) -> void:
	var whole: LobeTableSet = load(GGX)
	var widths := Widths.from_roughness(roughness, anisotropy)
	var reach := SetReach.new()
	reach.add_surface(widths)
	var part: LobeTableSet = SetCut.of(whole, reach).part
	assert_str(part.get_problem()).is_empty()
	assert_int(part.widths.size()).is_less(whole.widths.size())
	# As materials ask: widths are rounded, by steps that do not know of the set; and by one step more,
	# should another processor's logarithm round the other way.
	for factor: float in [1.0, 1.0027, 1.0 / 1.0027]:
		var expected := whole.shared_table_at(widths * factor).image.get_data()
		var found := part.shared_table_at(widths * factor).image.get_data()
		assert_int(found.size()).is_greater(0)
		assert_float(_largest_difference(expected, found)).is_less_equal(2e-3)


func test_between_declared_ends_every_table_is_there() -> void:
	var whole: LobeTableSet = load(GGX)
	var reach := SetReach.new()
	reach.add_surface(Widths.from_roughness(0.3, 0.0))
	reach.add_surface(Widths.from_roughness(0.5, 0.8))
	reach.is_filled = true
	var part: LobeTableSet = SetCut.of(whole, reach).part
	for surface: Array in [[0.4, 0.3], [0.45, 0.0], [0.35, 0.6], [0.49, 0.79]]:
		var widths := Widths.from_roughness(surface[0], surface[1])
		var expected := whole.shared_table_at(widths).image.get_data()
		var found := part.shared_table_at(widths).image.get_data()
		assert_float(_largest_difference(expected, found)).is_less_equal(2e-3)


func test_what_nothing_asks_for_is_black() -> void:
	var reach := SetReach.new()
	reach.add_surface(Vector2(0.1, 0.1))
	var part: LobeTableSet = SetCut.of(load(GGX), reach).part
	assert_bool(_is_black(part.table_at(Vector2(0.1, 0.1)))).is_false()
	assert_bool(_is_black(part.table_at(Vector2(0.2, 0.1)))).is_true()


func _is_black(table: LobeTable) -> bool:
	var bytes := table.image.get_data()
	return bytes.count(0) == bytes.size()


# Relative to the values, in half precision.
func _largest_difference(expected: PackedByteArray, found: PackedByteArray) -> float:
	if expected.size() != found.size():
		return INF
	var largest := 0.0
	for i in range(0, expected.size(), 2):
		var value := expected.decode_half(i)
		var scale := maxf(absf(value), 0.1)
		largest = maxf(largest, absf(found.decode_half(i) - value) / scale)
	return largest


func test_the_whole_range_is_the_set_itself() -> void:
	var whole: LobeTableSet = load(GGX)
	var reach := SetReach.new()
	reach.add_surface(Vector2(whole.widths[-1], whole.widths[0]))
	reach.is_filled = true
	assert_object(SetCut.of(whole, reach).part).is_same(whole)


func test_a_cut_set_is_saved_as_equal_bytes() -> void:
	var first := _diet("isotropic").shares[GGX].bytes
	assert_int(first.size()).is_greater(1000)
	assert_array(Array(first)).is_equal(Array(_diet("isotropic").shares[GGX].bytes))


func test_lines_of_scripts(line: String, is_known: bool, _test_parameters := LINES) -> void:
	var file := "user://diet_line.gd"
	_write(file, "extends Node\n\n\nfunc _ready() -> void:\n\t%s\n" % line)
	var reach := Reach.of_files(PackedStringArray([SCENES + "isotropic.tscn", file]))
	DirAccess.remove_absolute(file)
	assert_bool(reach.sets[GGX].whole_because.is_empty()).is_equal(is_known)


func test_animated_widths_are_not_known_and_sets_that_scripts_are_given_stay() -> void:
	var reach := Reach.of_files(PackedStringArray([SCENES + "animated.tscn"]))
	assert_str(reach.sets[GGX].whole_because).contains("animates")
	assert_str(reach.sets[WARD].whole_because).contains("names it")


func _write(path: String, text: String) -> void:
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string(text)
	file.close()
