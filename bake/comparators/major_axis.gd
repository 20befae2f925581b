extends ComparisonMethod
## `majoraxis<N>`: samples along the BRDF's major axis of a map that is filtered for its minor
## one, Cocco, Zanni and Chermain 2024, "Anisotropic Specular Image-Based Lighting Based on BRDF
## Major Axis Sampling"; see major_axis.gdshaderinc. The authors' visualiser has 8, their
## programme (github.com/iota97/AnisotropyEditor) 32 and a slider from 8 to 64.
##
## It follows the programme's shader step by step: the ellipse of one deviation, its extrema, the
## clamping and shifting, equal weights, the level. Their map has 512 texels a side, which
## changes nothing here (0.1 dB), and is filtered for GGX; this one is for the BRDF that is
## drawn, with level l as wide as alpha = (l / last)² as theirs, and the albedo, which they
## approximate, is exact. A changing environment pays for the map, see [method settings].
##
## What keeps it from the reference, at (0.01, 0.2) on the demo's hall 15.5, 17.4, 17.3 and 16.7
## dB with 8, 16, 32 and 64 samples of Ward: few samples are as wide as their distance, eight
## times the minor width here; many show that the axis is too short. Between one deviation to
## each side are 39 % of a Gaussian's slopes and 33 % of GGX's, and all samples weigh the same.
## With 1.5 deviations 64 samples reach 20.7 dB, with 2 20.3, and 8 samples lose 2 and 3 dB. The
## authors show ratios of some 6:1, beside a bent normal, which is 5 dB and more below.

const AlbedoTable := preload("albedo_table.gd")
const ComparisonSphere := preload("comparison_sphere.gd")
const Microfacet := preload("microfacet.gd")
const PrefilteredMap := preload("prefiltered_map.gd")

## Along the axis: a multiple of 8 up to 64.
var samples := 8

var _map: PrefilteredMap
var _last_level := 0


static func make(count: int) -> ComparisonMethod:
	var method := new()
	method.samples = count
	return method


func prepare(stage: ComparisonStage) -> String:
	var problem := Microfacet.find_problem(name, brdf)
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
	var defines := Microfacet.get_defines(brdf, alpha)
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
