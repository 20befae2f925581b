@tool
extends GdUnitTestSuite
## Enabling and disabling the addon leaves nothing behind, also while a bake runs.

const Kit := preload("res://tests/editor/editor_kit.gd")
const Recipe := preload("res://addons/lobelight/editor/bake/bake_recipe.gd")

const TIMES := 20


func _count_nodes() -> int:
	return int(Performance.get_monitor(Performance.OBJECT_NODE_COUNT))


func _count_orphans() -> int:
	return int(Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT))


# What is freed with the plugin, is so some frames later.
func _settles(nodes: int, orphans: int) -> bool:
	var is_settled := func() -> bool: return _count_nodes() <= nodes and _count_orphans() <= orphans
	return await Kit.wait_until(get_tree(), is_settled, 3.0)


func _toggle() -> void:
	EditorInterface.set_plugin_enabled(Kit.ADDON, false)
	await await_idle_frame()
	EditorInterface.set_plugin_enabled(Kit.ADDON, true)
	await await_idle_frame()


# The objects that the plugin has made.
func _find_parts(plugin: EditorPlugin) -> Array[WeakRef]:
	var parts: Array[WeakRef] = [weakref(plugin)]
	for property in plugin.get_script().get_script_property_list():
		var value: Variant = plugin.get(property["name"])
		for part: Variant in value if value is Array else [value]:
			if part is Object:
				parts.append(weakref(part))
	return parts


func test_twenty_reloads_leave_nothing() -> void:
	Kit.get_plugin(get_tree())
	await _toggle()
	await await_millis(100)
	var nodes := _count_nodes()
	var orphans := _count_orphans()
	var parts: Array[WeakRef] = []
	for time in TIMES:
		parts.append_array(_find_parts(Kit.get_plugin(get_tree())))
		await _toggle()
	assert_int(parts.size()).is_greater(10 * TIMES)
	assert_bool(await _settles(nodes, orphans)).is_true()
	var left := parts.filter(func(part: WeakRef) -> bool: return part.get_ref() != null)
	assert_int(left.size()).is_equal(0)


func test_disabling_ends_a_bake() -> void:
	var nodes := _count_nodes()
	var orphans := _count_orphans()
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
	assert_bool(await _settles(nodes, orphans)).is_true()
