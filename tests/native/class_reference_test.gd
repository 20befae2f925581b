extends GdUnitTestSuite
## The class reference in doc_classes describes the native classes as they are.

const FOLDER := "res://addons/lobelight/doc_classes"
const NATIVE := [
	"LobeBaker", "LobeImageFile", "LobeLightEncoder", "LobeLightFilter", "LobeReference", "LobeTask"
]


## What an XML file of the class reference says.
class Reference:
	var name := ""
	var base := ""
	var members: Array[String] = []  # methods and signals
	var undescribed: Array[String] = []

	func _init(path: String) -> void:
		var parser := XMLParser.new()
		parser.open(path)
		var described := ""
		while parser.read() == OK:
			if parser.get_node_type() != XMLParser.NODE_ELEMENT:
				continue
			match parser.get_node_name():
				"class":
					name = parser.get_named_attribute_value("name")
					base = parser.get_named_attribute_value("inherits")
					described = name
				"method", "signal":
					described = parser.get_named_attribute_value("name")
					members.append(described)
				"description", "brief_description":
					if parser.is_empty() or parser.read() != OK or not _has_text(parser):
						undescribed.append(described)

	func _has_text(parser: XMLParser) -> bool:
		if parser.get_node_type() != XMLParser.NODE_TEXT:
			return false
		return not parser.get_node_data().strip_edges().is_empty()


func test_every_native_class_has_a_file() -> void:
	var files := Array(DirAccess.get_files_at(FOLDER)).filter(
		func(file: String) -> bool: return file.get_extension() == "xml"
	)
	var expected := NATIVE.map(func(native: String) -> String: return native + ".xml")
	assert_array(files).contains_exactly_in_any_order(expected)


func test_reference_agrees_with_the_classes() -> void:
	for native: String in NATIVE:
		var reference := Reference.new(FOLDER.path_join(native + ".xml"))
		assert_str(reference.name).is_equal(native)
		assert_str(reference.base).is_equal(ClassDB.get_parent_class(native))
		assert_array(reference.undescribed).is_empty()
		var members: Array[String] = []
		for method: Dictionary in ClassDB.class_get_method_list(native, true):
			if not method.name.begins_with("_"):
				members.append(method.name)
		for signal_info: Dictionary in ClassDB.class_get_signal_list(native, true):
			members.append(signal_info.name)
		assert_array(reference.members).contains_exactly_in_any_order(members)
