@tool
extends GdUnitTestSuite
## Looks for materials in the running editor: what they set, in one step, and what they leave.

const Kit := preload("res://tests/editor/editor_kit.gd")
const MaterialPresets := preload("res://addons/lobelight/editor/presets/material_presets.gd")
const PresetChoice := preload("res://addons/lobelight/editor/presets/preset_choice.gd")


func test_every_look_sets_properties_to_what_they_take() -> void:
	var names := MaterialPresets.get_names()
	assert_array(names).contains(["Brushed Metal", "Car Paint", "Plastic", "Hair"])
	for name in names:
		var material := LobeMaterial3D.new()
		var properties := MaterialPresets.find(name)
		for property in properties:
			assert_bool(property in material).override_failure_message(property).is_true()
			material.set(property, properties[property])
		# No look is another one's, and what is set is what is read.
		assert_str(MaterialPresets.find_name(material)).is_equal(name)


func test_a_look_is_one_step_and_textures_stay() -> void:
	var texture := ImageTexture.create_from_image(
		Image.create_empty(2, 2, false, Image.FORMAT_RGB8)
	)
	var material := LobeMaterial3D.new()
	material.albedo_texture = texture
	material.roughness = 0.77
	var history := Kit.get_plugin(get_tree()).get_undo_redo()
	MaterialPresets.apply(material, "Brushed Metal", history)
	assert_str(MaterialPresets.find_name(material)).is_equal("Brushed Metal")
	assert_object(material.albedo_texture).is_same(texture)
	MaterialPresets.apply(material, "Car Paint", history)
	assert_bool(material.anisotropy_enabled).is_false()
	assert_bool(material.clearcoat_enabled).is_true()
	Kit.get_history(material).undo()
	assert_str(MaterialPresets.find_name(material)).is_equal("Brushed Metal")
	Kit.get_history(material).undo()
	assert_float(material.roughness).is_equal(0.77)
	assert_bool(material.anisotropy_enabled).is_false()
	Kit.get_history(material).redo()
	assert_str(MaterialPresets.find_name(material)).is_equal("Brushed Metal")


func test_the_inspector_has_a_row() -> void:
	var material := LobeMaterial3D.new()
	Kit.get_plugin(get_tree())
	EditorInterface.edit_resource(material)
	var find := func() -> Array[Node]:
		return Kit.find_all(EditorInterface.get_inspector(), PresetChoice)
	await Kit.wait_until(get_tree(), func() -> bool: return find.call().size() == 1)
	var choice: OptionButton = find.call()[0]
	assert_int(choice.selected).is_equal(0)
	for index in choice.item_count:
		if choice.get_item_text(index) == "Gold":
			choice.select(index)
			choice.item_selected.emit(index)
	assert_str(MaterialPresets.find_name(material)).is_equal("Gold")
	material.roughness = 0.9
	assert_int(choice.selected).is_equal(0)
	EditorInterface.edit_resource(null)
