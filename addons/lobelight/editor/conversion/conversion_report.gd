@tool
extends Object
## What a conversion does, in words: where each material goes, what is lost, and what stays.

const Plan := preload("conversion_plan.gd")
const SceneConversion := preload("scene_conversion.gd")
const SceneUsage := preload("../menu/scene_usage.gd")
const TextureWarnings := preload("../warnings/texture_warnings.gd")
const Wording := preload("../wording.gd")

# As many nodes of a material are named; the rest is counted.
const _NAMED := 8


## One sentence, and another where the light is missing then.
static func summarise(conversion: SceneConversion) -> String:
	var to_lobes := conversion.plan.converter.to_lobes
	var count := count_materials(conversion)
	if count == 0:
		var whose := "Godot's own" if to_lobes else "Lobelight's"
		return "There is no material of %s to be converted." % whose
	var sentence := "Converted %s." % Wording.count(count, "material")
	if to_lobes and SceneUsage.find_environments(conversion.plan.root).is_empty():
		# The editor cuts notes off that are longer.
		sentence += " Add a LobeEnvironment3D: nothing lights them yet."
	return sentence


## How much there is to do: "3 materials in 12 nodes; 2 instances become editable, 1 file changes".
static func preview(conversion: SceneConversion) -> String:
	var plan := conversion.plan
	var nodes := plan.get_nodes().size() + plan.nodes_in_files
	var text := (
		"%s in %s"
		% [
			Wording.count(count_materials(conversion), "material"),
			Wording.count(nodes, "node"),
		]
	)
	var places: PackedStringArray = []
	if not plan.instances.is_empty():
		var instances := Wording.count(plan.instances.size(), "instance")
		places.append("%s to be made editable" % instances)
	if not conversion.files.files.is_empty():
		var files := Wording.count(conversion.files.files.size(), "file")
		places.append("%s to be changed" % files)
	if not places.is_empty():
		text += "; " + ", ".join(places)
	return text + "."


## How many materials are made, one in two files twice.
static func count_materials(conversion: SceneConversion) -> int:
	var count := conversion.plan.converter.get_made().size()
	for file in conversion.files.files:
		count += file.plan.converter.get_made().size()
	return count


## All of it, line by line.
static func describe(conversion: SceneConversion) -> String:
	var plan := conversion.plan
	var lines: PackedStringArray = [preview(conversion)]
	var scene := plan.root.scene_file_path
	_describe_plan(plan, scene if scene else "this scene", lines)
	if not plan.instances.is_empty():
		lines.append("Editable Children:")
		for instance in plan.instances:
			lines.append("  %s" % plan.root.get_path_to(instance))
	for file in conversion.files.files:
		_describe_plan(file.plan, file.path, lines)
	if not plan.left.is_empty():
		lines.append("Left as they are, or to be looked at:")
		for reason in plan.left:
			lines.append("  %s: %s" % [_list(plan.left[reason]), reason])
	return "\n".join(lines)


static func _describe_plan(plan: Plan, where: String, lines: PackedStringArray) -> void:
	if plan.changes.is_empty():
		return
	lines.append("Built into %s:" % where)
	var users := _find_users(plan)
	var made := plan.converter.get_made()
	for material in made:
		_describe_material(plan, material, made[material], users, lines)
	var copied: PackedStringArray = []
	for change in plan.changes:
		var file := change.get_copied_file()
		if file and file != where and file not in copied:
			copied.append(file)
	for file in copied:
		lines.append("  copied from %s, whose changes no longer reach it" % file)


static func _describe_material(
	plan: Plan,
	material: Material,
	made: Material,
	users: Dictionary[Material, Array],
	lines: PackedStringArray
) -> void:
	var origin := material.resource_path.get_slice("::", 0)
	var line := "  " + Plan.name_of(material)
	if origin and origin != plan.root.scene_file_path:
		line += " of %s" % origin
	lines.append(line + ", on " + _list(users[material]))
	var losses := plan.converter.get_losses(material)
	if not losses.is_empty():
		lines.append("    lost: " + ", ".join(losses))
	if made is LobeMaterial3D:
		for warning in TextureWarnings.of(made as LobeMaterial3D):
			lines.append("    " + warning)


# The paths of the nodes that show a material, in a next pass too.
static func _find_users(plan: Plan) -> Dictionary[Material, Array]:
	var users: Dictionary[Material, Array] = {}
	for change in plan.changes:
		var path := str(plan.root.get_path_to(change.node))
		for material in change.materials:
			while material != null:
				var paths: Array = users.get_or_add(material, [])
				if paths.is_empty() or paths.back() != path:
					paths.append(path)
				material = material.next_pass
	return users


static func _list(paths: Array) -> String:
	var text := ", ".join(paths.slice(0, _NAMED))
	if paths.size() > _NAMED:
		text += " and %s more" % Wording.count(paths.size() - _NAMED, "node")
	return text
