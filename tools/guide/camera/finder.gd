@tool
extends Object
## Finds the editor's controls as a user does: by what is written on them.


## The first visible button with a text, or with one that its tooltip begins with.
static func button(root: Node, text: String) -> Button:
	for node: Button in root.find_children("*", "Button", true, false):
		var is_it := node.text == text or node.tooltip_text.begins_with(text)
		if is_it and node.is_visible_in_tree():
			return node
	return null


## The first node of a native class, visible if it can be.
static func of_class(root: Node, native_class: String) -> Node:
	for node in root.find_children("*", native_class, true, false):
		var item_on_screen := node as CanvasItem
		if item_on_screen == null or item_on_screen.is_visible_in_tree():
			return node
	return null


## The first node made from a script of a name.
static func of_script(root: Node, file: String) -> Node:
	for node in root.find_children("*", "Node", true, false):
		var script := node.get_script() as Script
		if script != null and script.resource_path.get_file() == file:
			return node
	return null


## The open menu that has an item.
static func menu(root: Node, text: String) -> PopupMenu:
	for node: PopupMenu in root.find_children("*", "PopupMenu", true, false):
		for index in node.item_count if node.visible else 0:
			if node.get_item_text(index) == text:
				return node
	return null


## The visible tabs among which there is one of a title.
static func tabs(root: Node, title: String) -> TabBar:
	for node: TabBar in root.find_children("*", "TabBar", true, false):
		if node.is_visible_in_tree() and tab(node, title) >= 0:
			return node
	return null


## Which of some tabs has a title; −1 if none has.
static func tab(bar: TabBar, title: String) -> int:
	for index in bar.tab_count:
		if bar.get_tab_title(index) == title:
			return index
	return -1


## The first item of a tree with a text in a column.
static func item(root: TreeItem, text: String, column := 0) -> TreeItem:
	var found := root
	while found != null and found.get_text(column) != text:
		found = found.get_next_visible()
	return found


## The editor of a property in the inspector.
static func property(name: StringName) -> EditorProperty:
	var inspector := EditorInterface.get_inspector()
	for node: EditorProperty in inspector.find_children("*", "EditorProperty", true, false):
		if node.get_edited_property() == name:
			return node
	return null


## A section of the inspector; its tooltip is its title.
static func section(title: String) -> Control:
	var inspector := EditorInterface.get_inspector()
	for node: Control in inspector.find_children("*", "EditorInspectorSection", true, false):
		if node.is_visible_in_tree() and node.tooltip_text == title:
			return node
	return null


## A place on the title of the editor's menu bar.
static func menu_title(bar: MenuBar, title: String) -> Vector2:
	var font := bar.get_theme_font(&"font")
	var font_size := bar.get_theme_font_size(&"font_size")
	var padding := bar.get_theme_stylebox(&"normal").get_minimum_size().x
	var x := 0.0
	for index in bar.get_menu_count():
		var text := bar.get_menu_title(index)
		var width := padding + font.get_string_size(text, 0, -1, font_size).x
		if text == title:
			return Vector2(x + 0.5 * width, 0.5 * bar.size.y)
		x += width + bar.get_theme_constant(&"h_separation")
	return Vector2.ZERO
