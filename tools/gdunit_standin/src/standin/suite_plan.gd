## What a suite's script asks to be run: its tests with their arguments, time limits and skips.

const _DEFAULT_TIMEOUT_MS := 300_000


## One test, or one case of a parameterised test.
class Case:
	extends RefCounted
	var method: String
	var label: String
	var arguments := []
	var timeout_ms := _DEFAULT_TIMEOUT_MS
	var skipped := false
	var skip_reason := ""
	## Why it cannot be run; empty if it can.
	var defect := ""


var path: String
var suite_script: GDScript
var cases: Array[Case] = []
## Why the suite cannot be run; empty if it can.
var defect := ""


## Reads the script at [param suite_path]; null if it is a healthy script that is no suite.
static func read(suite_path: String) -> RefCounted:
	var plan := new()
	plan.path = suite_path
	plan.suite_script = load(suite_path) as GDScript
	if plan.suite_script == null or not plan.suite_script.can_instantiate():
		plan.defect = "the script does not load"
	elif not _inherits_suite(plan.suite_script):
		if not suite_path.ends_with("_test.gd"):
			return null
		plan.defect = "the script is no GdUnitTestSuite"
	else:
		plan._read_methods()
		if plan.cases.is_empty():
			plan.defect = "the suite has no test"
	return plan


## Leaves out the tests that [param ignored] names, as res://suite.gd:test. A name that is no test's
## is a defect of the suite.
func leave_out(ignored: PackedStringArray) -> void:
	for name in ignored:
		if not name.begins_with(path + ":"):
			continue
		var method := name.trim_prefix(path + ":")
		var count := cases.size()
		cases.assign(cases.filter(func(case: Case) -> bool: return case.method != method))
		if cases.size() == count:
			defect = "%s is to be left out, but there is no such test" % method


static func _inherits_suite(script: Script) -> bool:
	var base := script.get_base_script()
	while base != null:
		if base.get_global_name() == &"GdUnitTestSuite":
			return true
		base = base.get_base_script()
	return false


func _read_methods() -> void:
	var methods: Dictionary[String, Dictionary] = {}
	for method: Dictionary in suite_script.get_script_method_list():
		var name: String = method.name
		if not methods.has(name):
			methods[name] = method
	var suite_options := _options(methods["before"])
	for name in methods:
		if not name.begins_with("test"):
			continue
		var options := _options(methods[name])
		options.merge(suite_options)
		_add_cases(name, options)


## The default values of a method's parameters by name, an underscore in front left out.
static func _options(method: Dictionary) -> Dictionary[String, Variant]:
	var options: Dictionary[String, Variant] = {}
	var parameters: Array = method.args
	var defaults: Array = method.default_args
	var first := parameters.size() - defaults.size()
	for i in parameters.size():
		var parameter: String = parameters[i].name
		options[parameter.trim_prefix("_")] = defaults[i - first] if i >= first else null
	return options


func _add_cases(method: String, options: Dictionary[String, Variant]) -> void:
	var parameter_sets: Variant = options.get("test_parameters", [[]])
	if not parameter_sets is Array or (parameter_sets as Array).is_empty():
		var case := _add_case(method, method, [], options)
		case.defect = "test_parameters must be a constant and not empty"
		return
	for i: int in parameter_sets.size():
		var label := "%s:%d %s" % [method, i, parameter_sets[i]] if parameter_sets[i] else method
		_add_case(method, label, parameter_sets[i], options)


func _add_case(
	method: String, label: String, arguments: Array, options: Dictionary[String, Variant]
) -> Case:
	var case := Case.new()
	case.method = method
	case.label = label
	case.arguments = arguments
	case.skipped = options.get("do_skip", false) == true
	case.skip_reason = str(options.get("skip_reason", ""))
	if options.has("timeout"):
		case.timeout_ms = options["timeout"]
	cases.append(case)
	return case
