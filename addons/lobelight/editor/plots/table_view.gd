@tool
extends VBoxContainer
## What has been baked into a [LobeTable]: figures, plots for a view, and spheres.

const ErrorMap := preload("error_map.gd")
const FormRow := preload("../bake/form_row.gd")
const LikelihoodPlot := preload("likelihood_plot.gd")
const LobeDisc := preload("lobe_disc.gd")
const Recipe := preload("../bake/bake_recipe.gd")
const SlicePlot := preload("slice_plot.gd")
const SphereComparison := preload("../preview/sphere_comparison.gd")
const Wording := preload("../wording.gd")

## The table that is shown.
var table: LobeTable

var _figures := Label.new()
var _elevation := FormRow.make_number(0.0, 89.0, 0.5, "°")
var _azimuth := FormRow.make_number(0.0, 360.0, 1.0, "°")
var _slice := SlicePlot.new()
var _disc := LobeDisc.new()
var _errors := ErrorMap.new()
var _likelihood := LikelihoodPlot.new()
var _spheres := SphereComparison.new()
var _baked := VBoxContainer.new()
var _is_queued := false
var _is_view_queued := false


static func make(for_table: LobeTable) -> VBoxContainer:
	var view := new()
	view.table = for_table
	view._build()
	return view


func _build() -> void:
	_figures.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	add_child(_figures)
	add_child(_baked)
	_elevation.value = 45.0
	var tooltip := "The view whose lobes are drawn, as an angle from the normal."
	_baked.add_child(FormRow.make("View elevation", _elevation, tooltip))
	tooltip = "The view's azimuth, as an angle from the tangent."
	_baked.add_child(FormRow.make("View azimuth", _azimuth, tooltip))
	# Below each other where the inspector is narrow, which they do not widen.
	var plots := HFlowContainer.new()
	for plot: Control in [_slice, _disc, _errors, _likelihood]:
		plots.add_child(plot)
	_baked.add_child(plots)
	_baked.add_child(_spheres)
	_elevation.value_changed.connect(_queue_view.unbind(1))
	_azimuth.value_changed.connect(_queue_view.unbind(1))
	_errors.view_chosen.connect(show_view)


func _enter_tree() -> void:
	table.changed.connect(_queue_update)
	_update()


func _exit_tree() -> void:
	table.changed.disconnect(_queue_update)


## Draws the plots for a view, its angles in radians.
func show_view(elevation: float, azimuth: float) -> void:
	_elevation.value = rad_to_deg(elevation)
	_azimuth.value = rad_to_deg(azimuth)


## The figures in words.
func get_figures() -> String:
	return _figures.text


func get_slice_plot() -> SlicePlot:
	return _slice


func get_error_map() -> ErrorMap:
	return _errors


func get_spheres() -> SphereComparison:
	return _spheres


# Several properties change at once.
func _queue_update() -> void:
	if not _is_queued:
		_is_queued = true
		_update.call_deferred()


func _update() -> void:
	_is_queued = false
	if not is_inside_tree():
		return
	var problem := table.get_problem()
	_baked.visible = problem.is_empty()
	if problem:
		_figures.text = "Nothing is baked yet." if table.image == null else problem
		return
	var report: Dictionary = {}
	if table.has_meta(Recipe.REPORT_META):
		report = table.get_meta(Recipe.REPORT_META)
	_update_view()
	_errors.show_errors(table, report.get("errors", PackedFloat32Array()))
	_likelihood.show_curve(report.get("first_view_curve", PackedFloat32Array()))
	_spheres.show_table(table, find_brdf(table))
	_figures.text = _describe(report)


# Elevation and azimuth change at once.
func _queue_view() -> void:
	if not _is_view_queued:
		_is_view_queued = true
		_update_view.call_deferred()


# The plots of the chosen view. The others, and the reference, are the same from all views.
func _update_view() -> void:
	_is_view_queued = false
	if not is_inside_tree() or not table.get_problem().is_empty():
		return
	var theta := deg_to_rad(_elevation.value)
	var phi := deg_to_rad(_azimuth.value)
	var view := Vector3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta))
	_slice.show_view(table, find_brdf(table), view)
	_disc.show_view(table, view)


## What the library is to take for the table's BRDF: a model's name or a file; empty if it is not
## known, or gone.
static func find_brdf(of_table: LobeTable) -> String:
	if of_table.brdf in Recipe.MODELS:
		return of_table.brdf
	var recipe: Recipe = Recipe.from_table(of_table)
	return recipe.brdf if recipe.is_measured() and recipe.get_problem().is_empty() else ""


func _describe(report: Dictionary) -> String:
	var isotropic := "isotropic" if table.is_isotropic() else "anisotropic"
	var lines: PackedStringArray = [
		(
			"%s, %s, widths %s × %s"
			% [table.brdf, isotropic, String.num(table.alpha.x, 4), String.num(table.alpha.y, 4)]
		),
		(
			"%s × %d × %d views, %s"
			% [
				Wording.count(table.lobe_count, "lobe"),
				table.views.x,
				table.views.y,
				String.humanize_size(table.image.get_data().size()),
			]
		),
	]
	if not _errors.get_worst() <= 0.0:
		lines.append(
			(
				"Expected error %.1f %% of the light, at the worst view %.1f %%"
				% [100.0 * _errors.get_mean(), 100.0 * _errors.get_worst()]
			)
		)
	if report.has("predicted_psnr"):
		lines.append("%.1f dB without the pyramid" % report["predicted_psnr"])
	if report.has("clamped"):
		(
			lines
			. append(
				(
					"%s negative or not finite; mirror images differ by %.2f %%"
					% [
						Wording.count(report["clamped"], "number"),
						100.0 * (report["asymmetry"] as float),
					]
				)
			)
		)
	return "\n".join(lines)
