@tool
extends RefCounted
## A viewport in which canvas shaders fill rectangles, in any renderer.
##
## It stays, so that drawing again allocates nothing. Passes are drawn in the order in which they
## were made, so that within one frame a later one reads what an earlier one has drawn. Everything
## on the rendering server is freed with the object.

var viewport: RID

var _extent: Vector2i
# Of the rectangles.
var _items: Array[RID] = []
# Whether the last draw was of some rows only.
var _is_clipped := false
# Freed in this order.
var _rids: Array[RID] = []


## A pass of [param extent] pixels: half floats that keep what the shader writes, or bytes.
func _init(extent: Vector2i, half_floats: bool) -> void:
	var server := RenderingServer
	viewport = server.viewport_create()
	server.viewport_set_disable_3d(viewport, true)
	server.viewport_set_use_hdr_2d(viewport, half_floats)
	# Opaque viewports may have two bits of alpha.
	server.viewport_set_transparent_background(viewport, true)
	server.viewport_set_size(viewport, extent.x, extent.y)
	server.viewport_set_update_mode(viewport, RenderingServer.VIEWPORT_UPDATE_DISABLED)
	server.viewport_set_active(viewport, true)
	_rids.append(viewport)
	_extent = extent


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		for rid in _rids:
			RenderingServer.free_rid(rid)


## Adds a rectangle with a [code]canvas_item[/code] shader; returns its material.
func add_rect(rect: Rect2i, shader: Shader, parameters: Dictionary[StringName, Variant]) -> RID:
	var server := RenderingServer
	var material := server.material_create()
	server.material_set_shader(material, shader.get_rid())
	for name: StringName in parameters:
		server.material_set_param(material, name, parameters[name])
	var item := server.canvas_item_create()
	server.canvas_item_add_rect(item, rect, Color.WHITE)
	server.canvas_item_set_material(item, material)
	var canvas := server.canvas_create()
	server.canvas_item_set_parent(item, canvas)
	server.viewport_attach_canvas(viewport, canvas)
	_items.append(item)
	_rids.append_array([canvas, item, material])
	return material


## Has the pass drawn in the next frame.
func draw() -> void:
	if _is_clipped:
		_clip(Rect2i(Vector2i.ZERO, _extent), RenderingServer.VIEWPORT_CLEAR_ALWAYS)
		_is_clipped = false
	RenderingServer.viewport_set_update_mode(viewport, RenderingServer.VIEWPORT_UPDATE_ONCE)


## Has [param count] rows from [param first] on drawn in the next frame; the others stay.
func draw_rows(first: int, count: int) -> void:
	_clip(Rect2i(0, first, _extent.x, count), RenderingServer.VIEWPORT_CLEAR_NEVER)
	_is_clipped = true
	RenderingServer.viewport_set_update_mode(viewport, RenderingServer.VIEWPORT_UPDATE_ONCE)


func get_texture() -> RID:
	return RenderingServer.viewport_get_texture(viewport)


# Items that clip do so by their rectangle.
func _clip(rect: Rect2i, clear_mode: RenderingServer.ViewportClearMode) -> void:
	for item in _items:
		RenderingServer.canvas_item_set_custom_rect(item, true, rect)
		RenderingServer.canvas_item_set_clip(item, true)
	RenderingServer.viewport_set_clear_mode(viewport, clear_mode)
