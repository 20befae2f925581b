@tool
extends RefCounted
## Whether a material's widths are drawn by lobes that need no table (line/line.gdshaderinc), and by
## how many: long ones are, which take more lobes than ready tables have.

const OnDemand := preload("../on_demand.gd")
const Widths := preload("../table/widths.gd")

## The BRDFs that can be, by the names that tables have for them, and what the shader calls them.
const MODELS: Dictionary[String, String] = {
	"ggx": "GGX", "ward": "WARD", "ward_bounded": "WARD_BOUNDED"
}
## How many lobes a shader may have.
const PLACES: PackedInt32Array = [8, 16, 24, 32]
const _PART := "res://addons/lobelight/runtime/line/line_lobes.gd"
# Widths of this ratio are drawn by the table, and by the line from the other on; between them, by
# both.
const _ROUND := 3.0
const _LONG := 3.6
# The narrowest and the widest width of a line.
const _LEAST := 0.001
const _LARGEST := 1.0

## How many lobes the shader has; 0 if the table draws all.
var places := 0
## Of the line in the light, the table's being the rest.
var share := 0.0
## Whether there is a table besides.
var fades := false
## Of the names in [constant MODELS].
var brdf := ""
## Whether there can be any, with other widths.
var is_possible := false

var _most := 0
var _can_be_rounder := false
var _count := 0.0
var _parameters: Dictionary[StringName, Variant] = {}


## Looks anew. [param most] is the largest number of lobes to be drawn, [param can_be_rounder] says
## that pixels may have less anisotropy.
func choose(of_brdf: String, anisotropy: float, most: int, can_be_rounder: bool) -> void:
	clear()
	is_possible = most > PLACES[0] and MODELS.has(of_brdf)
	_most = most
	_can_be_rounder = can_be_rounder
	share = get_share(anisotropy) if is_possible else 0.0
	if share > 0.0:
		is_possible = _find_part() != null
	if share > 0.0 and is_possible:
		_take(of_brdf, minf(_find_count(anisotropy), most))
		fades = share < 1.0 or can_be_rounder


## A line of so many lobes for whatever widths.
func choose_count(of_brdf: String, count: int) -> void:
	share = 1.0
	fades = false
	_take(of_brdf, count)


func clear() -> void:
	places = 0
	is_possible = false


## Takes other widths if the shader can stay, and says so.
func follow(anisotropy: float) -> bool:
	var next := get_share(anisotropy)
	if not is_possible or places == 0 and next == 0.0:
		return true
	var count := minf(_find_count(anisotropy), _most)
	var will_fade := next < 1.0 or _can_be_rounder
	if next == 0.0 or will_fade != fades or _find_places(count) != places:
		return false
	share = next
	_take(brdf, count)
	return true


## What the shader takes, for widths that are the same everywhere.
func get_parameters(roughness: float, anisotropy: float) -> Dictionary[StringName, Variant]:
	var given := _parameters.duplicate()
	given[&"lobelight_line_alpha"] = get_alpha(roughness, anisotropy)
	given[&"lobelight_line_share"] = share
	return given


## The same for widths of each pixel.
func get_parameters_of_pixels() -> Dictionary[StringName, Variant]:
	var given := _parameters.duplicate()
	given[&"lobelight_line_widths"] = Vector2(log(_LEAST), log(_LARGEST)) / log(2.0)
	var slope := log(2.0) / log(_LONG / _ROUND)
	given[&"lobelight_line_fade"] = Vector2(slope, -slope * log(_ROUND) / log(2.0))
	return given


## What of widths a line draws, from 0 to 1.
static func get_share(anisotropy: float) -> float:
	return clampf(log(get_ratio(anisotropy) / _ROUND) / log(_LONG / _ROUND), 0.0, 1.0)


## Of the widths of an anisotropy, the larger one over the smaller one.
static func get_ratio(anisotropy: float) -> float:
	var widths := Widths.from_roughness(1.0, anisotropy)
	return maxf(widths.x, widths.y) / minf(widths.x, widths.y)


## Widths as a line takes them.
static func get_alpha(roughness: float, anisotropy: float) -> Vector2:
	return Widths.from_roughness(roughness, anisotropy).clampf(_LEAST, _LARGEST)


# How many lobes widths need, which need not be a whole number.
static func _find_count(anisotropy: float) -> float:
	return clampf(2.4 * get_ratio(anisotropy), PLACES[1], PLACES[-1])


static func _find_places(count: float) -> int:
	for enough in PLACES:
		if count <= enough:
			return enough
	return PLACES[-1]


func _take(of_brdf: String, count: float) -> void:
	if of_brdf != brdf or count != _count or places == 0:
		brdf = of_brdf
		_count = count
		places = _find_places(count)
		var part := _find_part()
		_parameters.assign(part.call(&"get_parameters", brdf, count, places))


# Null where an export has left it out.
static func _find_part() -> GDScript:
	if OnDemand.find_loss(_PART, OnDemand.LINES):
		return null
	return OnDemand.fetch(_PART, OnDemand.LINES) as GDScript
