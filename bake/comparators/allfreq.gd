extends ComparisonMethod
## `allfreq<N>`: the density of the normals as N spherical Gaussians, warped into lobes of light,
## Wang et al. 2009, "All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance"; see
## allfreq.gdshaderinc.
##
## One lobe has the sharpness 2 / (alpha_x alpha_y), which is the paper's for isotropic Ward and
## Cook-Torrance (2 / m²) and, of all Gaussians, the nearest to an anisotropic one in the mean
## square. Its integral is that of the density. Eight are fitted to the slice at normal incidence by
## expectation maximisation, which strings them along the wider axis, where the paper fits by
## non-linear optimisation.

const ComparisonSphere := preload("comparison_sphere.gd")
const Microfacet := preload("microfacet.gd")

var lobes: int

var _light: LobeLight
var _filter := ""
# By lobe: the half-vector and 4 / sharpness; the integral.
var _lobes := PackedVector4Array()
var _weights := PackedFloat32Array()


static func make(count: int) -> ComparisonMethod:
	var method := new()
	method.lobes = count
	return method


func prepare(stage: ComparisonStage) -> String:
	var problem := Microfacet.find_problem(name, brdf)
	if problem.is_empty():
		problem = _place_one() if lobes == 1 else _fit()
	if not problem.is_empty():
		return problem
	_filter = stage.filter
	_light = await stage.light(_filter)
	return "" if _light != null else "the renderer did not draw the pyramid."


func make_sphere() -> MeshInstance3D:
	var defines := Microfacet.get_defines(brdf, alpha)
	defines.append("ALLFREQ_LOBES %d" % lobes)
	var parameters := {&"microfacet_alpha": Vector2(alpha[0], alpha[1])}
	if lobes == 1:
		parameters[&"allfreq_lobe"] = Vector2(_weights[0], _lobes[0].w)
	else:
		parameters[&"allfreq_lobes"] = _lobes
		parameters[&"allfreq_weights"] = _weights
	return ComparisonSphere.make(
		"allfreq.gdshaderinc", "allfreq_specular", defines, parameters, _light
	)


## One environment fetch a lobe; the lobes come from uniforms.
func cost() -> Dictionary:
	return {"fetches": lobes, "probes": lobes, "table_fetches": 0}


func settings() -> Dictionary:
	var fitted := "closed form" if lobes == 1 else "expectation maximisation at normal incidence"
	return {"pyramid": _filter, "face_size": _light.size, "normals": fitted}


func _place_one() -> String:
	_lobes = [Vector4(0.0, 0.0, 1.0, 2.0 * alpha[0] * alpha[1])]
	_weights = [Microfacet.normals_integral(brdf, alpha)]
	return ""


# A lobe of light at normal incidence, of sharpness kappa and weight w about 2 h_z h - n, is one of
# half-vectors of sharpness 4 h_z kappa about h, and of the integral w / S.
func _fit() -> String:
	var baked: Dictionary = (
		NativeLibrary
		. create(&"LobeBaker")
		. call(
			"bake",
			{
				"brdf": brdf,
				"alpha": Array(alpha),
				"lobes": lobes,
				"method": "independent",
				"views": [2, 1 if alpha[0] == alpha[1] else 2],
			}
		)
	)
	if baked.has("error"):
		return baked["error"]
	_lobes.clear()
	_weights.clear()
	for lobe in LobeTable.from_baked(baked).lobes_at(Vector3.BACK):
		var mean: Vector3 = lobe["mean"]
		var h := (mean + Vector3.BACK).normalized()
		_lobes.append(Vector4(h.x, h.y, h.z, 1.0 / (h.z * (lobe["kappa"] as float))))
		var share := Microfacet.share_at_normal(brdf, alpha, h)
		_weights.append((lobe["weight"] as float) / share if share > 0.0 else 0.0)
	return ""
