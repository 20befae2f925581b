@tool
extends GdUnitTestSuite
## Materials with shaders of one's own in the editor: warnings, the inspector, and the light without
## the game running.

const Binding := preload("res://addons/lobelight/runtime/own_shaders/shader_binding.gd")
const Inspector := preload("res://addons/lobelight/editor/own_shaders/own_shader_inspector.gd")
const Kit := preload("../editor_kit.gd")
const SceneWarnings := preload("res://addons/lobelight/editor/warnings/scene_warnings.gd")
const UNBOUND := "until a script calls LobeLight.bind(material)"


func before() -> void:
	assert_object(Kit.get_plugin(get_tree())).is_not_null()


func test_materials_that_nobody_binds_are_told_so() -> void:
	var graph := VisualShader.new()
	graph.add_node(
		VisualShader.TYPE_FRAGMENT, VisualShaderNodeLobelightDiffuse.new(), Vector2.ZERO, 2
	)
	graph.connect_nodes(VisualShader.TYPE_FRAGMENT, 2, 1, 0, 5)
	var text := Shader.new()
	text.code = Inspector._FIRST
	var other := Shader.new()
	other.code = "shader_type spatial;\n"
	for shader: Shader in [graph, text, other]:
		var material := ShaderMaterial.new()
		material.shader = shader
		var is_dark := shader != other
		assert_bool(UNBOUND in _warnings_of(material)).is_equal(is_dark)
		if is_dark:
			LobeLight.bind(material)
			assert_str(_warnings_of(material)).not_contains(UNBOUND)
			LobeLight.unbind(material)
			assert_str(_warnings_of(material)).contains(UNBOUND)
	assert_str(_warnings_of(LobeShaderMaterial.new())).not_contains(UNBOUND)
	assert_str(_warnings_of(LobeMaterial3D.new())).not_contains(UNBOUND)


func test_the_inspector_has_a_first_shader_and_not_the_light() -> void:
	var material := LobeShaderMaterial.new()
	var inspector := EditorInspector.new()
	get_tree().root.add_child(inspector)
	inspector.edit(material)
	await Kit.wait_until(get_tree(), func() -> bool: return _find_button(inspector) != null, 5.0)
	var button := _find_button(inspector)
	assert_object(button).is_not_null()
	if button == null:
		inspector.free()
		return
	button.pressed.emit()
	assert_str(material.shader.code).contains("lobelight.gdshaderinc")
	var names: PackedStringArray = []
	var count := func() -> int:
		names.clear()
		for node in inspector.find_children("*", "EditorProperty", true, false):
			names.append((node as EditorProperty).get_edited_property())
		return names.size()
	await Kit.wait_until(
		get_tree(),
		func() -> bool: return count.call() > 0 and "shader_parameter/colour" in names,
		5.0
	)
	assert_array(Array(names)).contains(["shader_parameter/colour", "shader_parameter/roughness"])
	assert_str(" ".join(names)).not_contains("lobelight_")
	Kit.get_history(material).undo()
	assert_object(material.shader).is_null()
	inspector.free()


func test_materials_are_bound_without_the_game() -> void:
	var material := LobeShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = Inspector._FIRST
	# The lobes that it was given; the headless renderer keeps no parameters.
	var has_lobes := func() -> bool: return Binding._find(material)._texture != null
	assert_bool(await Kit.wait_until(get_tree(), has_lobes, 5.0)).is_true()


static func _warnings_of(material: Material) -> String:
	var root := MeshInstance3D.new()
	root.mesh = SphereMesh.new()
	root.material_override = material
	var text := "\n".join(SceneWarnings.of_scene(root))
	root.free()
	return text


static func _find_button(inspector: EditorInspector) -> Button:
	for node in inspector.find_children("*", "Button", true, false):
		if (node as Button).text == "Create Shader":
			return node
	return null
