@tool
extends Texture2DRD
## A texture that frees its texture of the rendering device.

var _owned: RID


func _init(owned := RID()) -> void:
	_owned = owned
	texture_rd_rid = owned


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE and _owned.is_valid():
		texture_rd_rid = RID()
		RenderingServer.call_on_render_thread(_free.bind(_owned))


static func _free(owned: RID) -> void:
	RenderingServer.get_rendering_device().free_rid(owned)
