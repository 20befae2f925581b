@tool
extends "walk.gd"
## Goes on from the brushed sphere: the scene's light, its report, and a table for the material.

# Of a tenth of a second: a reference takes its time on a busy machine.
const _TURNS := 3000


func go() -> void:
	await _look_at_environment()
	await _report()
	await _open_material()
	await _unfold("BRDF")
	await _choose_resource(&"table", "LobeTable")
	await _mouse.click(Finder.button(Finder.property(&"table"), ""), "the table")
	await _mouse.wait(1.0)
	await _bake()
	await _see()


func _look_at_environment() -> void:
	await _select("LobeEnvironment3D")
	await _mouse.wait(2.0)
	await _take.call("2_environment")


func _open_material() -> void:
	await _select("BrushedSphere")
	await _unfold("Geometry")
	await _mouse.click(Finder.button(Finder.property(&"material_override"), ""), "the material")
	await _mouse.wait(1.0)


func _select(node: String) -> void:
	var tree: Tree = Finder.of_class(Finder.of_class(_root, "SceneTreeEditor"), "Tree")
	await _mouse.choose_item(tree, Finder.item(tree.get_root(), node), 0, node)
	await _mouse.wait(0.5)


func _report() -> void:
	await _open_menu("Project")
	var tools := await _mouse.open_submenu(await _mouse.find_menu(_root, "Tools"), "Tools")
	var ours := await _mouse.open_submenu(tools, "Lobelight")
	await _mouse.choose_from(ours, "Report What This Scene Uses …")
	await _mouse.wait(0.5)
	await _take.call("8_report")
	await _mouse.click(Finder.button(_find_menu(), "OK"), "OK")


# Its dialogs are below it.
func _find_menu() -> Node:
	return Finder.of_script(_root, "tools_menu.gd")


func _bake() -> void:
	var inspector := EditorInterface.get_inspector()
	var panel := Finder.of_script(inspector, "bake_panel.gd")
	var presets := Finder.button(panel, "Preset …")
	await _mouse.scroll_to(inspector, presets)
	await _mouse.click(presets, "Preset …")
	await _mouse.choose(_root, "Brushed steel")
	var bake := Finder.button(panel, "Bake")
	await _mouse.scroll_to(inspector, bake)
	await _mouse.click(bake, "Bake")
	var dialog: Window = Finder.of_script(_root, "bake_dialog.gd")
	await _wait_until(func() -> bool: return dialog.visible, "the dialog of the bake")
	await _take.call("5_bake")
	await _mouse.click(Finder.button(dialog, "Cancel Bake"), "Cancel Bake")
	await _wait_until(func() -> bool: return not dialog.visible, "the end of the bake")
	await _mouse.wait(0.5)
	var table: LobeTable = panel.get("table")
	if table.lobe_count != 0:
		_mouse.fail("the bake is not cancelled")
	await _mouse.click(bake, "Bake")
	await _wait_until(func() -> bool: return table.lobe_count == 16, "the baked table")


func _see() -> void:
	await _mouse.wait(1.0)
	var inspector := EditorInterface.get_inspector()
	await _widen(inspector)
	var compare := Finder.button(inspector, "Compare with Reference")
	await _mouse.scroll_to(inspector, compare)
	await _mouse.wait(1.0)
	await _mouse.click(compare, "Compare with Reference")
	var spheres := Finder.of_script(inspector, "sphere_comparison.gd")
	await _wait_until(
		func() -> bool: return "dB" in (spheres.call("get_status") as String), "the reference"
	)
	await _take.call("6_baked")


# Side by side, the plots fit into the picture.
func _widen(inspector: Control) -> void:
	var dock: Control = inspector
	while not dock is TabContainer:
		dock = dock.get_parent_control()
	var rect := _mouse.find_rect(dock)
	var edge := Vector2(rect.position.x - 2.0, rect.get_center().y)
	await _mouse.drag_from(edge, Vector2(-120.0, 0.0), "the edge of the inspector")
	_expect(dock.size.x > rect.size.x + 100.0, "wider inspector")


func _wait_until(condition: Callable, what: String) -> void:
	for turn in _TURNS:
		if condition.call():
			return
		await _mouse.wait(0.1)
	_mouse.fail(what + " does not come")
