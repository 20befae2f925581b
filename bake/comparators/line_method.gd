extends ComparisonMethod
## What `asg` and `closed8` share: round lobes along the highlight, see line_lobes.gdshaderinc, on
## the project's own pyramid, without a table.

const ComparisonSphere := preload("comparison_sphere.gd")
const LineLobes := preload("line_lobes.gd")
const Microfacet := preload("microfacet.gd")
## Along the longer axis.
const LOBES := 8

var _light: LobeLight
var _filter := ""


func prepare(stage: ComparisonStage) -> String:
	var problem := Microfacet.find_problem(name, brdf)
	if not problem.is_empty():
		return problem
	_filter = stage.filter
	_light = await stage.light(_filter)
	return "" if _light != null else "the renderer did not draw the pyramid."


## One environment fetch a round lobe.
func cost() -> Dictionary:
	return {"fetches": LOBES, "probes": LOBES, "table_fetches": 0}


func settings() -> Dictionary:
	return {"pyramid": _filter, "face_size": _light.size}


## The sphere drawn by [param function] of [param path], with what line_lobes.gdshaderinc needs for
## the slopes of GGX or of Ward and with [param own] parameters.
func _make_line_sphere(
	path: String, function: String, is_ggx: bool, own: Dictionary[StringName, Variant] = {}
) -> MeshInstance3D:
	var parameters := LineLobes.get_parameters(LOBES, is_ggx)
	parameters[&"microfacet_alpha"] = Vector2(alpha[0], alpha[1])
	parameters.merge(own)
	return ComparisonSphere.make(
		path, function, Microfacet.get_defines(brdf, alpha), parameters, _light
	)
