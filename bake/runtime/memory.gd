extends RefCounted
## What a light and tables take on the GPU and in files, in bytes: a panorama's light that is made
## when the game runs and one that the library has made before; the panorama itself does not count.

const Scene := preload("scene.gd")
const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const PanoramaFilter := preload("res://addons/lobelight/editor/light/panorama_filter.gd")
const PANORAMA := Vector2i(2048, 1024)
# Until what drew the light has been given back.
const _SETTLING := 300
const _FILE := "user://light.res"

## Why there are no results, in a sentence.
var error := ""

var _tree: SceneTree


## To be awaited.
func measure(tree: SceneTree, scale: int, _rounds: int) -> Array[Dictionary]:
	_tree = tree
	var results: Array[Dictionary] = []
	results.append(await _measure_table())
	var panorama := Scene.make_panorama(PANORAMA / scale)
	for kind: String in ["live light", "baked light"]:
		results.append(await _measure_light(kind, panorama))
	for result in results:
		print(
			(
				"%s: %.2f MiB of textures, %.2f MiB in a file"
				% [result["thing"], result["texture_mib"], result["file_mib"]]
			)
		)
	return results


# The table that a material has without any setting.
func _measure_table() -> Dictionary:
	var environment := LobeEnvironment3D.new()
	environment.light = LobeLight.make_constant(Color.WHITE, true)
	_tree.root.add_child(environment)
	var ball := MeshInstance3D.new()
	ball.mesh = SphereMesh.new()
	_tree.root.add_child(ball)
	await _settle()
	var before := Scene.texture_bytes()
	ball.material_override = LobeMaterial3D.new()
	await _settle()
	var result := _make_result("tables of a material", Scene.texture_bytes() - before)
	ball.free()
	environment.free()
	return result


func _measure_light(kind: String, panorama: ImageTexture) -> Dictionary:
	await _settle()
	var before := Scene.texture_bytes()
	var environment := LobeEnvironment3D.new()
	var bytes := 0
	if kind == "live light":
		environment.panorama = panorama
	else:
		environment.light = _bake(panorama)
		if ResourceSaver.save(environment.light, _FILE, ResourceSaver.FLAG_COMPRESS) == OK:
			bytes = FileAccess.get_file_as_bytes(_FILE).size()
			DirAccess.remove_absolute(_FILE)
	_tree.root.add_child(environment)
	await environment.rebuild()
	await _settle()
	if environment.get_cubemap() == null:
		error = "the environment made no light: %s" % environment.get_rebuild_error()
	var result := _make_result(kind, Scene.texture_bytes() - before, bytes)
	result["panorama"] = [panorama.get_width(), panorama.get_height()]
	environment.free()
	return result


func _bake(panorama: ImageTexture) -> LobeLight:
	var request := PanoramaFilter.make_request(panorama.get_image())
	var result: Dictionary = LobeLightFilter.new().filter(request)
	var light := PanoramaFilter.make_light(request, result)
	LightFormats.convert_light(light, LightFormats.Format.BPTC)
	return light


static func _make_result(thing: String, bytes: int, file := 0) -> Dictionary:
	return {
		"renderer": RenderingServer.get_current_rendering_method(),
		"thing": thing,
		"texture_mib": bytes / 1048576.0,
		"file_mib": file / 1048576.0,
	}


func _settle() -> void:
	for frame in _SETTLING:
		await _tree.process_frame
