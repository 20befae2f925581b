@tool
extends GdUnitTestSuite
## What the inspector draws of a baked table.

const Kit := preload("res://tests/editor/editor_kit.gd")
const LobeDisc := preload("res://addons/lobelight/editor/plots/lobe_disc.gd")
const Mixture := preload("res://addons/lobelight/editor/plots/mixture.gd")
const Recipe := preload("res://addons/lobelight/editor/bake/bake_recipe.gd")
const SphereComparison := preload("res://addons/lobelight/editor/preview/sphere_comparison.gd")
const SphereView := preload("res://addons/lobelight/editor/preview/sphere_view.gd")
const Studio := preload("res://addons/lobelight/editor/preview/studio.gd")
const TableState := preload("res://addons/lobelight/editor/bake/table_state.gd")
const TableView := preload("res://addons/lobelight/editor/plots/table_view.gd")

var _table: LobeTable


func before() -> void:
	Kit.get_plugin(get_tree())
	var recipe := Recipe.new()
	recipe.alpha = Vector2(0.2, 0.4)
	recipe.lobes = 8
	var result := LobeBaker.new().bake(recipe.to_request())
	_table = LobeTable.from_baked(result)
	TableState.describe(_table, result, recipe)


func after() -> void:
	EditorInterface.inspect_object(null)


func _inspect(table: LobeTable) -> TableView:
	EditorInterface.inspect_object(table)
	await await_idle_frame()
	await await_idle_frame()
	var views := Kit.find_all(EditorInterface.get_inspector(), TableView)
	return views[0] if views.size() == 1 else null


func test_curves_of_the_brdf_and_of_the_lobes_agree() -> void:
	var view := await _inspect(_table)
	view.show_view(0.9, 0.3)
	await await_idle_frame()
	await await_idle_frame()
	var slice := view.get_slice_plot().get_slice()
	var mixture := view.get_slice_plot().get_mixture()
	assert_int(mixture.size()).is_equal(slice.size())
	var difference := 0.0
	var sum := 0.0
	for n in slice.size():
		difference += absf(slice[n] - mixture[n])
		sum += slice[n]
	assert_float(sum).is_greater(1.0)
	assert_float(difference / sum).is_less(0.3)


func test_a_mixture_has_the_mass_of_its_weights() -> void:
	# By the midpoint rule in cos theta and the azimuth, over the whole sphere.
	var lobes: Array[Dictionary] = [
		{"weight": 0.7, "mean": Vector3(0.6, 0.0, 0.8), "kappa": 9.0},
		{"weight": 0.2, "mean": Vector3(0.0, 0.0, 1.0), "kappa": 2.0},
	]
	var sum := 0.0
	for i in 64:
		for j in 64:
			var z := (2.0 * i + 1.0) / 64.0 - 1.0
			var phi := TAU * (j + 0.5) / 64.0
			var radius := sqrt(1.0 - z * z)
			sum += Mixture.evaluate(lobes, Vector3(radius * cos(phi), radius * sin(phi), z))
	assert_float(sum * 4.0 * PI / 4096.0).is_equal_approx(0.9, 1e-3)


func test_figures_say_size_and_error() -> void:
	var view := await _inspect(_table)
	assert_str(view.get_figures()).contains("8 lobes × 16 × 8 views")
	assert_str(view.get_figures()).contains(String.humanize_size(_table.image.get_data().size()))
	assert_str(view.get_figures()).contains("Expected error")
	var report: Dictionary = _table.get_meta(Recipe.REPORT_META)
	var worst: float = Array(report["errors"]).max()
	assert_float(view.get_error_map().get_worst()).is_equal_approx(worst, 1e-6)


func test_an_empty_table_says_so() -> void:
	var view := await _inspect(LobeTable.new())
	assert_str(view.get_figures()).is_equal("Nothing is baked yet.")


func test_a_table_without_a_report_is_drawn_without_errors() -> void:
	var table := LobeTable.make_single_lobe()
	var view := await _inspect(table)
	assert_str(view.get_figures()).contains("1 lobe ×")
	assert_float(view.get_error_map().get_worst()).is_equal(0.0)
	assert_int(view.get_slice_plot().get_slice().size()).is_equal(0)


func test_a_click_on_the_error_map_chooses_its_view() -> void:
	var view := await _inspect(_table)
	var map := view.get_error_map()
	var chosen: Array[Vector2] = []
	map.view_chosen.connect(func(e: float, a: float) -> void: chosen.append(Vector2(e, a)))
	var click := InputEventMouseButton.new()
	click.button_index = MOUSE_BUTTON_LEFT
	click.pressed = true
	click.position = map._centre() + Vector2(0.0, -0.5 * map._radius())
	map._gui_input(click)
	assert_int(chosen.size()).is_equal(1)
	# Half-way to the horizon, across the tangent.
	assert_float(chosen[0].x).is_between(0.6, 0.95)
	assert_float(chosen[0].y).is_equal_approx(0.5 * PI, 1e-6)
	click.position = Vector2.ZERO
	map._gui_input(click)
	assert_int(chosen.size()).is_equal(1)


func test_outlines_of_lobes_are_circles_on_the_sphere() -> void:
	for point in LobeDisc.get_outline(Vector3(0.0, 0.6, 0.8), 100.0):
		var on_sphere := Vector3(point.x, -point.y, sqrt(1.0 - point.length_squared()))
		assert_float(on_sphere.angle_to(Vector3(0.0, 0.6, 0.8))).is_equal_approx(0.1, 1e-3)
	assert_int(LobeDisc.get_outline(Vector3(0.0, 0.0, 1.0), 100.0).size()).is_greater(20)


func test_the_reference_is_exposed_and_compared() -> void:
	var size := SphereView.SIZE
	var pixels := PackedFloat32Array()
	pixels.resize(3 * size * size)
	pixels.fill(0.36)
	assert_float(SphereComparison.find_exposure(pixels)).is_equal_approx(0.5, 1e-4)
	var picture := SphereComparison.to_picture(pixels, 0.5)
	# 0.18 in sRGB is 118 of 255.
	@warning_ignore("integer_division")
	var middle := picture.get_pixel(size / 2, size / 2)
	assert_int(middle.r8).is_between(117, 118)
	assert_float(picture.get_pixel(0, 0).a).is_equal(0.0)
	assert_float(SphereComparison.find_psnr(picture, picture)).is_greater(100.0)
	var brighter := SphereComparison.to_picture(pixels, 1.0)
	assert_float(SphereComparison.find_psnr(picture, brighter)).is_between(10.0, 25.0)
	pixels.fill(0.0)
	assert_float(SphereComparison.find_exposure(pixels)).is_equal(0.0)


func test_the_reference_is_rendered_in_the_background() -> void:
	var view := await _inspect(_table)
	var spheres := view.get_spheres()
	(
		assert_bool(
			await Kit.wait_until(get_tree(), func() -> bool: return not spheres._path.is_empty())
		)
		. is_true()
	)
	spheres.samples = 16
	spheres.render_reference()
	assert_str(spheres.get_status()).is_empty()
	assert_object(spheres.get_reference_texture()).is_null()
	var is_there := func() -> bool: return spheres.get_reference_texture() != null
	assert_bool(await Kit.wait_until(get_tree(), is_there, 60.0)).is_true()


# Where nothing changes the editor draws no frame, and the wait would not end.
func test_waiting_for_a_picture_asks_for_each_frame() -> void:
	var sphere: SphereView = auto_free(SphereView.new())
	EditorInterface.get_base_control().add_child(sphere)
	# Before it has been drawn, its texture would show whatever the memory has.
	assert_int(_mode_of(sphere)).is_equal(SubViewport.UPDATE_ALWAYS)
	await await_idle_frame()
	await await_idle_frame()
	var drawn := [0]
	sphere.draw.connect(func() -> void: drawn[0] += 1)
	var is_over := [false]
	var wait := func() -> void:
		await sphere.draw_picture()
		is_over[0] = true
	wait.call()
	for frame in 2:
		await await_idle_frame()
		await await_idle_frame()
		assert_int(drawn[0]).is_equal(frame + 1)
		assert_bool(is_over[0]).is_false()
		RenderingServer.frame_post_draw.emit()
	assert_bool(is_over[0]).is_true()
	assert_int(_mode_of(sphere)).is_equal(SubViewport.UPDATE_WHEN_VISIBLE)


func _mode_of(sphere: SphereView) -> SubViewport.UpdateMode:
	return (
		(sphere.find_children("*", "SubViewport", false, false)[0] as SubViewport)
		. render_target_update_mode
	)


func test_the_inspector_is_not_widened() -> void:
	var view := await _inspect(_table)
	var plot := view.get_error_map().custom_minimum_size.x
	assert_float(view.get_combined_minimum_size().x).is_between(plot, 1.9 * plot)
	assert_float(view.get_spheres().get_combined_minimum_size().x).is_less(1.9 * plot)


func test_a_cancelled_choice_shows_the_one_from_before() -> void:
	var view := await _inspect(_table)
	var spheres := view.get_spheres()
	spheres._path = "res://hall.exr"
	spheres._environment.selected = 0
	spheres._show_choice()
	assert_int(spheres._environment.selected).is_equal(1)
	spheres._path = Studio.find_path()
	spheres._show_choice()
	assert_int(spheres._environment.selected).is_equal(0)
