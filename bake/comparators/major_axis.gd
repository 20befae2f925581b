extends ComparisonMethod
## `majoraxis8`: eight samples along the BRDF's major axis of a map that is filtered for its minor
## one, Cocco, Zanni and Chermain 2024, "Anisotropic Specular Image-Based Lighting Based on BRDF
## Major Axis Sampling"; see major_axis.gdshaderinc.
##
## The map is filtered for the BRDF that is drawn, with level l as wide as alpha = (l / last)² as in
## the authors' programme. A changing environment pays for it, see [method settings].

const AlbedoTable := preload("albedo_table.gd")
const ComparisonSphere := preload("comparison_sphere.gd")
const Microfacet := preload("microfacet.gd")
const PrefilteredMap := preload("prefiltered_map.gd")

## Along the axis: 8 or 64.
var samples := 8

var _map: PrefilteredMap
var _last_level := 0


func prepare(stage: ComparisonStage) -> String:
	var problem := Microfacet.find_problem(self)
	if not problem.is_empty():
		return problem
	# Texels half as wide as the panorama's.
	@warning_ignore("integer_division")
	var size := maxi(ComparisonStage.Pyramid.automatic_size(stage.panorama) / 2, 32)
	_last_level = roundi(log(size) / log(2.0))
	var widths := PackedFloat64Array()
	for level in _last_level + 1:
		widths.append(pow(float(level) / _last_level, 2.0))
	_map = await stage.prefiltered_map(brdf, widths, size)
	return "" if _map != null else "the renderer did not draw the prefiltered map."


func make_sphere() -> MeshInstance3D:
	var defines := Microfacet.get_defines(self)
	defines.append("MAJOR_AXIS_SAMPLES %d" % samples)
	var parameters := AlbedoTable.get_parameters(brdf, alpha)
	parameters[&"lobelight_environment"] = _map.cubemap
	parameters[&"major_axis_radii"] = Vector2(alpha[0], alpha[1]) / sqrt(2.0)
	parameters[&"major_axis_last_level"] = float(_last_level)
	return ComparisonSphere.make(
		"major_axis.gdshaderinc", "major_axis_specular", defines, parameters
	)


func cost() -> Dictionary:
	return {"fetches": samples, "probes": samples, "table_fetches": 1}


func settings() -> Dictionary:
	var found := {"face_size": _map.size}
	found.merge(_map.get_update_cost())
	return found
