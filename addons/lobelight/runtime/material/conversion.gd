@tool
@abstract
extends RefCounted
## What [LobeMaterial3D] asks of material_conversion.gd, which exports leave out where nothing
## converts materials.

const OnDemand := preload("../on_demand.gd")
const _PATH := "res://addons/lobelight/runtime/conversion/material_conversion.gd"


## Null, and an error, if the export has left it out.
static func find() -> RefCounted:
	var script := OnDemand.fetch(_PATH, OnDemand.CONVERSION) as GDScript
	return script.new() if script != null else null


@abstract func from_standard(source: BaseMaterial3D) -> ShaderMaterial

@abstract func to_standard(source: ShaderMaterial) -> BaseMaterial3D

@abstract func get_losses(source: BaseMaterial3D) -> PackedStringArray
