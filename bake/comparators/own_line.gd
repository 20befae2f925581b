extends ComparisonMethod
## `line<N>`: this project's own, N lobes along the highlight, computed without a table; `auto`: as
## many lobes as a [LobeMaterial3D] draws by itself, from the ready sets and without.

const LineChoice := preload("res://addons/lobelight/runtime/material/line_choice.gd")
const _SETS := "res://addons/lobelight/tables/%s_8.res"

## 0: as many as it takes.
var lobes: int

var _material := SphereImpostor.new()
var _filter := ""
var _face_size := 0


static func make(count: int) -> ComparisonMethod:
	var method := new()
	method.lobes = count
	return method


func prepare(stage: ComparisonStage) -> String:
	var widths := Vector2(alpha[0], alpha[1])
	_material.metallic = 1.0
	if lobes > 0:
		if not LineChoice.MODELS.has(brdf):
			return "%s is not drawn without a table." % brdf
		_material.show_line(brdf, widths, lobes)
	else:
		if not ResourceLoader.exists(_SETS % brdf):
			return "there is no ready set of %s." % brdf
		_material.table_set = load(_SETS % brdf)
		_material.show_widths(widths)
	_filter = stage.filter
	var failure := await stage.light_materials()
	energy = stage.energy
	_face_size = stage.face_size()
	return failure


func make_sphere() -> MeshInstance3D:
	return SphereImpostor.make_quad(_material)


func cost() -> Dictionary:
	var fetches := _material.get_fetches()
	return {
		"fetches": fetches["environment"],
		"probes": fetches["environment"],
		"table_fetches": fetches["table"]
	}


func settings() -> Dictionary:
	return {"pyramid": _filter, "face_size": _face_size}
