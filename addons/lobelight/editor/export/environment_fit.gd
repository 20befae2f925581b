@tool
extends RefCounted
## The size that environments of automatic size need for the lobes that are drawn.
##
## The sharpest lobe is to be looked up between blurred levels still, not at level 0: from then on a
## larger cube map shows the same. In formulas, with the names of shaders/environment.gdshaderinc,
## its variance V is to be at least that of level 1,
##     V ≥ V_1 = t² (b − c + 4 (c + 1/6)),  t² = 4 / S²,  so  S ≥ √(4 (b + 3 c + 2/3) / V).
## A table has log2(κ (o·h)) and V = (o·h) / κ' with κ' = 2^that. The view is taken to be up to 75
## degrees off the normal.

const Pyramid := preload("../../runtime/pyramid/pyramid.gd")
const SetReach := preload("set_reach.gd")

const LEAST_COSINE := 0.25
# What weighs less does not show.
const LEAST_WEIGHT := 0.02

## Texels along a face; 0 if nothing is known.
var size := 0
## What the sharpest lobe is of, or why nothing is known.
var why := ""

var _sharpest := -INF
var _automatic: Array[Array] = []


## [param sets] as reach.gd has them, [param tables] are [file, LobeTable].
static func of(
	environments: Array[Array], sets: Dictionary[String, SetReach], tables: Array[Array]
) -> RefCounted:
	var fit := new()
	for entry in environments:
		if (entry[1] as Dictionary).get("size", 0) == 0:
			fit._automatic.append(entry)
	for path in sets:
		fit._look_at_set(path, sets[path])
	for entry in tables:
		fit._look_at_table(entry[1], entry[0])
	if fit._automatic.is_empty():
		fit.why = "no scene has an environment of automatic size"
	elif fit.why.is_empty() and fit._sharpest > -INF:
		fit._find_size()
	return fit


## What an environment of automatic size is to have in an export; 0 if it is to stay automatic.
func get_size_for(environment: LobeEnvironment3D) -> int:
	if size == 0 or environment.size != 0:
		return 0
	return size if size < _get_automatic_size(environment.panorama) else 0


## The side of the cube map that is made of a panorama in an export, where the environment's size is
## [param own].
func get_exported_size(own: int, panorama: Texture2D) -> int:
	if own > 0:
		return own
	var automatic := _get_automatic_size(panorama)
	return mini(size, automatic) if size > 0 else automatic


static func _get_automatic_size(panorama: Texture2D) -> int:
	return Pyramid.automatic_size(panorama) if panorama != null else Pyramid.MAX_AUTOMATIC_SIZE


## Whether a scene has environments that may be resized.
func has_environment(path: String) -> bool:
	return size > 0 and _automatic.any(func(entry: Array) -> bool: return entry[0] == path)


## Gives the environments in a scene the size that they need. Returns whether any was changed. Not
## by the engine's own way to change scenes (_customize_scene), which loads every file of the
## project and complains about those that are no resources.
func edit(packed: PackedScene) -> bool:
	var scene := packed.instantiate(PackedScene.GEN_EDIT_STATE_INSTANCE)
	var is_changed := _resize(scene) and packed.pack(scene) == OK
	scene.free()
	return is_changed


func _resize(scene: Node) -> bool:
	var is_changed := false
	var nodes := scene.find_children("*", "LobeEnvironment3D")
	nodes.append(scene)
	for node in nodes:
		var environment := node as LobeEnvironment3D
		# Those of scenes in the scene are changed there.
		if environment != null and (node == scene or node.owner == scene):
			var wanted := get_size_for(environment)
			if wanted > 0:
				environment.size = wanted
				is_changed = true
	return is_changed


func describe() -> String:
	if size == 0:
		return "Environments keep their sizes: %s" % why
	return "Environments of automatic size have %d texels a side: %s" % [size, why]


func _find_size() -> void:
	var blur := Pyramid.LEVEL_VARIANCES[Pyramid.Filter.DISC]
	var variance := LEAST_COSINE * pow(2.0, -_sharpest)
	# b is at most c / 2.
	var wanted := ceili(sqrt(4.0 * (3.5 * blur + 2.0 / 3.0) / variance))
	var found := nearest_po2(wanted)
	if found < Pyramid.MAX_AUTOMATIC_SIZE:
		size = maxi(found, Pyramid.MIN_SIZE)
		why = "the sharpest lobe needs %d" % wanted
	else:
		why = "the sharpest lobe needs %d texels a side" % wanted


func _look_at_set(path: String, reach: SetReach) -> void:
	if reach.whole_because or reach.isotropic_because or reach.is_filled:
		why = "not all widths are known"
		return
	var tables: LobeTableSet = load(path)
	for surface in reach.surfaces:
		_look_at_table(tables.shared_table_at(surface), path)


func _look_at_table(table: LobeTable, file: String) -> void:
	if table == null or not table.get_problem().is_empty():
		why = "a table of %s cannot be read" % file
		return
	var image := table.image
	var rows := table.lobe_count * table.views.y
	for y in rows:
		for x in image.get_width():
			var texel := image.get_pixel(x, y)
			if texel.a > LEAST_WEIGHT:
				_sharpest = maxf(_sharpest, texel.b)
