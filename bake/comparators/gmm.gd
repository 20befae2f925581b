extends ComparisonMethod
## `gmm<N>`: this project's own, N lobes of a [LobeTable]; `gmm<N>r` refines them.

const RoomProbe := preload("room_probe.gd")

var lobes: int
var refine: bool
## In a room, whether its light comes from infinitely far away.
var is_flat: bool
var table: LobeTable

var _filter := ""
var _face_size := 0
var _probe: RoomProbe
var _sphere: MeshInstance3D


static func make(count: int, is_refined: bool, flat: bool) -> ComparisonMethod:
	var method := new()
	method.lobes = count
	method.refine = is_refined
	method.is_flat = flat
	return method


func prepare(stage: ComparisonStage) -> String:
	var recipe := {"brdf": brdf, "alpha": Array(alpha), "lobes": lobes, "refine": refine}
	if stage.table_views != Vector2i.ZERO:
		recipe["views"] = [stage.table_views.x, stage.table_views.y]
	var baked := await stage.bake(recipe, name)
	if baked.has("error"):
		return baked["error"]
	table = baked["table"]
	return await _prepare_room(stage) if room != null else await _prepare_panorama(stage)


func make_sphere() -> MeshInstance3D:
	_sphere = SphereImpostor.make(table)
	if is_flat:
		(_sphere.mesh.surface_get_material(0) as LobeMaterial3D).light = _probe.get_flat_light()
	return _sphere


func choose_world(viewport: LinearViewport) -> void:
	if room != null:
		_probe.enter(viewport)


func set_up_viewport(viewport: LinearViewport) -> void:
	if room != null:
		_probe.part(viewport, _sphere)


func _prepare_panorama(stage: ComparisonStage) -> String:
	_filter = stage.filter
	var failure := await stage.light_materials()
	energy = stage.energy
	_face_size = stage.face_size()
	return failure


func _prepare_room(stage: ComparisonStage) -> String:
	var captured := await stage.room_probe()
	_probe = captured.get("probe")
	if is_flat and _probe != null and _probe.get_flat_light() == null:
		return "the probe's light cannot be read."
	return captured.get("error", "")


## One environment fetch and one table fetch a lobe, two where lobes have second texels; the fetches
## are isotropic, so the sampler probes once for each.
func cost() -> Dictionary:
	var table_fetches := 2 * lobes if table.has_second_texels() else lobes
	return {"fetches": lobes, "probes": lobes, "table_fetches": table_fetches}


func settings() -> Dictionary:
	if room != null:
		return {
			"views": [table.views.x, table.views.y],
			"table_bytes": table.image.get_data().size(),
			"light": "a LobeProbe3D's" + (", without its box" if is_flat else ""),
		}
	return {
		"views": [table.views.x, table.views.y],
		"table_bytes": table.image.get_data().size(),
		"pyramid": _filter,
		"face_size": _face_size,
	}
