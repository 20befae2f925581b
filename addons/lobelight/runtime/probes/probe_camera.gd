@tool
extends Object
## The camera that matters to a probe.


## That of the probe's viewport, in the editor that of its first 3D view; null if there is none.
static func find(node: Node3D) -> Camera3D:
	if Engine.is_editor_hint() and node.is_part_of_edited_scene():
		# Its class is not known to games.
		var editor := Engine.get_singleton(&"EditorInterface")
		return (editor.call(&"get_editor_viewport_3d", 0) as SubViewport).get_camera_3d()
	return node.get_viewport().get_camera_3d()
