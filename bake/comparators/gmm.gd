extends ComparisonMethod
## `gmm<N>`: this project's own, N lobes of a [LobeTable]; `gmm<N>r` refines them.

var lobes: int
var refine: bool
var table: LobeTable

var _filter := ""
var _face_size := 0


static func make(count: int, is_refined: bool) -> ComparisonMethod:
	var method := new()
	method.lobes = count
	method.refine = is_refined
	return method


func prepare(stage: ComparisonStage) -> String:
	var recipe := {"brdf": brdf, "alpha": Array(alpha), "lobes": lobes, "refine": refine}
	if stage.table_views != Vector2i.ZERO:
		recipe["views"] = [stage.table_views.x, stage.table_views.y]
	_filter = stage.filter
	var baked := await stage.bake(recipe, name)
	if baked.has("error"):
		return baked["error"]
	table = baked["table"]
	var failure := await stage.light_materials()
	_face_size = stage.face_size()
	return failure


func make_sphere() -> MeshInstance3D:
	return SphereImpostor.make(table)


## One environment fetch and one table fetch a lobe, two where lobes have second texels; the fetches
## are isotropic, so the sampler probes once for each.
func cost() -> Dictionary:
	var table_fetches := 2 * lobes if table.has_second_texels() else lobes
	return {"fetches": lobes, "probes": lobes, "table_fetches": table_fetches}


func settings() -> Dictionary:
	return {
		"views": [table.views.x, table.views.y],
		"table_bytes": table.image.get_data().size(),
		"pyramid": _filter,
		"face_size": _face_size,
	}
