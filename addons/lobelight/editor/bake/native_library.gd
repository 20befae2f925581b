@tool
extends Object
## The native library's classes, by name, so that the editor's scripts also parse without it.

## What to do where the library is not there.
const MISSING := (
	"Lobelight's native library is not loaded, so nothing can be baked or imported by it: build it "
	+ "with ./dev setup, or install the addon's package, which brings it, and restart the editor."
)


static func is_loaded() -> bool:
	return ClassDB.class_exists(&"LobeBaker")


## Why it cannot be used, in a sentence; empty if it can.
static func get_problem() -> String:
	return "" if is_loaded() else MISSING


## A new object of one of its classes; [code]null[/code] where the library is missing.
static func create(native_class: StringName) -> RefCounted:
	if not ClassDB.class_exists(native_class):
		return null
	return ClassDB.instantiate(native_class) as RefCounted
