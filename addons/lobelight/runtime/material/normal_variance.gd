@tool
@abstract
extends RefCounted
## What [LobeMaterial3D] asks of antialiasing/normal_variance.gd, which exports leave out where
## nothing has a normal map.

const OnDemand := preload("../on_demand.gd")
const _PATH := "res://addons/lobelight/runtime/antialiasing/normal_variance.gd"


## Null, and an error, if the export has left it out.
static func find() -> RefCounted:
	var script := OnDemand.fetch(_PATH, OnDemand.ANTIALIASING) as GDScript
	return script.new() if script != null else null


@abstract func bake(normals: Image) -> ImageTexture
