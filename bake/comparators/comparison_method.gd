class_name ComparisonMethod
extends RefCounted
## One way of drawing the sphere of `./dev compare`. Every method has a file of its own in this
## folder, and its name is known to [CompareMethods].

## As on the command line; also the picture's file name.
var name: String
var brdf: String
## Widths along the tangent and the bitangent.
var alpha: PackedFloat64Array
## The room that the sphere is in; null under a panorama.
var room: CompareRoom
## What the light is multiplied by when the sphere is drawn; pictures are divided by it.
var energy := 1.0


## Makes what the pictures need: tables, maps. Returns one sentence on failure, otherwise empty.
## To be awaited.
func prepare(_stage: ComparisonStage) -> String:
	assert(false, "a method overrides prepare()")
	return ""


## Has the viewport, which is not in the tree yet, show another world than its own, if need be.
func choose_world(_viewport: LinearViewport) -> void:
	pass


## The sphere, for a [LinearViewport]; to be called after [method prepare].
func make_sphere() -> MeshInstance3D:
	assert(false, "a method overrides make_sphere()")
	return null


## What the method needs of the viewport that the sphere is put into, besides.
func set_up_viewport(_viewport: LinearViewport) -> void:
	pass


## Waits until the viewport, set up, can show the picture: for what is captured in it. To be
## awaited.
func settle(_viewport: LinearViewport) -> void:
	pass


## What one pixel costs: [code]{"fetches", "probes", "table_fetches"}[/code], the texture
## instructions on the environment, what the sampler reads for them (a trilinear look-up counts as
## one), and the texture instructions on tables.
func cost() -> Dictionary:
	assert(false, "a method overrides cost()")
	return {}


## What else the picture depends on, for plan.json.
func settings() -> Dictionary:
	return {}
