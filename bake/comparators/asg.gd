extends ComparisonMethod
## `asg`: the density of the normals as one anisotropic spherical Gaussian, warped into the light,
## Xu et al. 2013, "Anisotropic Spherical Gaussians"; see asg.gdshaderinc for how it meets the
## environment here.

const ComparisonSphere := preload("comparison_sphere.gd")
const EnvironmentLight := preload("res://addons/lobelight/runtime/environment_light.gd")
const LineLobes := preload("line_lobes.gd")
const Microfacet := preload("microfacet.gd")
## Along the longer axis.
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
	var parameters := LineLobes.get_parameters(LOBES, false)
	parameters[&"microfacet_alpha"] = Vector2(alpha[0], alpha[1])
	parameters[&"asg_weight"] = Microfacet.normals_integral(brdf, alpha)
	return ComparisonSphere.make(
		"asg.gdshaderinc", "asg_specular", Microfacet.get_defines(self), parameters, _light
	)


## One environment fetch a round lobe.
func cost() -> Dictionary:
	return {"fetches": LOBES, "probes": LOBES, "table_fetches": 0}


func settings() -> Dictionary:
	return {
		"pyramid": _filter,
		"face_size": _light.size,
		"environment": "round lobes along the longer axis, not the paper's sum of Gaussians",
	}
