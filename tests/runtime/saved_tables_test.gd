extends GdUnitTestSuite
## The files of tables: those of every format load, newer ones are refused, damaged ones are found,
## and what is saved has the right checksum.

const SavedForm := preload("res://addons/lobelight/runtime/table/saved_form.gd")
const SetCut := preload("res://addons/lobelight/editor/export/set_cut.gd")
const SetReach := preload("res://addons/lobelight/editor/export/set_reach.gd")
const TableChoice := preload("res://addons/lobelight/runtime/material/table_choice.gd")
const TableState := preload("res://addons/lobelight/editor/bake/table_state.gd")
const TEXT := "user://saved_tables_test.tres"
const BINARY := "user://saved_tables_test.res"
const READY: PackedStringArray = ["charlie_4", "coat_4", "ggx_8", "ward_8"]
const KINDS := [["table"], ["set"]]
const DAMAGED := "The %s is not as it was saved, its checksum differs: bake the %s again."
const NEWER := (
	"The %s is in format 3, and this version of Lobelight reads up to 2: "
	+ "update the addon, or bake the %s again."
)
# What _make_table() has, from Python:
#   numbers = [brdf, widths, lobe_count, views, method, seed] as var_to_bytes() lays them out
#   int.from_bytes(md5(numbers + texels).digest()[:8], "little", signed=True)
const CHECKSUM := -3640223077396310803


func after_test() -> void:
	SavedForm.checks_all = Engine.is_editor_hint()
	for file: String in [TEXT, BINARY]:
		if FileAccess.file_exists(file):
			DirAccess.remove_absolute(file)


func test_the_checksum_is_what_it_was() -> void:
	# Files that exist have it: a new way to find it is a new format.
	assert_int(_make_table().checksum).is_equal(CHECKSUM)


func test_what_is_saved_says_its_format(kind: String, _test_parameters := KINDS) -> void:
	var tables := _make(kind)
	var text := _save(tables)
	assert_str(text).contains("\nformat = 2\n")
	assert_str(text).contains("\nchecksum = %d\n" % tables.get(&"checksum"))
	assert_int(tables.get(&"checksum")).is_not_equal(0)
	_assert_loads(TEXT)
	assert_int(ResourceSaver.save(tables, BINARY, ResourceSaver.FLAG_COMPRESS)).is_equal(OK)
	_assert_loads(BINARY)


func test_files_of_the_first_format_load(kind: String, _test_parameters := KINDS) -> void:
	var tables := _make(kind)
	var text := _save(tables)
	_write(_without(_without(text, "format"), "checksum"))
	var loaded := _assert_loads(TEXT)
	# Saved again they have the newest one.
	assert_str(_save(loaded)).is_equal(text)


func test_newer_files_are_refused(kind: String, _test_parameters := KINDS) -> void:
	_write(_save(_make(kind)).replace("\nformat = 2\n", "\nformat = 3\n"))
	var loaded := _load(TEXT)
	assert_str(loaded.call(&"get_problem")).is_equal(NEWER % [kind, kind])
	# And are not made older by saving.
	assert_str(_save(loaded)).contains("\nformat = 3\n")


func test_damage_is_found(kind: String, _test_parameters := KINDS) -> void:
	var text := _save(_make(kind))
	var numbers: Dictionary[String, String] = {
		'brdf = "test"': 'brdf = "tess"',
		"seed = 7": "seed = 6",
		'Array("': 'Array("B',
	}
	if kind == "table":
		numbers["alpha = Vector2(0.25"] = "alpha = Vector2(0.5"
	else:
		numbers["0.25"] = "0.125"
	for whole: String in numbers:
		assert_str(text).contains(whole)
		var damaged := text.replace(whole, numbers[whole])
		if whole.begins_with("Array"):
			# One letter of the texels.
			var at := text.find(whole, text.find('"data"')) + whole.length()
			damaged = text.substr(0, at) + "B" + text.substr(at + 1)
		assert_str(damaged).is_not_equal(text)
		_write(damaged)
		var loaded := _load(TEXT)
		assert_str(loaded.call(&"get_problem")).is_equal(DAMAGED % [kind, kind])
		# Saving does not hide it.
		_save(loaded)
		assert_str(_load(TEXT).call(&"get_problem")).is_equal(DAMAGED % [kind, kind])


func test_the_order_in_a_file_does_not_matter(kind: String, _test_parameters := KINDS) -> void:
	var text := _save(_make(kind))
	var line := "checksum = %d\n" % _make(kind).get(&"checksum")
	text = _without(text, "checksum").replace("\nbrdf = ", "\n%sbrdf = " % line)
	_write(text)
	_assert_loads(TEXT)
	_write(text.replace("seed = 7", "seed = 6"))
	assert_str(_load(TEXT).call(&"get_problem")).is_equal(DAMAGED % [kind, kind])


func test_what_is_changed_after_loading_is_no_damage(
	kind: String, _test_parameters := KINDS
) -> void:
	_save(_make(kind))
	var loaded := _load(TEXT)
	loaded.set(&"seed", 8)
	loaded.set(&"image", _make_image(loaded.get(&"image").get_size(), 0.25))
	assert_str(loaded.call(&"get_problem")).is_empty()
	assert_str(_save(loaded)).contains("\nchecksum = %d\n" % loaded.get(&"checksum"))
	_assert_loads(TEXT)
	assert_str(loaded.duplicate().call(&"get_problem")).is_empty()


func test_another_file_in_its_place_is_not_blamed(kind: String, _test_parameters := KINDS) -> void:
	var text := _save(_make(kind))
	_write(text.replace("seed = 7", "seed = 6"))
	var damaged := ResourceLoader.load(TEXT, "", ResourceLoader.CACHE_MODE_REPLACE)
	assert_str(damaged.call(&"get_problem")).is_equal(DAMAGED % [kind, kind])
	_write(_without(_without(text, "format"), "checksum"))
	var again := ResourceLoader.load(TEXT, "", ResourceLoader.CACHE_MODE_REPLACE)
	assert_object(again).is_same(damaged)
	assert_str(again.call(&"get_problem")).is_empty()


# As by Scene > Reload Saved Scene.
func test_what_a_file_leaves_out_is_as_by_default(kind: String, _test_parameters := KINDS) -> void:
	var tables := _make(kind)
	tables.set(&"seed", 0)
	var text := _save(tables)
	assert_str(text).not_contains("seed")
	var loaded := ResourceLoader.load(TEXT, "", ResourceLoader.CACHE_MODE_REPLACE)
	loaded.set(&"seed", 6)
	var again := ResourceLoader.load(TEXT, "", ResourceLoader.CACHE_MODE_REPLACE)
	assert_object(again).is_same(loaded)
	assert_str(again.call(&"get_problem")).is_empty()
	assert_int(again.get(&"seed")).is_equal(0)
	assert_str(_save(again)).is_equal(text)


func test_baking_again_mends_a_damaged_table() -> void:
	_write(_save(_make_table()).replace("seed = 7", "seed = 6"))
	var table: LobeTable = _load(TEXT)
	var state := TableState.of_table(_make_table())
	for property in TableState.PROPERTIES:
		table.set(property, state[property])
	assert_str(table.get_problem()).is_empty()


func test_large_images_are_checked_where_time_allows() -> void:
	var tables := _make_set(32)
	_write(_save(tables).replace("seed = 7", "seed = 6"))
	_assert_loads(TEXT)
	SavedForm.checks_all = true
	assert_str(_load(TEXT).call(&"get_problem")).is_equal(DAMAGED % ["set", "set"])


func test_ready_sets_have_the_right_checksum() -> void:
	SavedForm.checks_all = true
	for name in READY:
		var path := "res://addons/lobelight/tables/%s.res" % name
		var tables: LobeTableSet = _load(path)
		assert_str(tables.get_problem()).is_empty()
		# What ./dev bake-tables would make of the same texels.
		var again := SetCut.make_set(
			tables.brdf,
			tables.seed,
			tables.lobe_count,
			tables.views,
			Array(tables.widths),
			tables.image.get_data()
		)
		ResourceSaver.save(again, BINARY, ResourceSaver.FLAG_COMPRESS)
		var bytes := FileAccess.get_file_as_bytes(path)
		assert_bool(bytes == FileAccess.get_file_as_bytes(BINARY)).is_true()


func test_a_part_of_a_set_has_a_checksum_of_its_own() -> void:
	var tables: LobeTableSet = load(TableChoice.SHEEN_SET)
	var reach := SetReach.new()
	reach.add_surface(Vector2(0.3, 0.3))
	var part: LobeTableSet = SetCut.of(tables, reach).part
	assert_int(part.image.get_height()).is_less(tables.image.get_height())
	assert_int(part.checksum).is_not_equal(tables.checksum)
	_save(part)
	SavedForm.checks_all = true
	_assert_loads(TEXT)


func test_materials_tell_once() -> void:
	_write(_save(_make_table()).replace("\nformat = 2\n", "\nformat = 3\n"))
	var table: LobeTable = ResourceLoader.load(TEXT, "", ResourceLoader.CACHE_MODE_REPLACE)
	var material := LobeMaterial3D.new()
	var give := func() -> void:
		material.table = table
		await get_tree().process_frame
	var sentence := "LobeMaterial3D: %s: %s" % [TEXT, NEWER % ["table", "table"]]
	await assert_error(give).is_push_error(sentence)
	await assert_error(func() -> void: material.roughness = 0.3).is_success()


func _make(kind: String) -> Resource:
	return _make_table() if kind == "table" else _make_set(2)


func _make_table() -> LobeTable:
	var table := LobeTable.new()
	table.brdf = "test"
	table.alpha = Vector2(0.25, 0.5)
	table.lobe_count = 2
	table.views = Vector2i(4, 3)
	table.method = "continuation"
	table.seed = 7
	table.image = _make_image(Vector2i(4, 6), 0.5)
	table.resource_scene_unique_id = "table"
	return table


func _make_set(views: int) -> LobeTableSet:
	var tables := LobeTableSet.new()
	tables.brdf = "test"
	tables.widths = [0.25, 0.5]
	tables.lobe_count = views
	tables.views = Vector2i(views, views)
	tables.seed = 7
	tables.image = _make_image(Vector2i(views, views * (3 * views + 2)), 0.5)
	tables.resource_scene_unique_id = "set"
	return tables


func _make_image(size: Vector2i, weight: float) -> Image:
	var image := Image.create_empty(size.x, size.y, false, Image.FORMAT_RGBAH)
	image.fill(Color(0.0, 0.25, 4.0, weight))
	image.resource_scene_unique_id = "lobes"
	return image


# As text, which is returned.
func _save(tables: Resource) -> String:
	assert_int(ResourceSaver.save(tables, TEXT)).is_equal(OK)
	return FileAccess.get_file_as_string(TEXT)


func _write(text: String) -> void:
	var file := FileAccess.open(TEXT, FileAccess.WRITE)
	file.store_string(text)
	file.close()


# A file's text without a property.
func _without(text: String, property: String) -> String:
	var lines := Array(text.split("\n"))
	var kept := lines.filter(
		func(line: String) -> bool: return not line.begins_with(property + " = ")
	)
	assert_int(kept.size()).is_equal(lines.size() - 1)
	return "\n".join(PackedStringArray(kept))


func _load(path: String) -> Resource:
	return ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE)


func _assert_loads(path: String) -> Resource:
	var loaded := _load(path)
	assert_str(loaded.call(&"get_problem")).is_empty()
	return loaded
