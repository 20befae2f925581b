@tool
extends Timer
## Keeps the scene tree's warnings of [LobeEnvironment3D]s up to date. The nodes tell of their own
## properties; this looks at what else there is to it: skies that come, go or change.

const EnvironmentWarnings := preload("../../runtime/environment_warnings.gd")

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
	for environment in find_environments(root):
		var id := environment.get_instance_id()
		seen[id] = EnvironmentWarnings.of(environment, root)
		if seen[id] != _shown.get(id, PackedStringArray()):
			environment.update_configuration_warnings()
			count += 1
	_shown = seen
	return count


## The environments of a scene.
static func find_environments(root: Node) -> Array[LobeEnvironment3D]:
	var found: Array[LobeEnvironment3D] = []
	if root == null:
		return found
	for node in root.find_children("*", "LobeEnvironment3D", true, false):
		found.append(node)
	if root is LobeEnvironment3D:
		found.append(root)
	return found
