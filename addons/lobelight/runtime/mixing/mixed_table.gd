@tool
extends "../material/mixed_lobes.gd"
## A table in its place on a page. It gives the place back with its end.

const MixingPage := preload("mixing_page.gd")

## Where it is.
var page: MixingPage

var _place := 0


func _init(on_page: MixingPage) -> void:
	page = on_page
	due = page.due
	_place = page.take_place()
	item = page.make_item(_place)
	texture = page.get_texture()
	lookup = page.get_lookup(_place)


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		RenderingServer.free_rid(item)
		page.give_back(_place)


func draw() -> void:
	page.draw()
