extends RefCounted
## Shaders of a scene's materials, how many pipelines the engine makes of them, and how long it
## takes until the scene is drawn; beside the same with [StandardMaterial3D].
##
## The materials are made one kind after the other; the times are those of all frames until the
## engine makes no more pipelines, less as many frames as they are later.

const Scene := preload("scene.gd")
const SIDE := 128
# Frames in which no pipeline is made, until none is expected any more.
const _STILL := 30
const _LONGEST := 3000

## What is set, one material each: what a scene of things would have.
const MATERIALS: Array[Dictionary] = [
	{&"metallic": 1.0, &"roughness": 0.2},
	{&"metallic": 1.0, &"roughness": 0.4, &"anisotropy_enabled": true, &"anisotropy": 0.7},
	{&"roughness": 0.6},
	{&"roughness": 0.3, &"clearcoat_enabled": true},
	{&"roughness": 0.8, &"emission_enabled": true, &"emission": Color(0.5, 0.3, 0.1)},
	{&"roughness": 0.5, &"normal_enabled": true},
	{&"roughness": 0.1, &"transparency": BaseMaterial3D.TRANSPARENCY_ALPHA},
	{&"roughness": 0.7, &"metallic": 0.5, &"uv1_triplanar": true},
]

## Why there are no results, in a sentence.
var error := ""

var _tree: SceneTree


## To be awaited.
func measure(tree: SceneTree, _scale: int, _rounds: int) -> Array[Dictionary]:
	_tree = tree
	var environment := LobeEnvironment3D.new()
	environment.panorama = Scene.make_panorama(Vector2i(64, 32))
	var view := LinearViewport.new(SIDE)
	tree.root.add_child(view)
	view.add_child(environment)
	view.add_child(DirectionalLight3D.new())
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	# What the view itself needs is made before.
	await _show(view, [StandardMaterial3D.new()], true)
	await environment.rebuild()
	var makers: Dictionary[String, Callable] = {
		"StandardMaterial3D": func() -> Material: return StandardMaterial3D.new(),
		"LobeMaterial3D": func() -> Material: return LobeMaterial3D.new(),
	}
	var results: Array[Dictionary] = []
	for kind in makers:
		var materials: Array[Material] = []
		for values in MATERIALS:
			var material: Material = makers[kind].call()
			for name in values:
				material.set(name, values[name])
			materials.append(material)
		var result := await _show(view, materials, false)
		result.merge({"material": kind, "shaders": _count_shaders(materials)})
		results.append(result)
		print(
			(
				"%s: %d materials make %d shaders and %d pipelines, in %.0f ms"
				% [
					kind,
					result["materials"],
					result["shaders"],
					result["pipelines"],
					result["compile_ms"],
				]
			)
		)
	if results.size() == 2 and results[0]["compile_ms"] > 0.0:
		results[1]["compile_ratio"] = results[1]["compile_ms"] / results[0]["compile_ms"]
	view.free()
	return results


# One of each kind is drawn until nothing more is compiled.
func _show(view: LinearViewport, materials: Array[Material], is_first: bool) -> Dictionary:
	var before := _count_pipelines()
	var balls: Array[MeshInstance3D] = []
	var begin := Time.get_ticks_usec()
	for i in materials.size():
		var ball := MeshInstance3D.new()
		ball.mesh = SphereMesh.new()
		ball.scale = 0.4 * Vector3.ONE
		@warning_ignore("integer_division")
		ball.position = Vector3(0.5 * (i % 4) - 0.75, 0.5 * (i / 4) - 0.25, 0.0)
		ball.material_override = materials[i]
		view.add_child(ball)
		balls.append(ball)
	var count := before
	var changed := begin
	var still := 0
	var frames := 0
	while still < _STILL and frames < _LONGEST:
		await RenderingServer.frame_post_draw
		frames += 1
		still += 1
		if _count_pipelines() != count or frames == 1:
			count = _count_pipelines()
			changed = Time.get_ticks_usec()
			still = 0
	var ordinary := (Time.get_ticks_usec() - changed) / maxf(still, 1.0)
	for ball in balls:
		ball.free()
	if is_first:
		return {}
	var total := changed - begin - ordinary * (frames - still)
	return {
		"renderer": RenderingServer.get_current_rendering_method(),
		"materials": materials.size(),
		"pipelines": count - before,
		"compile_ms": 0.001 * maxf(total, 0.0),
	}


# Materials of the engine have shaders of their own that scripts do not see: one for each here.
static func _count_shaders(materials: Array[Material]) -> int:
	var seen: Dictionary[String, bool] = {}
	for material in materials:
		if material is LobeMaterial3D:
			seen[(material as LobeMaterial3D).get_shader_code()] = true
	return seen.size() if not seen.is_empty() else materials.size()


static func _count_pipelines() -> int:
	var count := 0
	for info: RenderingServer.RenderingInfo in [
		RenderingServer.RENDERING_INFO_PIPELINE_COMPILATIONS_MESH,
		RenderingServer.RENDERING_INFO_PIPELINE_COMPILATIONS_SURFACE,
		RenderingServer.RENDERING_INFO_PIPELINE_COMPILATIONS_DRAW,
		RenderingServer.RENDERING_INFO_PIPELINE_COMPILATIONS_SPECIALIZATION,
	]:
		count += RenderingServer.get_rendering_info(info)
	return count
