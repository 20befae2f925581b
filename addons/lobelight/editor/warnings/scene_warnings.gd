@tool
extends Object
## What keeps a scene from looking as it could, each in a sentence or two that say what to do.

const EnvironmentWarnings := preload("../../runtime/warnings/environment_warnings.gd")
const ProbeWarnings := preload("../../runtime/warnings/probe_warnings.gd")
const TableChoice := preload("../../runtime/material/table_choice.gd")
const WidthsTexture := preload("../../runtime/table/widths_texture.gd")
const SceneUsage := preload("../menu/scene_usage.gd")
const OwnShaderWarnings := preload("../own_shaders/own_shader_warnings.gd")
const TextureWarnings := preload("texture_warnings.gd")


## All that concerns a scene.
static func of_scene(root: Node) -> PackedStringArray:
	var warnings: PackedStringArray = []
	var usage: SceneUsage = SceneUsage.of(root)
	if usage.environments.is_empty() and not usage.materials.is_empty():
		warnings.append(_without_environment())
	for environment in usage.environments:
		warnings.append_array(of_environment(environment, root))
	for probe in usage.probes:
		for warning in ProbeWarnings.of(probe):
			warnings.append("%s: %s" % [root.get_path_to(probe), warning])
	for material in usage.materials:
		warnings.append_array(_of_properties(material))
	for material in usage.shader_materials:
		for warning in OwnShaderWarnings.of(material):
			var user: Node = usage.shader_materials[material][0]
			warnings.append("%s: %s" % [root.get_path_to(user), warning])
	for instance in usage.without_tangents:
		warnings.append("%s: its mesh has no tangents." % root.get_path_to(instance))
	return warnings


## Of a material as it is used in a scene, which may be null.
static func of_material(material: LobeMaterial3D, root: Node) -> PackedStringArray:
	var warnings := _of_properties(material)
	if root != null and SceneUsage.find_environments(root).is_empty():
		warnings.append(_without_environment())
	return warnings


## Of an environment, as the scene tree shows them too.
static func of_environment(environment: LobeEnvironment3D, root: Node) -> PackedStringArray:
	return EnvironmentWarnings.of(environment, root)


static func _without_environment() -> String:
	return (
		"The scene has no LobeEnvironment3D, so LobeMaterial3Ds show a neutral map: add one, and it "
		+ "takes the light of the scene's sky."
	)


static func _of_properties(material: LobeMaterial3D) -> PackedStringArray:
	var warnings: PackedStringArray = []
	if material.table != null and not material.table.get_problem().is_empty():
		var problem := material.table.get_file_problem()
		if problem.is_empty():
			problem = "The material's table has no lobes yet: open it and press Bake."
		warnings.append(problem)
	if material.table_set != null and not material.table_set.get_problem().is_empty():
		var problem := material.table_set.get_file_problem()
		if problem.is_empty():
			problem = "The material's set of tables cannot be used: choose one of the addon's."
		warnings.append(problem)
	elif material.table == null and material.varies():
		var tables := TableChoice.get_set(material)
		var is_isotropic := material.get_shown_anisotropy() == 0.0
		var problem := ""
		if tables != null:
			problem = WidthsTexture.find_problem(tables.widths, is_isotropic)
		if problem:
			warnings.append("Its textures do not change its lobes: " + problem)
	if (
		EnvironmentWarnings.is_compatibility()
		and material.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_HASH
	):
		warnings.append("Compatibility has no alpha hash and blends instead: take Alpha Scissor.")
	warnings.append_array(TextureWarnings.of(material))
	return warnings
