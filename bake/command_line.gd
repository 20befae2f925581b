class_name CommandLine
extends RefCounted
## Reads the options that a headless command was called with, after `--` on the engine's line.
##
## Every option is `--name value`. What is wrong is said in one sentence by [member error].

## Empty while everything was understood.
var error := ""

var _command: String
var _values: Dictionary[String, String] = {}


## [param names] are the options this command takes, without the dashes.
func _init(command: String, names: PackedStringArray) -> void:
	_command = command
	var words := OS.get_cmdline_user_args()
	var index := 0
	while index < words.size() and error.is_empty():
		var word := words[index]
		var option := word.trim_prefix("--")
		if not word.begins_with("--") or option not in names:
			error = (
				"%s is not an option; the options are %s."
				% [word, ", ".join(Array(names).map(func(n: String) -> String: return "--" + n))]
			)
		elif index + 1 >= words.size():
			error = "%s needs a value." % word
		elif option in _values:
			error = "%s is given twice." % word
		else:
			_values[option] = words[index + 1]
		index += 2


## True where the option was given.
func has(option: String) -> bool:
	return option in _values


## The option's text, or [param default] where it was not given.
func text(option: String, default := "") -> String:
	return _values.get(option, default)


## The option's text; an error where it was not given.
func required(option: String) -> String:
	if option not in _values:
		fail("--%s is missing." % option)
	return text(option)


## The option as an absolute path: relative ones start where the user called the command.
func path(option: String) -> String:
	var given := text(option)
	if given.is_empty() or given.is_absolute_path():
		return given
	return OS.get_environment("LOBELIGHT_CWD").path_join(given).simplify_path()


## The option as a BRDF: a model's name, or the absolute path of a file of measurements.
func brdf(option: String) -> String:
	return path(option) if is_measured(text(option)) else text(option)


## True where a BRDF is a file: MERL's .binary, RGL's .bsdf, or anything with a folder.
static func is_measured(name: String) -> bool:
	return name.get_extension() in ["binary", "bsdf"] or "/" in name or "\\" in name


## The option as a whole number in a range; an error names the option where it is not one.
func integer(option: String, default: int, low: int, high: int) -> int:
	if option not in _values:
		return default
	var given := text(option)
	if not given.is_valid_int() or given.to_int() < low or given.to_int() > high:
		fail("--%s must be a whole number from %d to %d, not %s." % [option, low, high, given])
		return default
	return given.to_int()


## The option as [param count] numbers separated by commas; an error names the option otherwise.
func numbers(option: String, count: int, default: PackedFloat64Array) -> PackedFloat64Array:
	if option not in _values:
		return default
	var values := PackedFloat64Array()
	for part in text(option).split(","):
		if not part.strip_edges().is_valid_float():
			fail("--%s must be numbers separated by commas, not %s." % [option, text(option)])
			return default
		values.append(part.to_float())
	if values.size() != count:
		fail("--%s takes %d numbers, not %s." % [option, count, text(option)])
		return default
	return values


## Keeps the first sentence that says what is wrong.
func fail(sentence: String) -> void:
	if error.is_empty():
		error = sentence


## As [method fail]; an empty sentence means that nothing failed.
func fail_if(sentence: String) -> void:
	if not sentence.is_empty():
		fail(sentence)


## The error as the line to print.
func error_line() -> String:
	return "%s: %s" % [_command, error]
