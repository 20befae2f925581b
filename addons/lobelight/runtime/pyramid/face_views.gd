@tool
extends RefCounted
## Viewports that show the faces of a cube, in the order +X −X +Y −Y +Z −Z: what a chain asks of
## six_views.gd, which exports leave out where light comes from panoramas only.

var viewports: Array[RID] = []


## Has a face's view drawn in the next frame.
func draw(face: int) -> void:
	RenderingServer.viewport_set_update_mode(viewports[face], RenderingServer.VIEWPORT_UPDATE_ONCE)


func get_textures() -> Array[RID]:
	var textures: Array[RID] = []
	for viewport in viewports:
		textures.append(RenderingServer.viewport_get_texture(viewport))
	return textures
