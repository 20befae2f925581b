@tool
extends VBoxContainer
## Where the light of a probe or an environment comes from, and the buttons that bake it and go back
## to live light. It stands at the top of the node's inspector.

const LightBakes := preload("light_bakes.gd")

const LightFile := preload("light_file.gd")

## Whose light it is.
var node: Node3D

var _bakes: LightBakes
var _source := Label.new()
var _bake := Button.new()
var _clear := Button.new()
var _status := Label.new()


static func make(bakes: LightBakes, for_node: Node3D) -> VBoxContainer:
	var panel := new()
	panel._bakes = bakes
	panel.node = for_node
	panel._build()
	return panel


func _build() -> void:
	var what := (
		"Captures the room" if node is LobeProbe3D else "Filters the panorama, or the sky as it is"
	)
	_bake.tooltip_text = "%s, and saves the light in a file beside the scene." % what
	_clear.text = "Clear Baked Light"
	_clear.tooltip_text = "The light is made when the game runs again. The file stays."
	_status.visible = false
	for label: Label in [_source, _status]:
		label.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	for control: Control in [_source, _bake, _clear, _status]:
		add_child(control)
	_bake.pressed.connect(press_bake)
	_clear.pressed.connect(press_clear)


func _enter_tree() -> void:
	_bakes.changed.connect(_update_state)
	_bakes.failed.connect(_on_failed)
	_bakes.baked.connect(_on_baked)
	_bakes.cancelled.connect(_on_cancelled)
	_update_state()


func _exit_tree() -> void:
	_bakes.changed.disconnect(_update_state)
	_bakes.failed.disconnect(_on_failed)
	_bakes.baked.disconnect(_on_baked)
	_bakes.cancelled.disconnect(_on_cancelled)


## What the button Bake Light does.
func press_bake() -> void:
	_status.visible = false
	_bakes.add(node)


## What the button Clear Baked Light does.
func press_clear() -> void:
	_status.visible = false
	_bakes.clear(node)


## Where the light comes from, in a sentence.
func get_source() -> String:
	return _source.text


## What is said of the last bake; empty if there is nothing to say.
func get_status() -> String:
	return _status.text if _status.visible else ""


func _update_state() -> void:
	if not is_instance_valid(node):
		return
	var baking := _bakes.is_baking(node)
	_bake.text = "Baking …" if baking else "Bake Light"
	_bake.disabled = baking
	var light := LightFile.get_light(node)
	_clear.visible = light != null
	_clear.disabled = baking
	var live := "captured" if node is LobeProbe3D else "filtered"
	_source.text = "Live: the %s is %s when the game runs." % [_get_source_name(), live]
	if light != null:
		_source.text = _describe(light)


func _get_source_name() -> String:
	return "room" if node is LobeProbe3D else "light"


static func _describe(light: LobeLight) -> String:
	var problem := light.get_problem()
	if problem:
		return problem
	var path := light.resource_path
	var place := (
		"the scene's own file" if path.is_empty() or path.contains("::") else path.get_file()
	)
	var bytes := String.humanize_size(LightFile.count_bytes(light))
	var suns := _describe_sources(light.count_sources())
	return "Baked: %d texels%s, %s, in %s." % [light.size, suns, bytes, place]


static func _describe_sources(count: int) -> String:
	if count == 0:
		return ""
	return " and a sun or lamp" if count == 1 else " and %d suns or lamps" % count


func _on_failed(failed_node: Node3D, message: String) -> void:
	if failed_node == node:
		_say(message, &"error_color")


func _on_baked(baked_node: Node3D) -> void:
	if baked_node == node:
		_status.visible = false


func _on_cancelled(cancelled_node: Node3D) -> void:
	if cancelled_node == node:
		_say("Cancelled; the light is the one from before.", &"warning_color")


func _say(text: String, color: StringName) -> void:
	_status.text = text
	_status.visible = true
	_status.add_theme_color_override(&"font_color", get_theme_color(color, &"Editor"))
