## Writes results in the JUnit form that build servers read.

const Record := preload("res://addons/gdUnit4/src/standin/test_record.gd")


## Writes [param results] (suite path to its records) to [param path]. Returns an error code.
static func write(path: String, results: Dictionary[String, Array]) -> Error:
	var error := DirAccess.make_dir_recursive_absolute(path.get_base_dir())
	if error != OK:
		return error
	var file := FileAccess.open(path, FileAccess.WRITE)
	if file == null:
		return FileAccess.get_open_error()
	var lines: PackedStringArray = ['<?xml version="1.0" encoding="UTF-8"?>', "<testsuites>"]
	for suite in results:
		lines.append('\t<testsuite name="%s" tests="%d">' % [_escape(suite), results[suite].size()])
		for record: Record in results[suite]:
			lines.append_array(_test_case(suite, record))
		lines.append("\t</testsuite>")
	lines.append("</testsuites>\n")
	return OK if file.store_string("\n".join(lines)) else ERR_FILE_CANT_WRITE


static func _test_case(suite: String, record: Record) -> PackedStringArray:
	var opening := (
		'\t\t<testcase name="%s" classname="%s" time="%.3f"'
		% [_escape(record.name), _escape(suite.get_file().get_basename()), record.seconds]
	)
	var children: PackedStringArray = []
	if record.skipped:
		children.append('\t\t\t<skipped message="%s"/>' % _escape(record.skip_reason))
	for failure in record.failures:
		children.append('\t\t\t<failure message="%s"/>' % _escape(failure))
	for error in record.errors:
		children.append('\t\t\t<error message="%s"/>' % _escape(error))
	if children.is_empty():
		return [opening + "/>"]
	var lines: PackedStringArray = [opening + ">"]
	lines.append_array(children)
	lines.append("\t\t</testcase>")
	return lines


static func _escape(text: String) -> String:
	return text.xml_escape(true).replace("\n", "&#10;")
