@tool
extends TextureCubemapArrayRD
## An array of cube maps that frees its texture of the rendering device.


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		# Not by the method below: the object is no longer whole.
		var before := texture_rd_rid
		texture_rd_rid = RID()
		if before.is_valid():
			RenderingServer.call_on_render_thread(_free.bind(before))


## Shows this texture from now on and frees the one before.
func set_owned(texture: RID) -> void:
	var before := texture_rd_rid
	texture_rd_rid = texture
	if before.is_valid():
		RenderingServer.call_on_render_thread(_free.bind(before))


static func _free(texture: RID) -> void:
	RenderingServer.get_rendering_device().free_rid(texture)
