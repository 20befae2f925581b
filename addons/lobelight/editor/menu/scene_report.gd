@tool
extends Object
## What a scene uses of Lobelight and what that costs, in words.

const LightFile := preload("../light/light_file.gd")
const SceneUsage := preload("scene_usage.gd")
const SceneWarnings := preload("../warnings/scene_warnings.gd")
const Wording := preload("../wording.gd")

# A half-float cube map with all its levels: 6 · 8 bytes a texel and a third more.
const _CUBE_BYTES := 64.0


static func describe(root: Node) -> String:
	if root == null:
		return "No scene is open."
	var usage: SceneUsage = SceneUsage.of(root)
	var lines: PackedStringArray = []
	lines.append("Materials: %d" % usage.materials.size())
	for material in usage.materials:
		lines.append("  " + _describe_material(material, usage.materials[material]))
	lines.append("Tables of their own: %d" % usage.tables.size())
	for table in usage.tables:
		lines.append("  " + describe_table(table))
	lines.append("Environments: %d" % usage.environments.size())
	for environment in usage.environments:
		lines.append("  " + _describe_environment(environment, root))
	if not usage.probes.is_empty():
		lines.append("Probes: %d" % usage.probes.size())
	for probe in usage.probes:
		lines.append("  " + _describe_probe(probe, root))
	var warnings := SceneWarnings.of_scene(root)
	if not warnings.is_empty():
		lines.append("To be looked at:")
		for warning in warnings:
			lines.append("  " + warning)
	return "\n".join(lines)


static func describe_table(table: LobeTable) -> String:
	var problem := table.get_problem()
	if problem:
		return "%s: %s" % [_name(table), problem]
	return (
		"%s: %s (%s, %s), %s, %s"
		% [
			_name(table),
			table.brdf,
			String.num(table.alpha.x, 4),
			String.num(table.alpha.y, 4),
			Wording.count(table.lobe_count, "lobe"),
			String.humanize_size(table.image.get_data().size()),
		]
	)


static func _describe_material(material: LobeMaterial3D, nodes: Array) -> String:
	var fetches := material.get_fetches()
	return (
		"%s: %s of the environment and %d of tables a pixel, on %s"
		% [
			_name(material, nodes[0]),
			Wording.count(fetches["environment"], "fetch", "fetches"),
			fetches["table"],
			Wording.count(nodes.size(), "node"),
		]
	)


static func _describe_environment(environment: LobeEnvironment3D, root: Node) -> String:
	var source: String = LobeEnvironment3D.Source.find_key(environment.source)
	var cube := environment.get_cubemap()
	var memory := "no light yet"
	if environment.light != null and environment.light.get_problem().is_empty():
		source = "baked"
		var bytes := LightFile.count_bytes(environment.light)
		memory = "%d texels, %s" % [environment.light.size, String.humanize_size(bytes)]
	elif cube != null:
		memory = _describe_cube(cube.get_width())
	return "%s: %s, %s" % [root.get_path_to(environment), source.to_lower(), memory]


static func _describe_probe(probe: LobeProbe3D, root: Node) -> String:
	var light := probe.light
	if light == null:
		return "%s: captured live" % root.get_path_to(probe)
	return "%s: baked, %s" % [root.get_path_to(probe), _describe_cube(light.size)]


static func _describe_cube(size: int) -> String:
	return "%d texels, %s" % [size, String.humanize_size(int(_CUBE_BYTES * size * size))]


# What a resource has no name for, users know by where it is.
static func _name(resource: Resource, node: Node = null) -> String:
	if not resource.resource_name.is_empty():
		return resource.resource_name
	if resource.resource_path.is_empty() or resource.resource_path.contains("::"):
		return "unnamed" if node == null else "of " + node.name
	return resource.resource_path.get_file()
