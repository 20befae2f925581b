extends SceneTree
## `./dev compare`: one sphere drawn by several methods and by the reference integrator; see
## [Comparison] for what it writes.

const OPTIONS: PackedStringArray = [
	"env",
	"room",
	"brdf",
	"alpha",
	"methods",
	"size",
	"samples",
	"filter",
	"light",
	"max-sources",
	"coverage",
	"views",
	"bias",
	"fis",
	"timing-rounds",
	"timing-size",
	"out",
]
const LEAST_SIZE := 8
const LARGEST_SIZE := 2048
const MOST_TIMING_ROUNDS := 10000

var _arguments := CommandLine.new("compare", OPTIONS)
var _comparison := Comparison.new()


func _initialize() -> void:
	# The first frame has to be over before a coroutine may await the next one.
	_run.call_deferred()


func _run() -> void:
	_comparison.stage = ComparisonStage.new(self)
	_read_arguments()
	var remarks: PackedStringArray = []
	if _arguments.error.is_empty():
		remarks = _load_light()
	if _arguments.error.is_empty():
		_arguments.fail_if(await _comparison.run())
	# An error is one line, and nothing else.
	if not _arguments.error.is_empty():
		remarks = [_arguments.error_line()]
	for line in remarks:
		printerr(line)
	_comparison = null
	quit(0 if _arguments.error.is_empty() else 1)


# What there is to say of the files.
func _load_light() -> PackedStringArray:
	if _arguments.has("room"):
		var room := CompareRoom.read(_comparison.environment_path)
		_arguments.fail_if(room.get_error())
		_comparison.stage.room = room
		return room.remarks
	var panorama := Comparison.load_panorama(_comparison.environment_path)
	_arguments.fail_if(panorama.get("error", ""))
	_comparison.stage.panorama = panorama.get("texture")
	return panorama.get("remarks", PackedStringArray())


func _read_arguments() -> void:
	var is_room := _arguments.has("room")
	if is_room and _arguments.has("env"):
		_arguments.fail("--room and --env exclude each other: the light is either of them.")
	if not is_room and not _arguments.has("env"):
		_arguments.fail("--env is missing (or --room).")
	_comparison.environment_path = _arguments.path("room" if is_room else "env")
	_arguments.required("brdf")
	_comparison.brdf = _arguments.brdf("brdf")
	_comparison.alpha = _arguments.numbers("alpha", 2, PackedFloat64Array())
	_arguments.required("alpha")
	_comparison.names = _arguments.required("methods").split(",", false)
	_comparison.size = _arguments.integer("size", 256, LEAST_SIZE, LARGEST_SIZE)
	_comparison.timing_rounds = _arguments.integer(
		"timing-rounds", Comparison.TIMING_ROUNDS, 0, MOST_TIMING_ROUNDS
	)
	_comparison.timing_size = _arguments.integer(
		"timing-size", Comparison.TIMING_SIZE, LEAST_SIZE, LARGEST_SIZE
	)
	_read_stage(_comparison.stage)
	_arguments.required("out")
	_comparison.out = _arguments.path("out")
	for method in _comparison.names:
		_arguments.fail_if(CompareMethods.error(method, is_room))
		if _comparison.names.count(method) > 1:
			_arguments.fail("method %s is named twice." % method)
	_arguments.fail_if(NativeLibrary.error())
	if _arguments.has("samples"):
		_comparison.samples = _arguments.integer("samples", 0, 2, 1 << 20)


func _read_stage(stage: ComparisonStage) -> void:
	stage.filter = _arguments.text("filter", stage.filter)
	if stage.filter not in ComparisonStage.FILTERS:
		_arguments.fail("--filter is %s." % " or ".join(ComparisonStage.FILTERS.keys()))
	stage.light_form = _arguments.text("light", stage.light_form)
	if stage.light_form not in ComparisonStage.LIGHTS:
		_arguments.fail("--light is %s." % " or ".join(ComparisonStage.LIGHTS))
	if stage.light_form == "baked" and _arguments.has("room"):
		_arguments.fail("--light baked is for panoramas: rooms are captured.")
	stage.max_sources = _arguments.integer("max-sources", stage.max_sources, 0, 4)
	stage.fis_bias = _arguments.numbers("bias", 1, [stage.fis_bias])[0]
	stage.fis_form = _arguments.text("fis", stage.fis_form)
	if stage.fis_form not in ComparisonStage.FIS_FORMS:
		_arguments.fail("--fis is %s." % " or ".join(ComparisonStage.FIS_FORMS))
	stage.toral_coverage = _arguments.numbers("coverage", 1, [stage.toral_coverage])[0]
	if not (stage.toral_coverage > 0.0 and stage.toral_coverage < 1.0):
		_arguments.fail("--coverage must be between 0 and 1, not %s." % _arguments.text("coverage"))
	var views := _arguments.numbers("views", 2, [0.0, 0.0])
	stage.toral_views = Vector2i(int(views[0]), int(views[1]))
	if Vector2(stage.toral_views) != Vector2(views[0], views[1]):
		_arguments.fail("--views takes whole numbers, not %s." % _arguments.text("views"))
