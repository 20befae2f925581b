@tool
extends Node
## A hand in the running editor: it moves the mouse, clicks, turns the wheel and types, by events
## that take the same way through the windows as a user's. The editor is to have a single window.

const Finder := preload("finder.gd")

# Time for the editor to follow.
const _PAUSE := 0.25
const _STEP := 0.05
const _WHEEL_TURNS := 60
const _MENU_TURNS := 20

## Clicks made so far; a drag is one.
var clicks := 0
## What could not be done, in sentences.
var problems: PackedStringArray = []

var _place := Vector2.ZERO
var _held: MouseButtonMask = 0


## Clicks the middle of a control.
func click(control: Control, what: String) -> void:
	if control == null:
		fail("%s is not there" % what)
		return
	await click_at(find_rect(control).get_center(), control, what)


## Clicks a place, where [param control] or a part of it has to be on top.
func click_at(place: Vector2, control: Control, what: String) -> void:
	await move(place)
	var hovered := control.get_viewport().gui_get_hovered_control()
	if hovered != control and (hovered == null or not control.is_ancestor_of(hovered)):
		fail("%s is covered by %s" % [what, hovered])
	await _press(what)


## Clicks an item of a menu in a window, once it is open.
func choose(root: Node, text: String) -> void:
	await choose_from(await find_menu(root, text), text)


## The open menu that has an item, as soon as there is one.
func find_menu(root: Node, text: String) -> PopupMenu:
	for turn in _MENU_TURNS:
		var menu := Finder.menu(root, text)
		if menu != null:
			return menu
		await wait(_PAUSE)
	return null


## Clicks an item of an open menu.
func choose_from(menu: PopupMenu, text: String) -> void:
	if await _point_at(menu, text) >= 0:
		await _press(text)


## Opens a submenu by resting the mouse on its item.
func open_submenu(menu: PopupMenu, text: String) -> PopupMenu:
	var index := await _point_at(menu, text)
	if index < 0:
		return null
	await wait(0.8)
	var submenu := menu.get_item_submenu_node(index)
	if not submenu.visible:
		fail("the menu %s does not open" % text)
	return submenu


## Clicks an item of a tree.
func choose_item(tree: Tree, item: TreeItem, column: int, what: String) -> void:
	if tree == null or item == null:
		fail("%s is not there" % what)
		return
	var rect := tree.get_item_area_rect(item, column)
	var place := find_rect(tree).position + rect.get_center() - tree.get_scroll()
	place.x = minf(place.x, find_rect(tree).end.x - 24.0)
	await click_at(place, tree, what)


## Clicks a tab.
func choose_tab(bar: TabBar, title: String) -> void:
	if bar == null:
		fail("there is no tab " + title)
		return
	var rect := bar.get_tab_rect(Finder.tab(bar, title))
	await click_at(find_rect(bar).position + rect.get_center(), bar, title)
	await wait(_PAUSE)


## Drags from the middle of a control to the side.
func drag(control: Control, by: Vector2, what: String) -> void:
	if control == null:
		fail("%s is not there" % what)
		return
	await drag_from(find_rect(control).get_center(), by, what)


## Drags a place to the side.
func drag_from(place: Vector2, by: Vector2, what: String) -> void:
	await move(place)
	_button(MOUSE_BUTTON_LEFT, true)
	clicks += 1
	for part in 10:
		await move(_place + by / 10.0)
	_button(MOUSE_BUTTON_LEFT, false)
	print("%2d drag %s" % [clicks, what])
	await wait(_PAUSE)


## Turns the wheel over a list until a control in it shows whole.
func scroll_to(list: Control, control: Control) -> void:
	if control == null:
		return
	await move(find_rect(list).get_center())
	for turn in _WHEEL_TURNS:
		var rect := find_rect(control)
		var frame := find_rect(list).grow(-8.0)
		if rect.position.y >= frame.position.y and rect.end.y <= frame.end.y:
			await wait(_PAUSE)
			return
		var is_below := rect.end.y > frame.end.y
		var wheel := MOUSE_BUTTON_WHEEL_DOWN if is_below else MOUSE_BUTTON_WHEEL_UP
		await turn_wheel(wheel)
	fail("%s cannot be scrolled to" % control)


## Turns the wheel once where the mouse is.
func turn_wheel(wheel: MouseButton) -> void:
	_button(wheel, true)
	_button(wheel, false)
	await wait(_STEP)


## Presses or lets go of a key.
func hold(key: Key, pressed: bool) -> void:
	var event := InputEventKey.new()
	event.keycode = key
	event.pressed = pressed
	Input.parse_input_event(event)


func type(text: String) -> void:
	for character in text:
		for pressed: bool in [true, false]:
			var event := InputEventKey.new()
			event.unicode = character.unicode_at(0)
			event.keycode = OS.find_keycode_from_string(character.to_upper())
			event.pressed = pressed
			Input.parse_input_event(event)
		await wait(0.05)
	await wait(_PAUSE)


func move(place: Vector2) -> void:
	var event := InputEventMouseMotion.new()
	event.position = place
	event.global_position = place
	event.relative = place - _place
	# Menus take no notice of a mouse that stands still.
	event.velocity = event.relative / _STEP
	event.button_mask = _held
	_place = place
	Input.parse_input_event(event)
	await wait(_STEP)


func wait(seconds: float) -> void:
	await get_tree().create_timer(seconds).timeout


## Notes what could not be done, and goes on.
func fail(problem: String) -> void:
	problems.append(problem)
	printerr("guide: " + problem)


## Where a control is in the editor's window.
func find_rect(control: Control) -> Rect2:
	return Rect2(control.get_screen_position(), control.size)


func _press(what: String) -> void:
	# In one frame: menus that open by the press may take a later release for a choice.
	_button(MOUSE_BUTTON_LEFT, true)
	_button(MOUSE_BUTTON_LEFT, false)
	clicks += 1
	print("%2d click %s" % [clicks, what])
	await wait(_PAUSE)


func _button(index: MouseButton, pressed: bool) -> void:
	var event := InputEventMouseButton.new()
	event.button_index = index
	event.pressed = pressed
	event.position = _place
	event.global_position = _place
	if index == MOUSE_BUTTON_LEFT:
		_held = MOUSE_BUTTON_MASK_LEFT if pressed else 0 as MouseButtonMask
	event.button_mask = _held
	Input.parse_input_event(event)


# Where items lie, menus do not tell; which one the mouse is on, they do. It is looked for around
# where it would be if all were equally high: on the way from above, submenus would open.
func _point_at(menu: PopupMenu, text: String) -> int:
	if menu == null or not menu.visible:
		fail("there is no menu with %s" % text)
		return -1
	var index := -1
	for item in menu.item_count:
		if menu.get_item_text(item) == text:
			index = item
	var middle := (index + 0.5) * menu.size.y / menu.item_count
	for offset in range(0, menu.size.y, 3):
		for y: float in [middle + offset, middle - offset]:
			if index >= 0 and y > 0.0 and y < menu.size.y:
				await move(Vector2(menu.position) + Vector2(0.3 * menu.size.x, y))
				if menu.get_focused_item() == index:
					return index
	fail("the mouse does not find %s" % text)
	return -1
