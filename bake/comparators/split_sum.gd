extends ComparisonMethod
## `splitsum`: one fetch in a map that is filtered for this very width, times the exact albedo,
## Karis 2013, "Real Shading in Unreal Engine 4"; with a bent normal where the widths differ, as in
## Filament. See split_sum.gdshaderinc.
##
## It is the best that a split sum can do: engines have one map for all BRDFs and widths, of levels
## between which they interpolate, and an albedo of GGX. A changing environment, or a changing
## width, pays for the filtering, see [method settings].

const AlbedoTable := preload("albedo_table.gd")
const ComparisonSphere := preload("comparison_sphere.gd")
const Microfacet := preload("microfacet.gd")
const PrefilteredMap := preload("prefiltered_map.gd")

var _map: PrefilteredMap
# What the map is filtered for, and the share of the bent normal, with Filament's sign.
var _width := 0.0
var _bend := 0.0


func prepare(stage: ComparisonStage) -> String:
	var problem := Microfacet.find_problem(name, brdf)
	if not problem.is_empty():
		return problem
	# Filament has alpha_x = a (1 + anisotropy), alpha_y = a (1 - anisotropy), sqrt(a) the roughness.
	_width = 0.5 * (alpha[0] + alpha[1])
	var anisotropy := (alpha[0] - alpha[1]) / (alpha[0] + alpha[1])
	_bend = anisotropy * minf(5.0 * sqrt(_width), 1.0)
	# A texel is a sixth of the lobe's deviation or less, where the map can be as large.
	var size := clampi(nearest_po2(ceili(8.0 / _width)), 32, 512)
	_map = await stage.prefiltered_map(brdf, [_width], size)
	return "" if _map != null else "the renderer did not draw the prefiltered map."


func make_sphere() -> MeshInstance3D:
	var parameters := AlbedoTable.get_parameters(brdf, alpha)
	parameters[&"lobelight_environment"] = _map.cubemap
	parameters[&"split_sum_bend"] = _bend
	return ComparisonSphere.make(
		"split_sum.gdshaderinc",
		"split_sum_specular",
		Microfacet.get_defines(brdf, alpha),
		parameters
	)


func cost() -> Dictionary:
	return {"fetches": 1, "probes": 1, "table_fetches": 1}


func settings() -> Dictionary:
	var found := {
		"face_size": _map.size,
		"map_alpha": _width,
		"normal": "bent by %.3f, as in Filament" % _bend if _bend != 0.0 else "the surface's",
	}
	found.merge(_map.get_update_cost())
	return found
