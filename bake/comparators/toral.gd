extends ComparisonMethod
## `toral<N>`: N lobes as in Töral 2015, "Real-time rendering on mobile graphics using Gaussian
## mixture models": every view fitted by itself, the nearest view's lobes, their axes in spherical
## coordinates, a dual-paraboloid map with 2 × 2 means; see toral.gdshaderinc.

const ComparisonSphere := preload("comparison_sphere.gd")
const DualParaboloidMap := preload("dual_paraboloid_map.gd")
## Views where the command says nothing: elevations × azimuths of one quadrant. The thesis does not
## give them. Twice as many isotropic ones are no better; of the others, 16 × 8 are 7 dB worse at
## (0.05, 0.2), 96 × 48 are 0.7 dB better.
const ISOTROPIC_VIEWS := Vector2i(64, 1)
const ANISOTROPIC_VIEWS := Vector2i(64, 32)

var lobes: int
var coverage: float
## The fitted lobes before they become a texture.
var table: LobeTable

var _map: DualParaboloidMap
var _lobe_texture: ImageTexture


static func make(count: int) -> ComparisonMethod:
	var method := new()
	method.lobes = count
	return method


func prepare(stage: ComparisonStage) -> String:
	var views := stage.toral_views
	if views == Vector2i.ZERO:
		views = ISOTROPIC_VIEWS if alpha[0] == alpha[1] else ANISOTROPIC_VIEWS
	var recipe := {
		"brdf": brdf,
		"alpha": Array(alpha),
		"lobes": lobes,
		"method": "independent",
		"views": [views.x, views.y],
	}
	var baked := await stage.bake(recipe, name)
	if baked.has("error"):
		return baked["error"]
	return await use(baked["table"], stage)


## As [method prepare], with lobes that are there already.
func use(fitted: LobeTable, stage: ComparisonStage) -> String:
	coverage = stage.toral_coverage
	table = fitted
	_lobe_texture = ImageTexture.create_from_image(make_lobe_image(table))
	_map = await stage.dual_paraboloid_map()
	return "" if _map != null else "the renderer did not draw the dual-paraboloid map."


func make_sphere() -> MeshInstance3D:
	var defines: PackedStringArray = ["TORAL_LOBES %d" % lobes]
	if table.is_isotropic():
		defines.append("MICROFACET_ISOTROPIC")
	var last := Vector2(table.views - Vector2i.ONE)
	var per_radian := Vector2(1.0 / LobeTable.MAX_VIEW_ANGLE, last.y / (0.5 * PI))
	# Eq. 2.9 to 2.12 without what depends on the lobe; the map has w = h = side.
	var texels := float(_map.side * _map.side) / (4.0 * _map.SCALE_FACTOR * _map.SCALE_FACTOR)
	var level := 0.5 * log(-TAU * log(1.0 - coverage) * texels) / log(2.0)
	return (
		ComparisonSphere
		. make(
			"toral.gdshaderinc",
			"toral_specular",
			defines,
			{
				&"toral_lobes": _lobe_texture,
				&"toral_map": _map.texture,
				&"toral_grid": Vector4(per_radian.x, per_radian.y, last.x, last.y),
				&"toral_constants": Vector2(0.5 / _map.SCALE_FACTOR, level),
			}
		)
	)


## One environment fetch and one table fetch a lobe.
func cost() -> Dictionary:
	return {"fetches": lobes, "probes": lobes, "table_fetches": lobes}


func settings() -> Dictionary:
	return {
		"coverage": coverage,
		"views": [table.views.x, table.views.y],
		"map_size": [_map.side, _map.side],
		"scale_factor": _map.SCALE_FACTOR,
	}


## The texture (view j, lobe k) of the thesis: weight, kappa, polar angle and azimuth of the mean.
## Views run through the elevations first.
static func make_lobe_image(source: LobeTable) -> Image:
	var views := source.views
	var image := Image.create_empty(views.x * views.y, source.lobe_count, false, Image.FORMAT_RGBAF)
	for azimuth in views.y:
		for elevation in views.x:
			var lobes_of_view := source.lobes_at(source.get_view(elevation, azimuth))
			for k in source.lobe_count:
				var lobe := lobes_of_view[k]
				var mean: Vector3 = lobe["mean"]
				var texel := Color(
					lobe["weight"],
					lobe["kappa"],
					atan2(Vector2(mean.x, mean.y).length(), mean.z),
					atan2(mean.y, mean.x)
				)
				image.set_pixel(azimuth * views.x + elevation, k, texel)
	return image
