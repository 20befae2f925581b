@tool
extends RefCounted
## What a [LobeTable] is baked from, as the inspector asks for it. It is kept in the table's
## metadata, so that the table can be baked again.

const Widths := preload("../../runtime/table/widths.gd")

## Metadata with an underscore are the editor's own and are not listed in the inspector.
const META := &"_lobelight_recipe"
const REPORT_META := &"_lobelight_report"
## The models, as [LobeBaker] names them.
const MODELS: PackedStringArray = ["ggx", "ward", "ward_bounded"]
const MEASURED_EXTENSIONS: PackedStringArray = ["binary", "bsdf"]
## Stands for the fewest lobes that reach [member target].
const AUTOMATIC := 0

## One of [constant MODELS], or the path of a file of measurements.
var brdf := "ggx"
## Widths along the tangent and the bitangent. They are estimated for measurements.
var alpha := Vector2(0.1, 0.1)
## Lobes per view, or [constant AUTOMATIC].
var lobes := 8
## Decibels to be reached with [constant AUTOMATIC].
var target := 30.0
## A panorama's path: with [constant AUTOMATIC] the target is to be reached in it too.
var environment := ""


## What the table was baked from, as far as it tells.
static func from_table(table: LobeTable) -> RefCounted:
	var recipe := new()
	var kept: Dictionary = table.get_meta(META, {})
	recipe.brdf = kept.get("brdf", table.brdf if table.brdf in MODELS else MODELS[0])
	var widths: Vector2 = kept.get("alpha", table.alpha)
	recipe.alpha = widths.clampf(0.0001, 2.0) if widths.is_finite() else Vector2(0.1, 0.1)
	recipe.lobes = kept.get("lobes", table.lobe_count if table.lobe_count > 0 else 8)
	recipe.target = kept.get("target", 30.0)
	recipe.environment = kept.get("environment", "")
	return recipe


## Whether an importer bakes the table. What else is baked into it is gone with the next start.
static func is_imported(table: LobeTable) -> bool:
	return table.resource_path.get_extension() in MEASURED_EXTENSIONS


## For the table's metadata.
func to_dictionary() -> Dictionary:
	return {
		"brdf": brdf,
		"alpha": alpha,
		"lobes": lobes,
		"target": target,
		"environment": environment,
	}


## For [method LobeTask.start].
func to_request() -> Dictionary:
	var request := {"brdf": brdf}
	if not is_measured():
		request["alpha"] = alpha
	if lobes == AUTOMATIC:
		request["lobes"] = "auto"
		request["target"] = target
		if environment:
			request["environments"] = [environment]
	else:
		request["lobes"] = lobes
	return request


func is_measured() -> bool:
	return brdf not in MODELS


## Why it cannot be baked, in a sentence; empty if nothing is known against it.
func get_problem() -> String:
	if brdf.is_empty():
		return "Choose a file of measurements: MERL's .binary or an RGB .bsdf of the RGL database."
	var files: PackedStringArray = []
	if is_measured():
		files.append(brdf)
	if lobes == AUTOMATIC and environment:
		files.append(environment)
	for file in files:
		if not FileAccess.file_exists(file):
			return "%s: there is no such file." % file
	return ""


## Roughness and anisotropy as [LobeMaterial3D] takes them.
func get_roughness() -> Vector2:
	return Widths.to_roughness(alpha)


func set_roughness(roughness: float, anisotropy: float) -> void:
	alpha = Widths.from_roughness(roughness, anisotropy).clampf(0.0001, 2.0)
