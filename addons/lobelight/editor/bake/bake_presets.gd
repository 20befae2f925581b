@tool
extends Object
## Materials to start from. Widths are guesses by eye, not measurements.

const Recipe := preload("bake_recipe.gd")

## Name, BRDF, roughness, anisotropy, lobes.
const LIST: Array[Array] = [
	["Polished metal", "ggx", 0.15, 0.0, 8],
	["Brushed steel", "ggx", 0.4, 0.95, 16],
	["Brushed aluminium", "ggx", 0.35, 0.85, 16],
	["Lathe-turned metal", "ggx", 0.3, 1.0, 16],
	["Anodised aluminium", "ggx", 0.45, 0.0, 8],
	["Car paint", "ggx", 0.25, 0.0, 8],
	["Satin", "ward", 0.55, 0.8, 8],
	["Silk", "ward", 0.5, 0.95, 16],
	["Hair", "ward", 0.4, 1.0, 16],
	["Vinyl", "ward_bounded", 0.35, -0.5, 8],
	["Varnished wood", "ward", 0.35, 0.5, 8],
	["Frosted glass", "ggx", 0.6, 0.0, 4],
]


static func get_names() -> PackedStringArray:
	var names: PackedStringArray = []
	for preset in LIST:
		names.append(preset[0])
	return names


## The recipe of a preset, counted from 0.
static func make(index: int) -> Recipe:
	var preset := LIST[index]
	var recipe := Recipe.new()
	recipe.brdf = preset[1]
	recipe.set_roughness(preset[2], preset[3])
	recipe.lobes = preset[4]
	return recipe
