extends RefCounted
## What the first light of a panorama costs beside a frame of 720p that eight lobes light: in how
## much longer frames are, until the light is there, than those that follow; and how long the
## longest of them is, and the longest of the next update where updates are spread over frames.
##
## Frames are measured by the wall clock, each to where the GPU has drawn it: a texel is read back.
## The first round also has what is compiled and allocated once; medians are of the others.

const Scene := preload("scene.gd")
const PANORAMA := Vector2i(1024, 512)
const MODES: Dictionary[String, LobeEnvironment3D.UpdateMode] = {
	"once": LobeEnvironment3D.UpdateMode.ONCE,
	"time_sliced": LobeEnvironment3D.UpdateMode.TIME_SLICED,
}
# The frames around a first light that tell how long an ordinary one is.
const _ORDINARY := 5
# After a node has left, until nothing of its work is left.
const _REST := 8
const _LONGEST := 400

## Why there are no results, in a sentence.
var error := ""

var _tree: SceneTree
var _view: LinearViewport
var _reader: SubViewport
var _is_lit := false
var _last := 0


## To be awaited.
func measure(tree: SceneTree, scale: int, rounds: int) -> Array[Dictionary]:
	_tree = tree
	DisplayServer.window_set_vsync_mode(DisplayServer.VSYNC_DISABLED)
	_view = Scene.make_view(tree, scale)
	_view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	# Drawn after the frame.
	_reader = SubViewport.new()
	_reader.size = 2 * Vector2i.ONE
	_reader.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	tree.root.add_child(_reader)
	var panorama := Scene.make_panorama(PANORAMA / scale)
	var results: Array[Dictionary] = []
	for mode in MODES:
		var result := await _measure_mode(mode, panorama, rounds)
		if not error.is_empty():
			break
		print(
			(
				"%s: first light costs %.1f frames (%.1f at the first time), the longest is %.1f, later %.1f"
				% [
					mode,
					result["first_light_frames"],
					result["cold_frames"],
					result["longest_frame_ratio"],
					result["turn_longest_frame_ratio"],
				]
			)
		)
		results.append(result)
	_view.free()
	_reader.free()
	return results


func _measure_mode(mode: String, panorama: Texture2D, rounds: int) -> Dictionary:
	var costs := PackedFloat32Array()
	var longest := PackedFloat32Array()
	var ordinary := PackedFloat32Array()
	var counts := PackedFloat32Array()
	var turns := PackedFloat32Array()
	for i in rounds + 1:
		var environment := LobeEnvironment3D.new()
		environment.update_mode = MODES[mode]
		environment.panorama = panorama
		environment.rebuilt.connect(func() -> void: _is_lit = true)
		for frame in _REST:
			await _time_frame()
		_is_lit = false
		_view.add_child(environment)
		var times := PackedFloat32Array()
		# At least the frame that the node has come in, whose time began before it came.
		times.append(await _time_frame())
		while not _is_lit and times.size() < _LONGEST:
			times.append(await _time_frame())
		if not _is_lit:
			error = "the environment made no light in %d frames." % _LONGEST
			break
		var turn := await _time_turn(environment)
		environment.hide()
		for frame in _REST:
			await _time_frame()
		var others := PackedFloat32Array()
		for frame in _ORDINARY:
			others.append(await _time_frame())
		environment.free()
		ordinary.append(LinearViewport.median(others))
		var cost := 0.0
		var most := 0.0
		for time in times:
			cost += time - ordinary[-1]
			most = maxf(most, time)
		var most_of_turn := 0.0
		for time in turn:
			most_of_turn = maxf(most_of_turn, time)
		turns.append(most_of_turn / ordinary[-1])
		costs.append(cost / ordinary[-1])
		longest.append(most / ordinary[-1])
		counts.append(times.size())
	return {
		"renderer": RenderingServer.get_current_rendering_method(),
		"mode": mode,
		"panorama": [panorama.get_width(), panorama.get_height()],
		"frame": [_view.size.x, _view.size.y],
		"rounds": rounds,
		"frame_ms": LinearViewport.median(ordinary),
		"first_light_frames": LinearViewport.median(costs.slice(1)),
		"longest_frame_ratio": LinearViewport.median(longest.slice(1)),
		"until_light": LinearViewport.median(counts.slice(1)),
		"turn_longest_frame_ratio": LinearViewport.median(turns.slice(1)),
		"cold_frames": costs[0] if costs.size() > 0 else 0.0,
		"cold_longest_frame_ratio": longest[0] if longest.size() > 0 else 0.0,
	}


# The frames of the next update in TIME_SLICED; none in other modes.
func _time_turn(environment: LobeEnvironment3D) -> PackedFloat32Array:
	var times := PackedFloat32Array()
	if environment.update_mode != LobeEnvironment3D.UpdateMode.TIME_SLICED:
		return times
	_is_lit = false
	while not _is_lit and times.size() < _LONGEST:
		times.append(await _time_frame())
	return times


# Milliseconds of a frame, from the end of the one before.
func _time_frame() -> float:
	await RenderingServer.frame_post_draw
	_reader.get_texture().get_image()
	var now := Time.get_ticks_usec()
	var time := 0.001 * (now - _last)
	_last = now
	return time
