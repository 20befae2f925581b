@tool
extends RefCounted
## Whether a material's widths are drawn by lobes that need no table (line/line.gdshaderinc), and by
## how many: long ones are, which take more lobes than ready tables have.

const OnDemand := preload("../on_demand.gd")
const Widths := preload("../table/widths.gd")

## The BRDFs that lines can have: the names that the shader uses, by those that tables use.
const MODELS: Dictionary[String, String] = {
	"ggx": "GGX", "ward": "WARD", "ward_bounded": "WARD_BOUNDED"
}
## The numbers of lobes that a line may have; they are few, so that there are few shaders.
const COUNTS: PackedInt32Array = [12, 16, 24, 32, 40]
## The BRDF of materials that have neither a table nor a set.
const DEFAULT_BRDF := "ggx"
const _PART := "res://addons/lobelight/runtime/line/line.gdshaderinc"
# With a quality of no more lobes than this, there is no line.
const _FEWEST := 8
# Up to the first ratio of the widths the table draws, from the second on the line, and between the
# two ratios both. The same holds for the narrower width, in reverse: for wide highlights the eight
# lobes of a table are more exact. Ward has no tails, so the table stays exact further.
const _RATIOS: Dictionary[String, Vector2] = {
	"ggx": Vector2(3.0, 3.6), "ward": Vector2(4.5, 5.4), "ward_bounded": Vector2(4.5, 5.4)
}
const _NARROW := 0.06
const _WIDE := 0.1
# The narrowest and the widest width of a line.
const _LEAST := 0.001
const _LARGEST := 1.0

## How many lobes the line has; 0 if the table draws all.
var count := 0
## How many of these are in use; need not be a whole number.
var used := 0.0
## The line's share of the light; the rest is the table's.
var share := 0.0
## Whether there is a table besides.
var fades := false
## The BRDF, one of [constant MODELS].
var brdf := ""
## Whether there can be any, with other widths.
var is_possible := false

var _ratios: Vector2 = _RATIOS["ggx"]
var _most := 0
var _can_be_narrower := false
var _can_be_rounder := false


## Looks anew. [param most] is the largest number of lobes to be drawn; pixels may have less
## roughness or anisotropy.
func choose(
	of_brdf: String,
	roughness: float,
	anisotropy: float,
	most: int,
	can_be_narrower := false,
	can_be_rounder := false
) -> void:
	clear()
	is_possible = most > _FEWEST and MODELS.has(of_brdf)
	_ratios = _get_ratios(of_brdf)
	_most = most
	_can_be_narrower = can_be_narrower
	_can_be_rounder = can_be_rounder
	if not is_possible or not _may_show(roughness, anisotropy):
		return
	is_possible = _is_there()
	if is_possible:
		brdf = of_brdf
		share = get_share(roughness, anisotropy)
		used = _find_used(anisotropy, most)
		count = _find_count(used)
		fades = share < 1.0 or can_be_rounder


## A line of so many lobes for whatever widths.
func choose_count(of_brdf: String, lobes: int) -> void:
	share = 1.0
	fades = false
	brdf = of_brdf
	count = lobes
	used = lobes


func clear() -> void:
	count = 0
	is_possible = false


## Takes other widths if the shader can stay, and says so.
func follow(roughness: float, anisotropy: float) -> bool:
	if not is_possible:
		return true
	if not _may_show(roughness, anisotropy):
		return count == 0
	var next := get_share(roughness, anisotropy)
	var next_used := _find_used(anisotropy, _most)
	var will_fade := next < 1.0 or _can_be_rounder
	if will_fade != fades or _find_count(next_used) != count:
		return false
	share = next
	used = next_used
	return true


## What the shader takes, for widths that are the same everywhere.
func get_parameters(roughness: float, anisotropy: float) -> Dictionary[StringName, Variant]:
	return {
		&"lobelight_line_alpha": get_alpha(roughness, anisotropy),
		&"lobelight_line_count": used,
		&"lobelight_line_share": share,
	}


## The same for widths of each pixel.
func get_parameters_of_pixels(of_brdf: String) -> Dictionary[StringName, Variant]:
	var ratios := _get_ratios(of_brdf)
	# Of logarithms to the base 2.
	var by_ratio := log(2.0) / log(ratios.y / ratios.x)
	var by_width := log(2.0) / log(_NARROW / _WIDE)
	var octaves := Vector4(log(ratios.x), log(_WIDE), log(_LEAST), log(_LARGEST)) / log(2.0)
	return {
		&"lobelight_line_count": used,
		&"lobelight_line_widths": Vector2(octaves.z, octaves.w),
		&"lobelight_line_fade":
		Vector4(by_ratio, -by_ratio * octaves.x, by_width, -by_width * octaves.y),
	}


## The line's share at some widths, from 0 to 1.
func get_share(roughness: float, anisotropy: float) -> float:
	var widths := Widths.from_roughness(maxf(roughness, 1e-3), anisotropy)
	var narrow := minf(widths.x, widths.y)
	var by_width := clampf(log(narrow / _WIDE) / log(_NARROW / _WIDE), 0.0, 1.0)
	return by_width * _get_share_of_ratio(anisotropy)


func _get_share_of_ratio(anisotropy: float) -> float:
	var from := get_ratio(anisotropy) / _ratios.x
	return clampf(log(from) / log(_ratios.y / _ratios.x), 0.0, 1.0)


static func _get_ratios(of_brdf: String) -> Vector2:
	return _RATIOS.get(of_brdf, _RATIOS["ggx"])


# Whether any pixel may.
func _may_show(roughness: float, anisotropy: float) -> bool:
	if _can_be_narrower:
		return _get_share_of_ratio(anisotropy) > 0.0
	return get_share(roughness, anisotropy) > 0.0


## Of the widths of an anisotropy, the larger one over the smaller one.
static func get_ratio(anisotropy: float) -> float:
	var widths := Widths.from_roughness(1.0, anisotropy)
	return maxf(widths.x, widths.y) / minf(widths.x, widths.y)


## Widths as a line takes them.
static func get_alpha(roughness: float, anisotropy: float) -> Vector2:
	return Widths.from_roughness(roughness, anisotropy).clampf(_LEAST, _LARGEST)


# How many lobes widths need: more would hardly be seen.
static func _find_used(anisotropy: float, most: int) -> float:
	var ratio := get_ratio(anisotropy)
	return minf(minf(2.0 * ratio + 4.0, 0.8 * ratio + 16.0), most)


static func _find_count(lobes: float) -> int:
	for enough in COUNTS:
		# Godot's largest anisotropy needs 24, but for rounding.
		if lobes < enough + 1e-3:
			return enough
	return COUNTS[-1]


# Exports leave the shader's part out where no file asks for it; an empty one is in its place.
static func _is_there() -> bool:
	if OnDemand.find_loss(_PART, OnDemand.LINES):
		return false
	return "LOBELIGHT_LINE" in (load(_PART) as ShaderInclude).code
