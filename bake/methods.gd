class_name CompareMethods
extends RefCounted
## The methods that `./dev compare` knows by name.

const AllFreq := preload("comparators/allfreq.gd")
const Asg := preload("comparators/asg.gd")
const ClosedForm := preload("comparators/closed_form.gd")
const Fis := preload("comparators/fis.gd")
const Gmm := preload("comparators/gmm.gd")
const MajorAxis := preload("comparators/major_axis.gd")
const OwnLine := preload("comparators/own_line.gd")
const SplitSum := preload("comparators/split_sum.gd")
const Stock := preload("comparators/stock.gd")
const Toral := preload("comparators/toral.gd")

const REFERENCE := "reference"
## As many lobes as a material draws by itself.
const AUTOMATIC := "auto"
## Drawn, besides `gmm<lobes>`, `gmm<lobes>r`, `line<lobes>`, `auto` and the reference.
const RIVALS: PackedStringArray = [
	"fis8",
	"fis16",
	"fis40",
	"fis40g",
	"toral8",
	"toral16",
	"allfreq1",
	"allfreq8",
	"asg",
	"closed8",
	"majoraxis8",
	"majoraxis32",
	"splitsum",
	"stock",
]

## Drawn in rooms, besides `gmm<lobes>`, `gmm<lobes>r`, both also with `_flat`, and the reference.
const ROOM_RIVALS: PackedStringArray = ["fis8", "fis16", "fis40", "fis40g", "stock"]
# Of `line<lobes>`.
const _LINES: PackedInt32Array = [4, 8, 12, 16, 20, 24, 28, 32, 36, 40]
const _FLAT := "_flat"


## One sentence where a name cannot be drawn, in a room or under a panorama; otherwise empty.
static func error(method: String, in_room := false) -> String:
	if method.ends_with(_FLAT) and _gmm_lobes(method.trim_suffix(_FLAT)) > 0:
		return "" if in_room else "method %s is for rooms: it needs --room." % method
	if in_room and method in RIVALS and method not in ROOM_RIVALS:
		return (
			"method %s is not drawn in rooms; those are gmm<lobes>, gmm<lobes>_flat, %s and reference."
			% [method, ", ".join(ROOM_RIVALS)]
		)
	if in_room and (method == AUTOMATIC or _line_lobes(method) > 0):
		return "method %s is not drawn in rooms." % method
	if method == REFERENCE or method in RIVALS or _gmm_lobes(method) > 0:
		return ""
	if method == AUTOMATIC or _line_lobes(method) > 0:
		return ""
	return (
		(
			"method %s is unknown; the methods are gmm<lobes>, gmm<lobes>r (gmm8, gmm8r …), line4,"
			+ " line8 … line40, auto, %s and reference."
		)
		% [method, ", ".join(RIVALS)]
	)


## The method of a name that has no [method error]; null for the reference, which is not drawn.
static func make(method: String, brdf: String, alpha: PackedFloat64Array) -> ComparisonMethod:
	var made: ComparisonMethod
	if method.begins_with("gmm"):
		var lobes := method.trim_suffix(_FLAT)
		made = Gmm.make(_gmm_lobes(lobes), lobes.ends_with("r"), lobes != method)
	elif method == AUTOMATIC or method.begins_with("line"):
		made = OwnLine.make(_line_lobes(method))
	elif method.begins_with("fis"):
		made = Fis.make(_number_after("fis", method.trim_suffix("g")), method.ends_with("g"))
	elif method.begins_with("toral"):
		made = Toral.make(_number_after("toral", method))
	elif method.begins_with("allfreq"):
		made = AllFreq.make(_number_after("allfreq", method))
	elif method == "asg":
		made = Asg.new()
	elif method == "closed8":
		made = ClosedForm.new()
	elif method.begins_with("majoraxis"):
		made = MajorAxis.make(_number_after("majoraxis", method))
	elif method == "splitsum":
		made = SplitSum.new()
	elif method == "stock":
		made = Stock.new()
	if made != null:
		made.name = method
		made.brdf = brdf
		made.alpha = alpha
	return made


static func _gmm_lobes(method: String) -> int:
	return _number_after("gmm", method.trim_suffix("r"))


# 0 where it is no line, or none of a number that is drawn.
static func _line_lobes(method: String) -> int:
	var lobes := _number_after("line", method)
	return lobes if lobes in _LINES else 0


# 0 where the name is not `family` and a whole number.
static func _number_after(family: String, method: String) -> int:
	var number := method.trim_prefix(family)
	return number.to_int() if method.begins_with(family) and number.is_valid_int() else 0
