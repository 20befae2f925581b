@tool
extends Object
## Looks to start a [LobeMaterial3D] from: the few properties that make each of them. Guesses by
## eye, not measurements.

# What every look says, so that nothing of the one before stays.
const _PLAIN: Dictionary[StringName, Variant] = {
	&"albedo_color": Color.WHITE,
	&"metallic": 0.0,
	&"metallic_specular": 0.5,
	&"roughness": 0.5,
	&"clearcoat_enabled": false,
	&"clearcoat": 1.0,
	&"clearcoat_roughness": 0.5,
	&"anisotropy_enabled": false,
	&"anisotropy": 0.0,
	&"anisotropy_rotation": 0.0,
	&"sheen_enabled": false,
	&"table": null,
}
const _LIST: Dictionary[String, Dictionary] = {
	"Brushed Metal":
	{
		&"albedo_color": Color(0.91, 0.92, 0.92),
		&"metallic": 1.0,
		&"roughness": 0.4,
		&"anisotropy_enabled": true,
		&"anisotropy": 0.95,
	},
	"Polished Metal":
	{&"albedo_color": Color(0.91, 0.92, 0.92), &"metallic": 1.0, &"roughness": 0.12},
	"Gold": {&"albedo_color": Color(1.0, 0.86, 0.57), &"metallic": 1.0, &"roughness": 0.25},
	"Turned Copper":
	{
		&"albedo_color": Color(0.98, 0.82, 0.76),
		&"metallic": 1.0,
		&"roughness": 0.3,
		&"anisotropy_enabled": true,
		&"anisotropy": 1.0,
		&"anisotropy_rotation": 0.5 * PI,
	},
	"Car Paint":
	{
		&"albedo_color": Color(0.65, 0.05, 0.06),
		&"metallic": 0.5,
		&"roughness": 0.45,
		&"clearcoat_enabled": true,
		&"clearcoat_roughness": 0.05,
	},
	"Plastic": {&"albedo_color": Color(0.2, 0.4, 0.75), &"roughness": 0.35},
	"Rubber":
	{&"albedo_color": Color(0.12, 0.12, 0.12), &"metallic_specular": 0.4, &"roughness": 0.8},
	"Satin Cloth":
	{
		&"albedo_color": Color(0.6, 0.25, 0.4),
		&"metallic_specular": 0.8,
		&"roughness": 0.5,
		&"anisotropy_enabled": true,
		&"anisotropy": 0.85,
	},
	"Velvet":
	{
		&"albedo_color": Color(0.3, 0.03, 0.08),
		&"roughness": 1.0,
		&"sheen_enabled": true,
		&"sheen_color": Color(0.9, 0.4, 0.5),
		&"sheen_roughness": 0.5,
	},
	"Varnished Wood":
	{
		&"albedo_color": Color(0.5, 0.3, 0.15),
		&"roughness": 0.5,
		&"anisotropy_enabled": true,
		&"anisotropy": 0.6,
		&"clearcoat_enabled": true,
		&"clearcoat_roughness": 0.2,
	},
	"Hair":
	{
		&"albedo_color": Color(0.35, 0.22, 0.13),
		&"metallic_specular": 0.55,
		&"roughness": 0.4,
		&"anisotropy_enabled": true,
		&"anisotropy": -1.0,
	},
}


static func get_names() -> PackedStringArray:
	return PackedStringArray(_LIST.keys())


## All properties that the look sets, with their values.
static func find(name: String) -> Dictionary[StringName, Variant]:
	var properties := _PLAIN.duplicate()
	properties.merge(_LIST[name], true)
	return properties


## The look that a material has, or none.
static func find_name(material: LobeBaseMaterial3D) -> String:
	for name in _LIST:
		if get_changes(material, name).is_empty():
			return name
	return ""


## What would change in a material.
static func get_changes(
	material: LobeBaseMaterial3D, name: String
) -> Dictionary[StringName, Variant]:
	var changes: Dictionary[StringName, Variant] = {}
	var properties := find(name)
	for property in properties:
		var before: Variant = material.get(property)
		var after: Variant = properties[property]
		if not is_same(before, after) and before != after:
			changes[property] = after
	return changes


## Gives a material the look, as one step of the undo history.
static func apply(
	material: LobeBaseMaterial3D, name: String, history: EditorUndoRedoManager
) -> void:
	var changes := get_changes(material, name)
	if changes.is_empty():
		return
	history.create_action("Look of Material: %s" % name, UndoRedo.MERGE_DISABLE, material)
	for property in changes:
		history.add_do_property(material, property, changes[property])
		history.add_undo_property(material, property, material.get(property))
	history.add_do_method(material, &"notify_property_list_changed")
	history.add_undo_method(material, &"notify_property_list_changed")
	history.commit_action()
