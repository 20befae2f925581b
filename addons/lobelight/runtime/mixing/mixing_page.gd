@tool
extends RefCounted
## A texture of tables side by side, and the viewport that draws them.

const CanvasPass := preload("../pyramid/canvas_pass.gd")
const WidthsTexture := preload("../table/widths_texture.gd")

const _SHADER := preload("mix_tables.gdshader")
# What OpenGL ES 3.0 guarantees (table 6.28).
const _MOST_TEXELS := 2048
# Viewports are drawn in the order of their depth in the tree. At this depth the page is drawn
# before every viewport that shows a material.
const _DEPTH := 8

## All tables of the set.
var source: WidthsTexture
## Whether it is drawn in the next frame; its places share the array.
var due: Array[bool] = [false]

var _pass: CanvasPass
var _canvas: RID
var _material: RID
var _parents: Array[RID] = []
var _extent: Vector2i
var _is_taken: Array[bool] = []
var _mutex := Mutex.new()


## A page of [param places] of the set's tables, or as many as it can have.
func _init(from: WidthsTexture, tables: LobeTableSet, places: int) -> void:
	source = from
	_extent = Vector2i(tables.views.x, tables.views.y * tables.lobe_count)
	@warning_ignore("integer_division")
	_is_taken.resize(clampi(places, 1, maxi(1, _MOST_TEXELS / _extent.x)))
	var server := RenderingServer
	_pass = CanvasPass.new(_extent * Vector2i(_is_taken.size(), 1), true)
	_canvas = server.canvas_create()
	server.viewport_attach_canvas(_pass.viewport, _canvas)
	_material = server.material_create()
	server.material_set_shader(_material, _SHADER.get_rid())
	server.material_set_param(_material, &"tables", source.texture.get_rid())
	server.material_set_param(_material, &"azimuths", tables.views.y)
	server.material_set_param(_material, &"lobelight_widths", source.levels)
	var child := _pass.viewport
	for level in _DEPTH:
		var parent := server.viewport_create()
		server.viewport_set_update_mode(parent, RenderingServer.VIEWPORT_UPDATE_DISABLED)
		server.viewport_set_active(parent, true)
		server.viewport_set_parent_viewport(child, parent)
		_parents.append(parent)
		child = parent


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		RenderingServer.viewport_remove_canvas(_pass.viewport, _canvas)
		RenderingServer.viewport_set_parent_viewport(_pass.viewport, RID())
		for rid: RID in [_canvas, _material] + _parents:
			RenderingServer.free_rid(rid)


func has_place() -> bool:
	_mutex.lock()
	var place := _is_taken.find(false)
	_mutex.unlock()
	return place >= 0


## To be called where there is one.
func take_place() -> int:
	_mutex.lock()
	var place := _is_taken.find(false)
	_is_taken[place] = true
	_mutex.unlock()
	return place


func give_back(place: int) -> void:
	_mutex.lock()
	_is_taken[place] = false
	_mutex.unlock()


## What draws the table in a place; the caller frees it.
func make_item(place: int) -> RID:
	var item := RenderingServer.canvas_item_create()
	RenderingServer.canvas_item_set_parent(item, _canvas)
	RenderingServer.canvas_item_set_material(item, _material)
	RenderingServer.canvas_item_add_rect(item, Rect2i(Vector2i.ZERO, _extent), Color.WHITE)
	var origin := Vector2(place * _extent.x, 0.0)
	RenderingServer.canvas_item_set_transform(item, Transform2D(0.0, origin))
	return item


func get_texture() -> RID:
	return _pass.get_texture()


## As [method LobeTable.get_lookup], for the table in a place.
func get_lookup(place: int) -> Vector4:
	var share := 1.0 / _is_taken.size()
	var own := source.lookup
	return Vector4(own.x * share, (own.y + place) * share, own.z, own.w)


## Has all its tables drawn in the next frame, before anything else.
func draw() -> void:
	if due[0]:
		return
	due[0] = true
	RenderingServer.frame_post_draw.connect(_on_drawn, CONNECT_ONE_SHOT)
	_pass.draw()


func _on_drawn() -> void:
	due[0] = false
