@tool
extends Timer
## Keeps the scene tree's warnings of [LobeEnvironment3D]s up to date. The nodes tell of their own
## properties; this looks at what else there is to it: skies that come, go or change.

const EnvironmentWarnings := preload("../../runtime/warnings/environment_warnings.gd")
const SceneUsage := preload("../menu/scene_usage.gd")

# What the scene tree shows, by the nodes' instance ids.
var _shown: Dictionary[int, PackedStringArray] = {}


func _init() -> void:
	wait_time = 1.0
	autostart = true
	timeout.connect(refresh)


## Looks now; how many nodes have other warnings than at the last look.
func refresh() -> int:
	var root := EditorInterface.get_edited_scene_root()
	var seen: Dictionary[int, PackedStringArray] = {}
	var count := 0
	for environment in SceneUsage.find_environments(root):
		var id := environment.get_instance_id()
		seen[id] = EnvironmentWarnings.of(environment, root)
		if seen[id] != _shown.get(id, PackedStringArray()):
			environment.update_configuration_warnings()
			count += 1
	_shown = seen
	return count
