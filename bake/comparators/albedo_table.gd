extends RefCounted
## Directional albedos for albedo_table.gdshaderinc, by the quadrature of [LobeBaker].

const _ELEVATIONS := 32
const _AZIMUTHS := 9


## The shader's parameters.
static func get_parameters(
	brdf: String, alpha: PackedFloat64Array
) -> Dictionary[StringName, Variant]:
	var rows := 1 if alpha[0] == alpha[1] else _AZIMUTHS
	var image := Image.create_empty(_ELEVATIONS, rows, false, Image.FORMAT_RH)
	for row in rows:
		var azimuth := 0.5 * PI * row / maxf(rows - 1, 1)
		for column in _ELEVATIONS:
			var rest := 1.0 - float(column) / (_ELEVATIONS - 1)
			var elevation := LobeTable.MAX_VIEW_ANGLE * (1.0 - rest * rest)
			var across := Vector2.from_angle(azimuth) * sin(elevation)
			var view := Vector3(across.x, across.y, cos(elevation))
			var albedo: float = ClassDB.class_call_static(
				&"LobeBaker", &"directional_albedo", brdf, Vector2(alpha[0], alpha[1]), view
			)
			image.set_pixel(column, row, Color(albedo, 0.0, 0.0))
	return {
		&"albedo_table": ImageTexture.create_from_image(image),
		&"albedo_lookup":
		Vector4(1.0 / LobeTable.MAX_VIEW_ANGLE, 2.0 / PI, 0.5 / _ELEVATIONS, 0.5 / rows),
	}
