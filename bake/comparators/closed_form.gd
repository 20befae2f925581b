extends ComparisonMethod
## `closed8`: eight lobes along the highlight with weights in closed form, without a table; see
## closed_form.gdshaderinc.

const ComparisonSphere := preload("comparison_sphere.gd")
const EnvironmentLight := preload("res://addons/lobelight/runtime/environment_light.gd")
const LineLobes := preload("line_lobes.gd")
const Microfacet := preload("microfacet.gd")
const LOBES := 8

var _light: EnvironmentLight
var _filter := ""


func prepare(stage: ComparisonStage) -> String:
	var problem := Microfacet.find_problem(self)
	if not problem.is_empty():
		return problem
	_filter = stage.filter
	_light = await stage.light(_filter)
	return "" if _light != null else "the renderer did not draw the pyramid."


func make_sphere() -> MeshInstance3D:
	var parameters := LineLobes.get_parameters(LOBES, brdf == "ggx")
	parameters[&"microfacet_alpha"] = Vector2(alpha[0], alpha[1])
	return ComparisonSphere.make(
		"closed_form.gdshaderinc",
		"closed_form_specular",
		Microfacet.get_defines(self),
		parameters,
		_light
	)


## One environment fetch a lobe.
func cost() -> Dictionary:
	return {"fetches": LOBES, "probes": LOBES, "table_fetches": 0}


func settings() -> Dictionary:
	return {"pyramid": _filter, "face_size": _light.size}
