## What happened in one test: its assertions, failures and errors.
##
## Assertions keep the record of the test that made them, so that a coroutine which goes on after
## its test timed out cannot write into the next one.

var name: String
var assertions := 0
var failures: PackedStringArray = []
var errors: PackedStringArray = []
var skipped := false
var skip_reason := ""
var seconds := 0.0
var orphans := 0


func _init(test_name: String) -> void:
	name = test_name


func count_assertion() -> void:
	assertions += 1


## Notes a failed assertion with the line of the suite that made it, or else [param known_line].
func fail(message: String, known_line: int = 0) -> void:
	var line := line_in_suite()
	line = line if line else known_line
	failures.append("line %d: %s" % [line, message] if line else message)


## Notes something that went wrong outside the assertions.
func error(message: String) -> void:
	errors.append(message)


func has_failed() -> bool:
	return not (failures.is_empty() and errors.is_empty())


## All that went wrong, one entry a line or more.
func describe() -> String:
	return "\n".join(failures + errors)


## The line of the test suite that is running now; 0 if there is none on the stack.
static func line_in_suite() -> int:
	for frame: Dictionary in get_stack():
		var source: String = frame.source
		if not source.begins_with("res://addons/gdUnit4/"):
			return frame.line
	return 0
