## The arguments of the command-line tool that come after its own name.

var paths: PackedStringArray = []
var ignored: PackedStringArray = []
var report_directory := "res://reports"
var continues := false
var accepts_headless := false
## What is wrong with the arguments; empty if nothing is.
var defect := ""


## Reads the arguments that follow [param tool] in [param arguments].
func _init(arguments: PackedStringArray, tool: String) -> void:
	var i := 0
	while i < arguments.size() and not arguments[i].ends_with(tool):
		i += 1
	i += 1
	while i < arguments.size():
		var takes_value := _read_option(
			arguments[i], arguments[i + 1] if i + 1 < arguments.size() else ""
		)
		i += 2 if takes_value else 1
	if paths.is_empty() and not defect:
		defect = "no suite is named: use -a PATH"


func _read_option(option: String, value: String) -> bool:
	match option:
		"-a", "--add":
			paths.append(_qualified(value))
		"-i", "--ignore":
			ignored.append(value)
		"-rd", "--report-directory":
			report_directory = _qualified(value)
		"-rc", "--report-count":
			pass
		"-c", "--continue":
			continues = true
			return false
		"--ignoreHeadlessMode":
			accepts_headless = true
			return false
		_:
			defect = "unknown argument '%s'" % option
			return false
	if not value or value.begins_with("-"):
		defect = "%s needs a value" % option
	return true


static func _qualified(path: String) -> String:
	return path if path.contains("://") or path.is_absolute_path() else "res://" + path
