extends GdUnitTestSuite
## The GDScript code of the documentation compiles, the first steps make what they say, and the
## sentences that the pages quote are those that the addon has.

const FOLDERS: PackedStringArray = ["res://docs/", "res://docs/guide/"]
const README := "res://README.md"
const FIRST_STEPS := "res://docs/first-steps.md"
## What pages speak of before a block begins.
const NAMES := """
var environment: LobeEnvironment3D
var material: Material
var table_set: LobeTableSet
"""
## Files that pages name, and that are the reader's own.
const STAND_INS: Dictionary[String, String] = {
	"res://car_paint.gdshader": "res://demo/examples/car_paint/car_paint.gdshader"
}
## Pages with sentences in quotes, and how those of the engine begin.
const QUOTING: PackedStringArray = [
	"troubleshooting", "exports", "baked-light", "install", "brushed-metal", "measured-brdfs"
]
const OF_ENGINE: PackedStringArray = [
	"Can't open dynamic library",
	"GDExtension dynamic library not found",
	"No GDExtension library found for",
	"GDExtension only compatible with Godot version",
]
# Shorter ones may be anything.
const LEAST_LENGTH := 10

var _fence := RegEx.create_from_string("(?s)```gdscript\\n(.*?)```")


func test_code_of_pages_compiles() -> void:
	var pages: PackedStringArray = [README]
	for folder in FOLDERS:
		for file in DirAccess.get_files_at(folder):
			if file.get_extension() == "md":
				pages.append(folder + file)
	var count := 0
	for page in pages:
		for code in _blocks_of(page):
			if "LobeBaker" in code and not ClassDB.class_exists(&"LobeBaker"):
				continue
			count += 1
			var script := GDScript.new()
			script.source_code = make_script(code)
			var told := "%s does not compile:\n%s" % [page, script.source_code]
			assert_int(script.reload()).override_failure_message(told).is_equal(OK)
	assert_int(count).is_greater(7)


## The test itself: statements are put into a function, functions and scripts are left alone.
func test_statements_become_a_function() -> void:
	assert_str(make_script("x = 1\n")).ends_with("func _run() -> void:\n\tx = 1\n")
	assert_str(make_script("func f():\n\tpass\n")).ends_with("func f():\n\tpass\n")
	assert_str(make_script("extends Node\n")).is_equal("extends Node\n")


func test_first_steps_show_a_brushed_sphere() -> void:
	var script := GDScript.new()
	script.source_code = _blocks_of(FIRST_STEPS)[0]
	assert_int(script.reload()).is_equal(OK)
	var root := Node3D.new()
	root.set_script(script)
	add_child(root)
	var environments := root.find_children("*", "LobeEnvironment3D", true, false)
	assert_array(environments).has_size(1)
	assert_bool((environments[0] as LobeEnvironment3D).is_active()).is_true()
	var spheres := root.find_children("*", "MeshInstance3D", true, false)
	assert_array(spheres).has_size(1)
	var sphere: MeshInstance3D = spheres[0]
	var material := sphere.get_active_material(0) as LobeMaterial3D
	assert_bool(material.needs_tangents()).is_true()
	assert_int(material.get_fetches()["environment"]).is_greater_equal(8)
	root.free()


func test_quoted_sentences_exist() -> void:
	var messages := _read_messages()
	var count := 0
	for page in QUOTING:
		var unknown := find_unknown(
			FileAccess.get_file_as_string("res://docs/%s.md" % page), messages
		)
		assert_array(unknown).override_failure_message("%s: %s" % [page, unknown]).is_empty()
		count += _quotes_of(FileAccess.get_file_as_string("res://docs/%s.md" % page)).size()
	assert_int(count).is_greater(30)


func test_unknown_sentences_are_found() -> void:
	var messages := _read_messages()
	assert_array(find_unknown("says “The mesh is broken here.”", messages)).has_size(1)
	(
		assert_array(find_unknown("says “… shows a neutral map, as there is no …”", messages))
		. is_empty()
	)


## What a text quotes that no message has, without what stands for names.
func find_unknown(text: String, messages: String) -> PackedStringArray:
	var unknown: PackedStringArray = []
	for quote in _quotes_of(text):
		for part in quote.split("…"):
			var words := part.lstrip(" .:,").rstrip(" .:,")
			var is_of_engine := Array(OF_ENGINE).any(words.begins_with)
			if words.length() >= LEAST_LENGTH and not is_of_engine and not words in messages:
				unknown.append(words)
	return unknown


func _quotes_of(text: String) -> PackedStringArray:
	var quotes: PackedStringArray = []
	for found in RegEx.create_from_string("“([^”]*)”").search_all(text.replace("\n", " ")):
		quotes.append(found.get_string(1))
	return quotes


# The addon's and the library's sources, strings that are added up being one.
func _read_messages() -> String:
	var sources: PackedStringArray = []
	_read_below("res://addons/lobelight", sources)
	_read_below("res://gdextension", sources)
	var joined := RegEx.create_from_string('"\\s*\\+?\\s*"').sub("\n".join(sources), "", true)
	return joined.replace('\\"', '"')


func _read_below(folder: String, sources: PackedStringArray) -> void:
	for file in DirAccess.get_files_at(folder):
		if file.get_extension() in ["gd", "cpp"]:
			sources.append(FileAccess.get_file_as_string(folder.path_join(file)))
	for name in DirAccess.get_directories_at(folder):
		_read_below(folder.path_join(name), sources)


## A script of a block of a page.
func make_script(block: String) -> String:
	var code := block
	for file: String in STAND_INS:
		code = code.replace(file, STAND_INS[file])
	if code.begins_with("extends "):
		return code
	var begin := "extends Node3D\n" + NAMES + "\n\n"
	if code.begins_with("func "):
		return begin + code
	return begin + "func _run() -> void:\n" + code.indent("\t")


func _blocks_of(page: String) -> PackedStringArray:
	var blocks: PackedStringArray = []
	for found in _fence.search_all(FileAccess.get_file_as_string(page)):
		blocks.append(found.get_string(1).replace("    ", "\t"))
	return blocks
