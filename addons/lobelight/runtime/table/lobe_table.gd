@tool
@icon("../../icons/lobe_table.svg")
class_name LobeTable
extends Resource
## A BRDF as Gaussian lobes, over the view direction.
##
## For each view of a grid the slice BRDF times cosine is a sum of [member lobe_count] spherical
## Gaussians. [LobeMaterial3D] looks one row of them up and fetches the environment once per lobe.
## [LobeBaker] makes tables in the editor; see [method from_baked].
## [br][br]
## Directions are unit vectors in tangent space: x along the tangent, z along the normal. The grid
## has [code]views.x[/code] elevations, from the normal to [constant MAX_VIEW_ANGLE] and denser
## towards it, and [code]views.y[/code] azimuths over one quadrant, the others being its mirror
## images; a table of one azimuth is isotropic.

## The angle between the normal and the last view of the grid, in radians. Beyond it Ward's albedo
## diverges; views beyond it are taken for it.
const MAX_VIEW_ANGLE := deg_to_rad(89.4)

## The largest [member lobe_count].
const MAX_LOBES := 32

const PlaneLobes := preload("plane_lobes.gd")
const SavedForm := preload("saved_form.gd")

## The name of the BRDF that was fitted.
@export var brdf := "":
	set(value):
		brdf = value
		_follow_change()
## Widths of the BRDF along the tangent and the bitangent.
@export var alpha := Vector2(0.1, 0.1):
	set(value):
		alpha = value
		_invalidate()
## Lobes per view.
@export var lobe_count := 0:
	set(value):
		lobe_count = value
		_invalidate()
## Views of the grid: elevations, azimuths.
@export var views := Vector2i.ZERO:
	set(value):
		views = value
		_invalidate()
## How the views were fitted: [code]continuation[/code] or [code]independent[/code].
@export var method := "":
	set(value):
		method = value
		_follow_change()
## The seed of the fit.
@warning_ignore("shadowed_global_identifier") @export var seed := 0:
	set(value):
		seed = value
		_follow_change()
## The lobes, in [constant Image.FORMAT_RGBAH]. Column t holds the views of elevation t, row
## [code]k * views.y + p[/code] lobe k of azimuth p. A texel is (slope_x / alpha_x,
## slope_y / alpha_y, log2(kappa (o.h)), weight), the slopes being those of the half-vector h
## between the view o and the lobe's mean; the weights of a view add up to its albedo.
## [br][br]
## Below these rows there may be as many of second texels, (0, 0, tint_r, tint_b): the weights in
## red, green and blue are the weight times tint_r, 3 - tint_r - tint_b and tint_b.
@export var image: Image:
	set(value):
		image = value
		_invalidate()
## The format of the file; it is written in the newest one. A newer file than this version of
## Lobelight knows is not used, see [method get_problem].
@export_storage var format := 1:
	get:
		return _saved.format
	set(value):
		_saved.format = value
		_invalidate()
## The checksum of all the above, which files have from format 2 on; 0 for none. It is that of the
## table as it is now, but for damaged tables, which keep that of their file.
@export_storage var checksum := 0:
	get:
		return _saved.expected if _saved.expected != 0 else _find_checksum()
	set(value):
		_saved.expected = value
		_invalidate()

var _saved := SavedForm.new()
var _texture: ImageTexture
# Loader threads share tables.
var _mutex := Mutex.new()


## A table from a result of [LobeBaker]; [code]null[/code], and an error, if it is none.
static func from_baked(result: Dictionary) -> LobeTable:
	var baked := image_of_baked(result, "LobeTable.from_baked", "alpha")
	if baked == null:
		return null
	var table := LobeTable.new()
	table.brdf = result["brdf"]
	table.alpha = result["alpha"]
	table.lobe_count = result["lobes"]
	table.views = Vector2i(result["views"])
	table.method = result.get("method", "")
	table.seed = result.get("seed", 0)
	table.image = baked
	# Otherwise random: equal tables are to be saved as equal bytes.
	table.resource_scene_unique_id = "table"
	var problem := table.get_problem()
	if problem:
		push_error("LobeTable.from_baked: " + problem)
		return null
	return table


## The image of a result of [LobeBaker], a table's or, with [param width_key] "widths", a set's;
## [code]null[/code], and an error in the name of [param caller], if the result has none or lacks
## what goes with it.
static func image_of_baked(result: Dictionary, caller: String, width_key: String) -> Image:
	if result.has("error"):
		push_error("%s: the bake failed: %s" % [caller, result["error"]])
		return null
	for key: String in ["brdf", width_key, "lobes", "views", "width", "height", "data"]:
		if not result.has(key):
			push_error('%s: the result has no "%s".' % [caller, key])
			return null
	var width: int = result["width"]
	var height: int = result["height"]
	var data: PackedByteArray = result["data"]
	if width < 1 or height < 1 or data.size() != width * height * 8:
		push_error(
			"%s: %d x %d texels of 8 bytes are not %d bytes." % [caller, width, height, data.size()]
		)
		return null
	var broken := _count_broken(data)
	if broken > 0:
		push_error(
			"%s: numbers that are not finite: %d of %d." % [caller, broken, width * height * 4]
		)
		return null
	var baked := Image.create_from_data(width, height, false, Image.FORMAT_RGBAH, data)
	# Otherwise random: equal results are to be saved as equal bytes.
	baked.resource_scene_unique_id = "lobes"
	return baked


# Half floats whose exponent has all bits set, infinite or not a number: the high byte says so.
static func _count_broken(data: PackedByteArray) -> int:
	var count := 0
	for i in range(1, data.size(), 2):
		if data[i] & 0x7C == 0x7C:
			count += 1
	return count


## A table of one lobe of weight 1 about the mirror direction, as wide as the lobe of a mirror that
## is rough by [param width]: at normal incidence its sharpness is 1 / (2 width²). It stands for
## the table of a material that has none.
static func make_single_lobe(width := 0.2) -> LobeTable:
	var table := LobeTable.new()
	table.brdf = "single"
	table.alpha = Vector2(width, width)
	table.lobe_count = 1
	table.views = Vector2i(2, 1)
	var texels := Image.create_empty(2, 1, false, Image.FORMAT_RGBAH)
	texels.fill(Color(0.0, 0.0, -log(2.0 * width * width) / log(2.0), 1.0))
	table.image = texels
	return table


# What is loaded in place of this may be a file that says nothing of itself, and it leaves out what
# is as by default.
func _reset_state() -> void:
	_saved = SavedForm.new()
	brdf = ""
	alpha = Vector2(0.1, 0.1)
	lobe_count = 0
	views = Vector2i.ZERO
	method = ""
	seed = 0
	image = null


## What keeps the table from being used, in a sentence; empty if nothing does.
func get_problem() -> String:
	var problem := get_file_problem()
	return problem if problem else _find_problem()


func _find_problem() -> String:
	if lobe_count < 1 or lobe_count > MAX_LOBES:
		return "A table has 1 to %d lobes, this one has %d." % [MAX_LOBES, lobe_count]
	if views.x < 2 or views.y < 1:
		return (
			"A table has at least 2 elevations and 1 azimuth, this one has %d and %d."
			% [views.x, views.y]
		)
	if not (alpha.x > 0.0 and alpha.y > 0.0 and alpha.is_finite()):
		return "A table's alpha is positive, this one's is %s." % alpha
	if image == null or image.is_empty():
		return "The table has no image."
	var expected := Vector2i(views.x, views.y * lobe_count)
	if (
		image.get_format() != Image.FORMAT_RGBAH
		or image.get_size() not in [expected, expected * Vector2i(1, 2)]
	):
		return (
			"A table of %d lobes and %d x %d views has an image of %d x %d texels in RGBAH."
			% [lobe_count, views.x, views.y, expected.x, expected.y]
		)
	return ""


## Why the file that the table was loaded from cannot be used, in a sentence: its format is too new,
## or it is damaged. Empty if it can.
func get_file_problem() -> String:
	return _saved.get_problem("table")


## Whether the table is of a BRDF that looks the same from all azimuths.
func is_isotropic() -> bool:
	return views.y <= 1


## Whether the lobes have second texels, which colour them.
func has_second_texels() -> bool:
	return image != null and image.get_height() == 2 * views.y * lobe_count


## The lobes as the shader's texture, one for all who ask, on whatever thread; [code]null[/code]
## while the table is incomplete.
func get_texture() -> Texture2D:
	_mutex.lock()
	if _texture == null and get_problem().is_empty():
		var shown := image
		if is_isotropic():
			shown = PlaneLobes.convert(image, lobe_count, alpha.x, MAX_VIEW_ANGLE)
		_texture = ImageTexture.create_from_image(shown)
	var texture := _texture
	_mutex.unlock()
	return texture


## (scale, offset) from a view's column, in [0, 1], to the texture's u, then from its azimuth in
## radians to the v of lobe 0.
func get_lookup() -> Vector4:
	var columns := PlaneLobes.get_columns(views.x) if is_isotropic() else views.x
	var u_scale := float(columns - 1) / columns
	var height := views.y * lobe_count * (2 if has_second_texels() else 1)
	var v_scale := (views.y - 1) / (0.5 * PI * height)
	return Vector4(u_scale, 0.5 / columns, v_scale, 0.5 / height)


## The column of an elevation in radians, from 0 to [code]views.x - 1[/code]; whole numbers are
## views of the grid.
func get_column(elevation: float) -> float:
	return (1.0 - sqrt(maxf(1.0 - elevation / MAX_VIEW_ANGLE, 0.0))) * (views.x - 1)


## The view of the grid at an elevation and an azimuth, counted from 0.
func get_view(elevation: int, azimuth: int) -> Vector3:
	var rest := 1.0 - float(elevation) / (views.x - 1)
	var theta := MAX_VIEW_ANGLE * (1.0 - rest * rest)
	var phi := 0.0 if is_isotropic() else 0.5 * PI * azimuth / (views.y - 1)
	return Vector3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta))


## The lobes for a view direction in tangent space, interpolated as the shader does it: an array of
## [code]{"weight": float, "mean": Vector3, "kappa": float}[/code]. The slice at a direction i is
## the sum of weight · kappa / (2π (1 − exp(−2 kappa))) · exp(kappa (mean · i − 1)).
## Lobes of coloured tables also have a [code]"tint": Color[/code] that multiplies the weight in
## red, green and blue; its mean is 1.
func lobes_at(view: Vector3) -> Array[Dictionary]:
	var problem := get_problem()
	if problem:
		push_error("LobeTable.lobes_at: " + problem)
		return []
	var clamped := Vector3(view.x, view.y, maxf(view.z, cos(MAX_VIEW_ANGLE))).normalized()
	var side := Vector2(clamped.x, clamped.y)
	var column := get_column(atan2(side.length(), clamped.z))
	if is_isotropic():
		# The table has the view in the x-z plane.
		var turn := side.angle() if side.length() > 1e-5 else 0.0
		return _decode(clamped, column, 0.0, Transform2D(turn, Vector2.ZERO))
	var row := atan2(absf(side.y), absf(side.x)) / (0.5 * PI) * (views.y - 1)
	var fold := Vector2(-1.0 if side.x < 0.0 else 1.0, -1.0 if side.y < 0.0 else 1.0)
	return _decode(clamped, column, row, Transform2D().scaled(fold))


## The share of light that the surface reflects towards a view: the sum of the lobes' weights.
func directional_albedo(view: Vector3) -> float:
	var sum := 0.0
	for lobe in lobes_at(view):
		var weight: float = lobe["weight"]
		sum += weight
	return sum


## The table for JSON: [code]{"brdf", "alpha": [x, y], "lobes", "directions": [{"view": [x, y, z],
## "lobes": [{"weight", "mean": [x, y, z], "kappa"}]}]}[/code], the directions being the grid's
## views, elevations running fastest. Lobes of coloured tables also have
## [code]"tint": [r, g, b][/code].
func to_json_dictionary() -> Dictionary:
	var directions := []
	for azimuth in views.y:
		for elevation in views.x:
			var view := get_view(elevation, azimuth)
			var lobes := []
			for lobe in _decode(view, elevation, azimuth, Transform2D.IDENTITY):
				var mean: Vector3 = lobe["mean"]
				var listed := {
					"weight": lobe["weight"],
					"mean": [mean.x, mean.y, mean.z],
					"kappa": lobe["kappa"],
				}
				if lobe.has("tint"):
					var tint: Color = lobe["tint"]
					listed["tint"] = [tint.r, tint.g, tint.b]
				lobes.append(listed)
			directions.append({"view": [view.x, view.y, view.z], "lobes": lobes})
	return {
		"brdf": brdf,
		"alpha": plain_numbers(alpha),
		"lobes": lobe_count,
		"directions": directions,
	}


# The lobes of a place in the grid; `placement` takes the table's slopes to those about `view`.
func _decode(view: Vector3, column: float, row: float, placement: Transform2D) -> Array[Dictionary]:
	var lobes: Array[Dictionary] = []
	for k in lobe_count:
		var texel := _interpolate(k, column, row)
		var slope := placement * (Vector2(texel.r, texel.g) * alpha)
		var half_vector := Vector3(slope.x, slope.y, 1.0).normalized()
		var cosine := maxf(view.dot(half_vector), 1e-4)
		var mean := 2.0 * cosine * half_vector - view
		lobes.append({"weight": texel.a, "mean": mean, "kappa": pow(2.0, texel.b) / cosine})
		if has_second_texels():
			# The second texels begin where those of one lobe more would.
			var second := _interpolate(lobe_count + k, column, row)
			var green := maxf(0.0, 3.0 - second.b - second.a)
			lobes.back()["tint"] = Color(second.b, green, second.a)
	return lobes


## Single-precision numbers as a person would write them: 0.1, not 0.10000000149.
static func plain_numbers(pair: Vector2) -> Array[float]:
	return [String.num(pair.x, 7).to_float(), String.num(pair.y, 7).to_float()]


func _interpolate(lobe: int, column: float, row: float) -> Color:
	var t0 := clampi(floori(column), 0, views.x - 1)
	var p0 := clampi(floori(row), 0, views.y - 1)
	var t1 := mini(t0 + 1, views.x - 1)
	var p1 := mini(p0 + 1, views.y - 1)
	var first := lobe * views.y
	var near := image.get_pixel(t0, first + p0).lerp(image.get_pixel(t1, first + p0), column - t0)
	var far := image.get_pixel(t0, first + p1).lerp(image.get_pixel(t1, first + p1), column - t0)
	return near.lerp(far, row - p0)


func _invalidate() -> void:
	_mutex.lock()
	_texture = null
	_mutex.unlock()
	_follow_change()


func _follow_change() -> void:
	_saved.settle(_find_checksum, image)
	emit_changed()


func _find_checksum() -> int:
	# Vectors are longer in engines of double precision.
	var widths := PackedFloat32Array([alpha.x, alpha.y])
	return SavedForm.find_checksum([brdf, widths, lobe_count, views, method, seed], image)
