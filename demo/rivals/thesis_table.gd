extends Object
## The thesis' lobes: one texel (weight, kappa, polar angle, azimuth) for each fitted view and lobe.

const RivalLight := preload("rival_light.gd")
## The share of a lobe that the texels are to cover; as `./dev compare` has it.
const COVERAGE := 0.47

# What has been made of a set is kept with it, as long as a material holds it.
const _KEPT := &"thesis_tables"
const _TEXTURE := &"thesis_texture"


## The table whose widths are nearest: tables of views that were fitted each by itself cannot be
## interpolated.
static func nearest(tables: LobeTableSet, widths: Vector2) -> LobeTable:
	var wide := _nearest_width(tables, widths.x)
	var narrow := _nearest_width(tables, widths.y)
	var key := Vector2i(maxi(wide, narrow), mini(wide, narrow))
	if not tables.has_meta(_KEPT):
		tables.set_meta(_KEPT, {})
	var kept: Dictionary = tables.get_meta(_KEPT)
	if not kept.has(key):
		var table := LobeTable.new()
		table.brdf = tables.brdf
		table.lobe_count = tables.lobe_count
		table.alpha = Vector2(tables.widths[key.x], tables.widths[key.y])
		var is_isotropic := key.x == key.y
		table.views = Vector2i(tables.views.x, 1) if is_isotropic else tables.views
		table.image = (
			tables.get_isotropic_image(key.x)
			if is_isotropic
			else tables.get_pair_image(key.x, key.y)
		)
		kept[key] = table
	return kept[key]


## Views run through the elevations first, lobes through the rows.
static func texture_of(table: LobeTable) -> ImageTexture:
	if not table.has_meta(_TEXTURE):
		var views := table.views
		var count := views.x * views.y
		var image := Image.create_empty(count, table.lobe_count, false, Image.FORMAT_RGBAF)
		for azimuth in views.y:
			for elevation in views.x:
				var lobes := table.lobes_at(table.get_view(elevation, azimuth))
				for k in table.lobe_count:
					image.set_pixel(azimuth * views.x + elevation, k, _texel(lobes[k]))
		table.set_meta(_TEXTURE, ImageTexture.create_from_image(image))
	return table.get_meta(_TEXTURE)


## The shader's toral_grid.
static func grid_of(table: LobeTable) -> Vector4:
	var last := Vector2(table.views - Vector2i.ONE)
	return Vector4(1.0 / LobeTable.MAX_VIEW_ANGLE, last.y / (0.5 * PI), last.x, last.y)


## Eq. 2.9 to 2.11 without what depends on the lobe.
static func level_of(light: RivalLight) -> float:
	var lobe := -TAU * log(1.0 - COVERAGE) * light.box_share()
	return 0.5 * log(lobe * light.size * light.size / 4.0) / log(2.0)


static func _texel(lobe: Dictionary) -> Color:
	var mean: Vector3 = lobe["mean"]
	var side := Vector2(mean.x, mean.y)
	return Color(lobe["weight"], lobe["kappa"], atan2(side.length(), mean.z), side.angle())


static func _nearest_width(tables: LobeTableSet, width: float) -> int:
	var best := 0
	for i in tables.widths.size():
		if absf(log(tables.widths[i] / width)) < absf(log(tables.widths[best] / width)):
			best = i
	return best
