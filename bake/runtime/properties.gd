extends RefCounted
## What it costs to change a property of many materials in each frame, beside
## [StandardMaterial3D]: see bench_properties.gd.

const Bench := preload("../bench_properties.gd")
const MATERIALS := 100

## Why there are no results, in a sentence.
var error := ""


## To be awaited.
func measure(tree: SceneTree, scale: int, rounds: int) -> Array[Dictionary]:
	@warning_ignore("integer_division")
	var rows: Array[Dictionary] = await Bench.new(tree).measure(MATERIALS / scale, 25 * rounds)
	for row in rows:
		row["renderer"] = RenderingServer.get_current_rendering_method()
		print(
			(
				"%s of %d materials: %.3f ms a frame, %.1f times StandardMaterial3D's"
				% [row["property"], row["materials"], row["lobe_ms"], row["ratio"]]
			)
		)
	return rows
