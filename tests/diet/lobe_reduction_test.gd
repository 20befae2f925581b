extends GdUnitTestSuite
## Materials with the fewest lobes that hold a target: which ones get them, and that what they get
## is what was fitted.

const Diet := preload("res://addons/lobelight/editor/export/diet.gd")
const LobeReduction := preload("res://addons/lobelight/editor/export/lobe_reduction.gd")
const ProjectFiles := preload("res://addons/lobelight/editor/export/project_files.gd")
const ReducedTable := preload("res://addons/lobelight/editor/export/reduced_table.gd")
const TableChoice := preload("res://addons/lobelight/runtime/material/table_choice.gd")

const SCENES := "res://tests/diet/scenes/"
const GGX := "res://addons/lobelight/tables/ggx_8.res"

## Scenes whose materials keep their lobes, and a word of the reason.
const KEPT := [
	["by_script", "scripts"],
	["by_unknown", "scripts"],
	["animated", "scripts"],
	["declared", "scripts"],
	["everything", "texture"],
	["worn", "texture"],
]
## Roughness and anisotropy.
const SURFACES := [[0.3, 0.0], [0.45, 0.7], [0.45, -0.7], [1.0, 0.0], [0.05, 0.0], [0.06, 1.1]]


func _material(roughness: float, anisotropy: float) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = roughness
	material.anisotropy = anisotropy
	material.anisotropy_enabled = true
	# Tables, however long the widths are.
	material.quality = LobeBaseMaterial3D.Quality.LOBES_8
	return material


# Of what is drawn for a material now, and, without the library, a table of one lobe in its place.
func _stand_in(material: LobeMaterial3D) -> ReducedTable:
	var tables: LobeTableSet = load(GGX)
	var drawn := LobeReduction.get_table(tables, material)
	var few := LobeTable.new()
	few.brdf = "ggx"
	few.alpha = drawn.alpha
	few.lobe_count = 1
	few.views = drawn.views
	few.image = Image.create_empty(few.views.x, few.views.y, false, Image.FORMAT_RGBAH)
	for y in few.views.y:
		for x in few.views.x:
			# All azimuths of the first column are the view along the normal.
			few.image.set_pixel(x, y, Color(0.25 * x, 0.0625 * x * y, 3.0 + 0.125 * x, 0.5))
	return ReducedTable.of(few, tables)


# Also where the widths are at the set's ends, or narrower than these.
func test_a_material_draws_the_table_of_its_set_of_one(
	roughness: float, anisotropy: float, _test_parameters := SURFACES
) -> void:
	var material := _material(roughness, anisotropy)
	var reduced := _stand_in(material)
	assert_str(reduced.set_of_one.get_problem()).is_empty()
	var choice := TableChoice.new()
	choice.choose(material)
	var before := choice.table
	material.table_set = reduced.set_of_one
	choice.choose(material)
	assert_int(choice.lobe_count).is_equal(1)
	assert_bool(choice.is_from_set).is_true()
	assert_bool(choice.is_isotropic).is_equal(before.is_isotropic())
	assert_vector(choice.table.alpha).is_equal_approx(before.alpha, 1e-6 * before.alpha)
	for view: Vector3 in [Vector3(0, 0, 1), Vector3(0.6, 0.0, 0.8), Vector3(0.48, 0.64, 0.6)]:
		var seen := view
		if anisotropy < 0.0:
			# The widths are exchanged, and so are the axes.
			seen = Vector3(view.y, view.x, view.z)
		var expected: Dictionary = reduced.table.lobes_at(seen)[0]
		var found: Dictionary = choice.table.lobes_at(view)[0]
		assert_float(found["weight"]).is_equal_approx(expected["weight"], 1e-3)
		assert_float(found["kappa"] / expected["kappa"]).is_equal_approx(1.0, 5e-3)


func test_long_widths_draw_the_table_that_holds_the_target() -> void:
	var material := _material(0.3, 0.9)
	material.quality = LobeBaseMaterial3D.Quality.AUTOMATIC
	var choice := TableChoice.new()
	choice.choose(material)
	assert_object(choice.table).is_null()
	var reduced := _stand_in(material)
	var lobes := LobeReduction.new()
	lobes.tables[LobeReduction._key(load(GGX), LobeReduction.get_table(load(GGX), material))] = reduced
	assert_bool(lobes.edit(material)).is_true()
	choice.choose(material)
	assert_vector(choice.table.alpha).is_equal_approx(reduced.table.alpha, Vector2(1e-6, 1e-6))
	assert_int(choice.lobe_count).is_equal(1)


func test_sets_of_one_are_equal_bytes_and_small() -> void:
	var bytes := _stand_in(_material(0.3, 0.0)).get_bytes()
	assert_int(bytes.size()).is_between(100, 2000)
	assert_array(Array(bytes)).is_equal(Array(_stand_in(_material(0.3, 0.0)).get_bytes()))


func test_without_a_target_nothing_changes() -> void:
	var diet := Diet.of_files(ProjectFiles.of_scene(SCENES + "isotropic.tscn"), 0.0, true, false)
	assert_dict(diet.lobes.tables).is_empty()
	assert_dict(diet.lobes.kept).is_empty()
	assert_bool(diet.shares[GGX].is_left_out()).is_false()


func test_what_is_not_one_table_keeps_its_lobes(
	scene: String, word: String, _test_parameters := KEPT
) -> void:
	var diet := Diet.of_files(ProjectFiles.of_scene(SCENES + scene + ".tscn"), 30.0, true, false)
	assert_dict(diet.lobes.tables).is_empty()
	assert_int(diet.lobes.kept.size()).is_greater(0)
	for reason: String in diet.lobes.kept.values():
		assert_str(reason).contains(word)


func test_a_material_can_say_that_scripts_leave_it_alone() -> void:
	var lobes := LobeReduction.new()
	lobes.target = 10.0
	lobes.why_none = "scripts change widths"
	var material := _material(0.35, 0.0)
	assert_bool(lobes.reduce(SCENES + "isotropic.tscn", material)).is_false()
	material.set_meta(LobeReduction.FIXED, true)
	assert_bool(lobes.reduce(SCENES + "isotropic.tscn", material)).is_true()
	# Imported scenes cannot be changed.
	assert_bool(lobes.reduce("res://imported.glb", material)).is_false()


# Of two materials with the same widths in a scene, the one that scripts may change keeps its set.
func test_only_the_material_that_says_so_gets_the_reduced_set() -> void:
	var lobes := LobeReduction.new()
	lobes.target = 10.0
	lobes.why_none = "scripts change widths"
	var box := BoxMesh.new()
	box.material = _material(0.35, 0.0)
	assert_bool(lobes.reduce(SCENES + "isotropic.tscn", box.material)).is_false()
	var fixed := _material(0.35, 0.0)
	fixed.set_meta(LobeReduction.FIXED, true)
	assert_bool(lobes.reduce(SCENES + "isotropic.tscn", fixed)).is_true()
	assert_bool(lobes.edit(box)).is_false()
	assert_object((box.material as LobeMaterial3D).table_set).is_null()
	assert_bool(lobes.edit(fixed)).is_true()
	assert_object(fixed.table_set).is_not_null()


# Narrow widths that sets tell apart, by a third of a per cent, have a table each.
func test_neighbouring_widths_do_not_share_a_table() -> void:
	var lobes := LobeReduction.new()
	lobes.target = 5.0
	var paths: Array[String] = []
	for roughness: float in [0.072, 0.0722]:
		var material := _material(roughness, 0.0)
		assert_bool(lobes.reduce(SCENES + "isotropic.tscn", material)).is_true()
		assert_bool(lobes.edit(material)).is_true()
		paths.append(material.table_set.resource_path)
		var choice := TableChoice.new()
		choice.choose(material)
		assert_float(choice.table.directional_albedo(Vector3(0.0, 0.0, 1.0))).is_greater(0.9)
	assert_int(lobes.tables.size()).is_equal(2)
	assert_str(paths[0]).is_not_equal(paths[1])


# The BRDF itself is the judge: fewer lobes are further from it than more, and near it still.
func test_the_fewest_lobes_are_fitted_and_the_set_goes() -> void:
	var path := SCENES + "isotropic.tscn"
	var diet := Diet.of_files(ProjectFiles.of_scene(path), 28.0, true, false)
	assert_int(diet.lobes.tables.size()).is_equal(1)
	var reduced: ReducedTable = diet.lobes.tables.values()[0]
	assert_int(reduced.table.lobe_count).is_between(2, 7)
	assert_float(reduced.psnr).is_greater_equal(28.0)
	assert_bool(diet.shares[GGX].is_left_out()).is_true()
	var albedo: float = LobeBaker.new().directional_albedo(
		"ggx", reduced.table.alpha, Vector3(0.6, 0.0, 0.8)
	)
	assert_float(reduced.table.directional_albedo(Vector3(0.6, 0.0, 0.8))).is_equal_approx(
		albedo, 0.01
	)
	var report: Dictionary = diet.to_dictionary()
	assert_int(report["lobes"][0]["lobes"]).is_equal(reduced.table.lobe_count)
	assert_int(report["lobes"][0]["lobes_before"]).is_equal(8)
	# A lower target, no more lobes.
	var few := Diet.of_files(ProjectFiles.of_scene(path), 10.0, true, false)
	var least: ReducedTable = few.lobes.tables.values()[0]
	assert_int(least.table.lobe_count).is_less(reduced.table.lobe_count)


func test_a_target_out_of_reach_keeps_the_set() -> void:
	var diet := Diet.of_files(ProjectFiles.of_scene(SCENES + "isotropic.tscn"), 46.0, true, false)
	assert_dict(diet.lobes.tables).is_empty()
	assert_str(diet.lobes.kept.values()[0]).contains("out of reach with up to 7 lobes")
	assert_bool(diet.shares[GGX].is_left_out()).is_false()


func test_the_scene_is_exported_with_the_reduced_set() -> void:
	var path := SCENES + "isotropic.tscn"
	var diet := Diet.of_files(ProjectFiles.of_scene(path), 28.0, true, false)
	var reduced: ReducedTable = diet.lobes.tables.values()[0]
	var set_file := reduced.get_path()
	DirAccess.make_dir_recursive_absolute(set_file.get_base_dir())
	_write(set_file, reduced.get_bytes())
	_write("user://reduced.scn", diet.edit(path))
	var scene: Node = auto_free((load("user://reduced.scn") as PackedScene).instantiate())
	var material := _find_material(scene)
	assert_str(material.table_set.resource_path).is_equal(set_file)
	assert_int(material.get_fetches()["table"]).is_equal(reduced.table.lobe_count)
	# The project's own material is as it was.
	var original: Node = auto_free((load(path) as PackedScene).instantiate())
	assert_object(_find_material(original).table_set).is_null()
	DirAccess.remove_absolute("user://reduced.scn")
	DirAccess.remove_absolute(set_file)


# In a file of its own, in a mesh's properties, and in its surfaces, which are a Dictionary.
func test_materials_in_resources_are_exported_with_the_reduced_set() -> void:
	var box := BoxMesh.new()
	box.material = _material(0.35, 0.0)
	var surfaces := ArrayMesh.new()
	surfaces.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, BoxMesh.new().get_mesh_arrays())
	surfaces.surface_set_material(0, _material(0.35, 0.0))
	for resource: Resource in [_material(0.35, 0.0), box, surfaces]:
		var file := "user://reduced_%s.tres" % resource.get_class()
		ResourceSaver.save(resource, file)
		var diet := Diet.of_files(PackedStringArray([file]), 10.0, true, false)
		assert_array(diet.lobes.files.keys()).is_equal([file])
		_write("user://reduced.res", diet.edit(file))
		var dependencies := ResourceLoader.get_dependencies("user://reduced.res")
		var reduced: ReducedTable = diet.lobes.tables.values()[0]
		assert_str(" ".join(dependencies)).contains(reduced.get_path())
		DirAccess.remove_absolute(file)
		DirAccess.remove_absolute("user://reduced.res")


func _find_material(scene: Node) -> LobeMaterial3D:
	for node: MeshInstance3D in scene.find_children("*", "MeshInstance3D"):
		for material: Material in [node.material_override, node.get_active_material(0)]:
			if material is LobeMaterial3D:
				return material
	return null


func _write(path: String, bytes: PackedByteArray) -> void:
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_buffer(bytes)
	file.close()
