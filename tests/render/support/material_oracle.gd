extends RefCounted
## What a [LobeMaterial3D] is to show in a radiance of 1 + g·d, from its tables' lobes on the CPU.

const Kit := preload("render_kit.gd")
const GRADIENT := Vector3(0.5, 0.3, -0.4)


## The environment, the same in all channels.
static func light(direction: Vector3) -> Color:
	var value := 1.0 + GRADIENT.dot(direction)
	return Color(value, value, value)


## A set of tables with nothing symmetric about it: few lobes, so that its shader is quickly
## compiled, and every texel component a smooth function of widths and view.
static func make_set(lobes := 2, count := 4) -> LobeTableSet:
	var tables := LobeTableSet.new()
	tables.brdf = "odd"
	tables.lobe_count = lobes
	tables.views = Vector2i(5, 3)
	var widths := PackedFloat64Array()
	for i in count:
		widths.append(0.02 * pow(2.0, 1.5 * i))
	tables.widths = widths
	var rows: Array[PackedFloat64Array] = []
	for x in count:
		for y in x + 1:
			_append_rows(rows, lobes, 3, Vector2(x, y) / (count - 1.0))
	for x in count:
		_append_rows(rows, lobes, 1, Vector2(x, x) / (count - 1.0))
	var image := Image.create_empty(5, rows.size(), false, Image.FORMAT_RGBAH)
	for row in rows.size():
		for t in 5:
			var texel := rows[row].slice(4 * t, 4 * t + 4)
			image.set_pixel(t, row, Color(texel[0], texel[1], texel[2], texel[3]))
	tables.image = image
	return tables


## The light that leaves towards `view`, an equal share in all channels: f0 and f90 are Schlick's
## reflectances; `compensated` as the material does it.
static func reflected(
	table: LobeTable, frame: Basis, view: Vector3, f0: float, f90: float, compensated: bool
) -> float:
	var sums := _sums(table, frame, view)
	var gain := 1.0 + f0 * (1.0 / sums[2] - 1.0) if compensated else 1.0
	return gain * (f0 * sums[0] + (f90 - f0) * sums[1])


## The share of light from all sides that the surface reflects towards `view`. `visible` is the
## share that a lobe gets, from its mean and sharpness; without it, all.
static func share(
	table: LobeTable, view: Vector3, f0: float, f90: float, visible := Callable()
) -> float:
	var sums := _sums(table, Basis.IDENTITY, view, visible)
	return (1.0 + f0 * (1.0 / sums[2] - 1.0)) * (f0 * sums[4] + (f90 - f0) * sums[5])


# Over the lobes: weight · light, weight · x · light, weight, weight · x, x = (1 - o.h)^5; and the
# last two with what is visible of each.
static func _sums(
	table: LobeTable, frame: Basis, view: Vector3, visible := Callable()
) -> PackedFloat64Array:
	var sums := PackedFloat64Array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
	var local := (frame.transposed() * view).normalized()
	for lobe in table.lobes_at(local):
		var mean: Vector3 = lobe["mean"]
		var weight: float = lobe["weight"]
		var left := Kit.mean_cosine(lobe["kappa"])
		var light_seen := 1.0 + left * GRADIENT.dot(frame * mean)
		var x := pow(1.0 - clampf(local.dot((local + mean).normalized()), 0.0, 1.0), 5.0)
		sums[0] += weight * light_seen
		sums[1] += weight * x * light_seen
		sums[2] += weight
		sums[3] += weight * x
		var seen: float = visible.call(mean, lobe["kappa"]) if visible.is_valid() else 1.0
		sums[4] += weight * seen
		sums[5] += weight * x * seen
	return sums


static func _append_rows(
	rows: Array[PackedFloat64Array], lobes: int, azimuths: int, place: Vector2
) -> void:
	for k in lobes:
		for p in azimuths:
			var row := PackedFloat64Array()
			for t in 5:
				var elevation := t / 4.0
				row.append(0.8 * sin(2.0 * k + 1.5 * place.x + elevation) + 0.2 * p)
				# Isotropic tables' lobes lie in the plane of incidence.
				var beside := 0.6 * cos(3.0 * k - 2.0 * place.y + elevation) - 0.1 * p
				row.append(beside if azimuths > 1 else 0.0)
				row.append(3.0 + k + 3.0 * (1.0 - place.x) + 2.0 * (1.0 - place.y) + elevation)
				row.append((0.7 + 0.2 * k + 0.2 * place.x - 0.3 * elevation * place.y) / lobes)
			rows.append(row)
