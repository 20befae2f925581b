extends GdUnitTestSuite
## The size of environments goes with the sharpest lobe, and stays where that is not known.

const Diet := preload("res://addons/lobelight/editor/export/diet.gd")
const EnvironmentFit := preload("res://addons/lobelight/editor/export/environment_fit.gd")
const ProjectFiles := preload("res://addons/lobelight/editor/export/project_files.gd")
const SetReach := preload("res://addons/lobelight/editor/export/set_reach.gd")
const Widths := preload("res://addons/lobelight/runtime/table/widths.gd")
const GGX := "res://addons/lobelight/tables/ggx_8.res"


# The sharper the lobes, the larger the map; no lobes, no size.
func test_environments_are_as_large_as_the_sharpest_lobe_needs() -> void:
	var environment := {"source": LobeEnvironment3D.Source.SKY}
	var sizes: Array[int] = []
	for roughness: float in [0.2, 0.4, 0.8]:
		var reach := SetReach.new()
		reach.add_surface(Widths.from_roughness(roughness, 0.0))
		var fit := EnvironmentFit.of([["scene", environment]], {GGX: reach}, [])
		sizes.append(fit.size)
		assert_str(fit.why).is_not_empty()
	assert_int(sizes[0]).is_equal(0)
	assert_int(sizes[1]).is_less(512)
	assert_int(sizes[2]).is_less(sizes[1])
	assert_int(sizes[2]).is_greater(0)
	assert_int(EnvironmentFit.of([["scene", environment]], {}, []).size).is_equal(0)


func test_environments_stay_where_widths_are_not_known_or_a_size_was_chosen() -> void:
	var reach := SetReach.new()
	reach.add_surface(Vector2(0.5, 0.5))
	var chosen := {"size": 512}
	assert_int(EnvironmentFit.of([["scene", chosen]], {GGX: reach}, []).size).is_equal(0)
	reach.isotropic_because = "a texture"
	assert_int(EnvironmentFit.of([["scene", {}]], {GGX: reach}, []).size).is_equal(0)


func test_a_small_panorama_is_not_enlarged() -> void:
	var reach := SetReach.new()
	reach.add_surface(Vector2(0.25, 0.25))
	var fit := EnvironmentFit.of([["scene", {}]], {GGX: reach}, [])
	var environment: LobeEnvironment3D = auto_free(LobeEnvironment3D.new())
	assert_int(fit.get_size_for(environment)).is_equal(fit.size)
	environment.panorama = ImageTexture.create_from_image(
		Image.create_empty(8, 4, false, Image.FORMAT_RGBAH)
	)
	assert_int(fit.get_size_for(environment)).is_equal(0)
	environment.panorama = null
	environment.size = 1024
	assert_int(fit.get_size_for(environment)).is_equal(0)


func test_a_scene_is_exported_with_the_size() -> void:
	var path := "res://tests/diet/scenes/isotropic.tscn"
	var diet := Diet.of_files(ProjectFiles.of_scene(path), 0.0, true, false)
	assert_int(diet.fit.size).is_greater(0)
	var file := "user://diet_scene.scn"
	var written := FileAccess.open(file, FileAccess.WRITE)
	written.store_buffer(diet.edit(path))
	written.close()
	var scene: Node = auto_free((load(file) as PackedScene).instantiate())
	DirAccess.remove_absolute(file)
	var environment := scene.get_node("Light") as LobeEnvironment3D
	assert_int(environment.size).is_equal(diet.fit.size)
	assert_int(environment.source).is_equal(LobeEnvironment3D.Source.PANORAMA)
	assert_str(environment.panorama.resource_path).ends_with("forest.exr")
	assert_int(diet.edit("res://tests/diet/scenes/everything.tscn").size()).is_equal(0)
