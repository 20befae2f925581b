extends SceneTree
## Fits what the demo draws besides the ready tables: sets of GGX with 4 and 16 lobes, and one with
## the views fitted each by itself, as in Töral 2015. Their widths are coarser than the ready sets',
## so that this takes a minute and not ten: `--set ggx_4|ggx_16|thesis_8 --out FILE`. `--views T,P`
## fits other numbers of elevations and azimuths than the usual ones: fewer serve tests that do not
## look at how good the lobes are.

## Widths on each axis, growing by factors of two.
const WIDTHS: Array[float] = [0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64]
const BRDF := "ggx"
## Elevations × azimuths of one quadrant. The thesis does not give them; `./dev compare` takes twice
## as many along each axis.
const THESIS_VIEWS := Vector2i(32, 12)
## The usual ones of sets.
const SET_VIEWS := Vector2i(16, 8)
const LOBES: Dictionary[String, int] = {"ggx_4": 4, "ggx_16": 16, "thesis_8": 8}
## Widths that are further apart than this many factors of two are out of the demo's reach: the
## tables of the furthest pair within stand there.
const _MOST_APART := 4

var _arguments := CommandLine.new("demo", ["set", "views", "out"])


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	var name := _arguments.required("set")
	var out := _arguments.path("out")
	_arguments.required("out")
	_arguments.fail_if(NativeLibrary.error())
	if name not in LOBES:
		_arguments.fail("--set must be one of %s, not %s." % [", ".join(LOBES.keys()), name])
	var is_thesis := name.begins_with("thesis")
	var usual := Vector2(THESIS_VIEWS if is_thesis else SET_VIEWS)
	var views := _arguments.numbers("views", 2, [usual.x, usual.y])
	if _arguments.error.is_empty():
		var grid := Vector2i(int(views[0]), int(views[1]))
		var made := (
			await _bake_thesis(LOBES[name], grid)
			if is_thesis
			else await _bake_set(LOBES[name], grid)
		)
		if made != null:
			_arguments.fail_if(AtomicFile.save_resource(made, out))
	if not _arguments.error.is_empty():
		printerr(_arguments.error_line())
	quit(0 if _arguments.error.is_empty() else 1)


func _bake_set(lobes: int, views: Vector2i) -> LobeTableSet:
	var recipe := {"brdf": BRDF, "widths": WIDTHS, "lobes": lobes, "views": [views.x, views.y]}
	var label := "fitting GGX, %d lobes" % lobes
	var result := await NativeLibrary.run(NativeLibrary.create(&"LobeBaker"), recipe, label, self)
	if result.has("error"):
		_arguments.fail(result["error"])
		return null
	return LobeTableSet.from_baked(result)


func _bake_thesis(lobes: int, views: Vector2i) -> LobeTableSet:
	var texels := PackedByteArray()
	var line := ProgressLine.new("fitting the thesis' tables")
	for wide in WIDTHS.size():
		var nearest := PackedByteArray()
		for narrow in range(wide, -1, -1):
			# From equal widths on, so that what is out of reach has its neighbour's.
			if wide - narrow <= _MOST_APART:
				nearest = await _fit_views(WIDTHS[wide], WIDTHS[narrow], views, lobes)
			if not _arguments.error.is_empty():
				return null
			texels = _insert(texels, nearest, wide * (wide + 1) / 2)
		line.show((wide + 1.0) / (WIDTHS.size() + 1.0))
	for width in WIDTHS:
		texels.append_array(await _fit_views(width, width, Vector2i(views.x, 1), lobes))
		if not _arguments.error.is_empty():
			return null
	line.finish()
	return _make_set(texels, lobes, views)


# Puts a table in front of those of the same first width, which begin at number `table`.
static func _insert(
	texels: PackedByteArray, table: PackedByteArray, number: int
) -> PackedByteArray:
	var at := number * table.size()
	return texels.slice(0, at) + table + texels.slice(at)


func _fit_views(wide: float, narrow: float, views: Vector2i, lobes: int) -> PackedByteArray:
	var baker := NativeLibrary.create(&"LobeBaker")
	var recipe := {
		"brdf": BRDF,
		"alpha": [wide, narrow],
		"lobes": lobes,
		"method": "independent",
		"views": [views.x, views.y],
	}
	if wide == narrow and views.y > 1:
		# A fit of equal widths has one azimuth only; the shader never asks for its others.
		recipe["views"] = [views.x, 1]
	if not baker.call("start", recipe):
		_arguments.fail(baker.call("get_error"))
		return []
	while baker.call("is_running"):
		await create_timer(0.02).timeout
	var result: Dictionary = baker.call("get_result")
	var failure: String = baker.call("get_error")
	if failure:
		_arguments.fail(failure)
		return []
	var table := LobeTable.from_baked(result)
	var texels := table.image.get_data()
	if table.views == views:
		return texels
	var row_bytes := 8 * views.x
	var repeated := PackedByteArray()
	for lobe in lobes:
		for azimuth in views.y:
			repeated.append_array(texels.slice(lobe * row_bytes, (lobe + 1) * row_bytes))
	return repeated


func _make_set(texels: PackedByteArray, lobes: int, views: Vector2i) -> LobeTableSet:
	var tables := LobeTableSet.new()
	tables.brdf = BRDF
	tables.widths = PackedFloat64Array(WIDTHS)
	tables.lobe_count = lobes
	tables.views = views
	@warning_ignore("integer_division")
	var height := texels.size() / (8 * views.x)
	tables.image = Image.create_from_data(views.x, height, false, Image.FORMAT_RGBAH, texels)
	tables.resource_scene_unique_id = "set"
	_arguments.fail_if(tables.get_problem())
	return tables
