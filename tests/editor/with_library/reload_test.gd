@tool
extends GdUnitTestSuite
## Enabling and disabling the addon leaves nothing behind, also while a bake runs.

const Kit := preload("res://tests/editor/editor_kit.gd")
const Recipe := preload("res://addons/lobelight/editor/bake/bake_recipe.gd")

const TIMES := 20


func _count() -> Array[int]:
	for frame in 4:
		await await_idle_frame()
	return [
		int(Performance.get_monitor(Performance.OBJECT_NODE_COUNT)),
		int(Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT)),
		int(Performance.get_monitor(Performance.OBJECT_COUNT)),
	]


func _toggle(times: int) -> void:
	for time in times:
		EditorInterface.set_plugin_enabled(Kit.ADDON, false)
		await await_idle_frame()
		EditorInterface.set_plugin_enabled(Kit.ADDON, true)
		await await_idle_frame()


func test_twenty_reloads_leave_nothing() -> void:
	Kit.get_plugin(get_tree())
	await _toggle(2)
	var counts := await _count()
	await _toggle(TIMES)
	var after_reloads := await _count()
	assert_int(after_reloads[0]).is_equal(counts[0])
	assert_int(after_reloads[1]).is_equal(counts[1])
	# The editor itself keeps a little for each change of the project's settings.
	assert_int(after_reloads[2] - counts[2]).is_less(TIMES)


func test_disabling_ends_a_bake() -> void:
	var table := LobeTable.new()
	var recipe := Recipe.new()
	recipe.alpha = Vector2(0.01, 0.3)
	recipe.lobes = 32
	var bakes: Node = Kit.get_plugin(get_tree()).get_bakes()
	bakes.add(table, recipe)
	await await_idle_frame()
	assert_bool(bakes.is_baking(table)).is_true()
	var start := Time.get_ticks_msec()
	EditorInterface.set_plugin_enabled(Kit.ADDON, false)
	await await_idle_frame()
	assert_int(Time.get_ticks_msec() - start).is_less(10000)
	assert_int(table.lobe_count).is_equal(0)
	Kit.get_plugin(get_tree())
