extends RefCounted
## What it costs the processor to change one property of many materials in a frame, a
## [LobeMaterial3D]'s beside the same of a [StandardMaterial3D]'s.
##
## Rounds of both kinds, and of frames in which nothing is changed, take turns in one process; a
## cost is the time from the first change to where the frame's drawing begins, so that it has
## what was put off until then, less that of an idle frame. Costs are medians over the rounds, the
## ratio is that of the medians.

## [code][name, property, properties that are set before, values to go through][/code].
const CASES: Array[Array] = [
	["albedo", &"albedo_color", {}],
	["roughness", &"roughness", {}],
	["roughness, anisotropic", &"roughness", {&"anisotropy_enabled": true, &"anisotropy": 0.7}],
	["anisotropy", &"anisotropy", {&"anisotropy_enabled": true, &"anisotropy": 0.7}],
	["metallic", &"metallic", {&"metallic": 0.5}],
	["emission", &"emission", {&"emission_enabled": true, &"emission": Color(0.5, 0.5, 0.5)}],
	["uv1_offset", &"uv1_offset", {&"uv1_offset": Vector3(0.5, 0.5, 0.0)}],
]
# Frames of changes before the first that counts: materials settle for what changes often.
const _FRAMES_BEFORE := 4

var _tree: SceneTree
var _pre_draw := 0


func _init(tree: SceneTree) -> void:
	_tree = tree
	RenderingServer.frame_pre_draw.connect(_on_pre_draw)


## A row for each case: [code]{"property", "materials", "rounds", "lobe_ms", "standard_ms",
## "ratio"}[/code], times being those of all materials in a frame. To be awaited.
func measure(materials := 100, rounds := 30) -> Array[Dictionary]:
	var rows: Array[Dictionary] = []
	for case in CASES:
		var property: StringName = case[1]
		var lobes := _make(materials, case[2], func() -> Material: return LobeMaterial3D.new())
		var standards := _make(
			materials, case[2], func() -> Material: return StandardMaterial3D.new()
		)
		for i in _FRAMES_BEFORE:
			await _time(lobes, property, i)
			await _time(standards, property, i)
		var idle := PackedFloat64Array()
		var lobe := PackedFloat64Array()
		var standard := PackedFloat64Array()
		for round in rounds:
			idle.append(await _time([], property, round))
			lobe.append(await _time(lobes, property, round))
			standard.append(await _time(standards, property, round))
		var rest := _median(idle)
		var row := {
			"property": case[0],
			"materials": materials,
			"rounds": rounds,
			"lobe_ms": maxf(_median(lobe) - rest, 0.0),
			"standard_ms": maxf(_median(standard) - rest, 0.0),
		}
		row["ratio"] = row["lobe_ms"] / maxf(row["standard_ms"], 1e-6)
		rows.append(row)
	return rows


func _make(count: int, properties: Dictionary, maker: Callable) -> Array[Material]:
	var materials: Array[Material] = []
	for i in count:
		var material: Material = maker.call()
		for name: StringName in properties:
			material.set(name, properties[name])
		materials.append(material)
	return materials


# Milliseconds.
func _time(materials: Array[Material], property: StringName, round: int) -> float:
	await _tree.process_frame
	var share := 0.1 + 0.8 * fposmod(0.61803 * round, 1.0)
	var value: Variant = share
	match property:
		&"albedo_color", &"emission":
			value = Color(share, 0.5, 0.5)
		&"uv1_offset":
			value = Vector3(share, 0.5, 0.0)
	var start := Time.get_ticks_usec()
	for material in materials:
		material.set(property, value)
	await RenderingServer.frame_pre_draw
	return 0.001 * (_pre_draw - start)


func _on_pre_draw() -> void:
	_pre_draw = Time.get_ticks_usec()


static func _median(values: PackedFloat64Array) -> float:
	var sorted := values.duplicate()
	sorted.sort()
	@warning_ignore("integer_division")
	return sorted[sorted.size() / 2]
