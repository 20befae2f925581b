class_name NativeLibrary
extends RefCounted
## The editor library's classes, reached by name so that these scripts also parse without it.

## Texels along a side of what graphics cards take as a texture.
const LARGEST_TEXTURE := 16384


## A new object of a native class; ends the program with one line where the library is missing.
static func create(native_class: StringName) -> RefCounted:
	return ClassDB.instantiate(native_class) as RefCounted


## One sentence where the library is not loaded, otherwise empty.
static func error() -> String:
	if ClassDB.class_exists(&"LobeBaker"):
		return ""
	return "the Lobelight library is not loaded; run ./dev setup to build it."


## Reads an environment map: {"width", "height", "pixels", "clamped", "notes",
## "warnings"} or {"error"}.
static func load_panorama(path: String) -> Dictionary:
	return create(&"LobeImageFile").call("load_panorama", path)


## Writes linear RGB floats as an EXR; returns one sentence on failure, otherwise empty.
static func save_exr(path: String, width: int, height: int, pixels: PackedFloat32Array) -> String:
	return create(&"LobeImageFile").call("save_exr", path, width, height, pixels)


## Runs a native worker (LobeBaker, LobeReference) to its end with a progress line.
## Returns its result, which holds "error" where it failed.
static func run(
	worker: RefCounted, options: Dictionary, label: String, tree: SceneTree
) -> Dictionary:
	if not worker.call("start", options):
		return {"error": worker.call("get_error")}
	var line := ProgressLine.new(label)
	while worker.call("is_running"):
		# Before anything is done there may still be nothing but one sentence to say: a bad file.
		var progress: float = worker.call("get_progress")
		if progress > 0.0:
			line.show(progress)
		await tree.create_timer(0.05).timeout
	var failure: String = worker.call("get_error")
	if not failure.is_empty():
		return {"error": failure}
	line.finish()
	return worker.call("get_result")
