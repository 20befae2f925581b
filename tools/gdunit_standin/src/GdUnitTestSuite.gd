# gdlint:disable=max-public-methods
class_name GdUnitTestSuite
extends Node
## Base class of test suites: the part of gdUnit4's class that this project uses.

const StandinRecord := preload("res://addons/gdUnit4/src/standin/test_record.gd")
const StandinErrorWatch := preload("res://addons/gdUnit4/src/standin/error_watch.gd")

# Of this run, so that others at the same time are not disturbed.
static var _temporary := "user://tmp".path_join(str(OS.get_process_id()))

## The running test's record, set by the runner.
var standin_record := StandinRecord.new("")
## The log of errors, set by the runner.
var standin_watch: StandinErrorWatch

var _standin_to_free: Array[Object] = []


## Runs once before the tests of the suite.
func before() -> void:
	pass


## Runs once after the tests of the suite.
func after() -> void:
	pass


## Runs before each test.
func before_test() -> void:
	pass


## Runs after each test.
func after_test() -> void:
	pass


## True once an assertion of the running test has failed.
func is_failure() -> bool:
	return standin_record.has_failed()


## Fails the running test.
func fail(message: String) -> void:
	standin_record.count_assertion()
	standin_record.fail(message)


## Frees the object when the test ends. Returns it.
func auto_free(obj: Variant) -> Variant:
	if obj is Object and not obj is RefCounted:
		_standin_to_free.append(obj)
	return obj


## Makes a folder for temporary files and returns its path.
func create_temp_dir(relative_path: String) -> String:
	var path := _temporary.path_join(relative_path)
	DirAccess.make_dir_recursive_absolute(path)
	return path


## Removes the folder for temporary files with all it holds.
func clean_temp_dir() -> void:
	_standin_remove(_temporary)


func await_idle_frame() -> void:
	await get_tree().process_frame


func await_millis(timeout: int) -> void:
	await get_tree().create_timer(timeout / 1000.0).timeout


## The assertion that fits the type of the value.
func assert_that(current: Variant) -> GdUnitAssert:
	if typeof(current) >= TYPE_ARRAY:
		return assert_array(current)
	if typeof(current) in GdUnitVectorAssert.SIZES:
		return assert_vector(current)
	var makers: Dictionary[int, Callable] = {
		TYPE_BOOL: assert_bool,
		TYPE_INT: assert_int,
		TYPE_FLOAT: assert_float,
		TYPE_STRING: assert_str,
		TYPE_STRING_NAME: assert_str,
		TYPE_DICTIONARY: assert_dict,
		TYPE_NIL: assert_object,
		TYPE_OBJECT: assert_object,
	}
	if makers.has(typeof(current)):
		return makers[typeof(current)].call(current)
	return GdUnitAssert.new(standin_record, current)


func assert_bool(current: Variant) -> GdUnitBoolAssert:
	return GdUnitBoolAssert.new(standin_record, current)


func assert_int(current: Variant) -> GdUnitIntAssert:
	return GdUnitIntAssert.new(standin_record, current)


func assert_float(current: Variant) -> GdUnitFloatAssert:
	return GdUnitFloatAssert.new(standin_record, current)


func assert_str(current: Variant) -> GdUnitStringAssert:
	return GdUnitStringAssert.new(standin_record, current)


func assert_vector(current: Variant) -> GdUnitVectorAssert:
	return GdUnitVectorAssert.new(standin_record, current)


func assert_object(current: Variant) -> GdUnitObjectAssert:
	return GdUnitObjectAssert.new(standin_record, current)


func assert_array(current: Variant) -> GdUnitArrayAssert:
	return GdUnitArrayAssert.new(standin_record, current)


func assert_dict(current: Variant) -> GdUnitDictionaryAssert:
	return GdUnitDictionaryAssert.new(standin_record, current)


func assert_file(current: Variant) -> GdUnitFileAssert:
	return GdUnitFileAssert.new(standin_record, current)


func assert_signal(instance: Object) -> GdUnitSignalAssert:
	return GdUnitSignalAssert.new(standin_record, instance)


func assert_error(current: Callable) -> GdUnitGodotErrorAssert:
	return GdUnitGodotErrorAssert.new(standin_record, standin_watch, current)


## Frees what [method auto_free] was given.
func standin_free_objects() -> void:
	for object: Variant in _standin_to_free:
		if is_instance_valid(object):
			object.free()
	_standin_to_free.clear()


static func _standin_remove(path: String) -> void:
	for file in DirAccess.get_files_at(path):
		DirAccess.remove_absolute(path.path_join(file))
	for directory in DirAccess.get_directories_at(path):
		_standin_remove(path.path_join(directory))
	DirAccess.remove_absolute(path)
