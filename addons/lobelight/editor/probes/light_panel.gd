@tool
extends VBoxContainer
## Where a probe's light comes from, and the buttons that bake it and go back to captures. It stands
## at the top of the probe's inspector.

const LightBakes := preload("light_bakes.gd")

const _LIVE := "Live: the room is captured when the game runs."

## The probe whose light it is.
var probe: LobeProbe3D

var _bakes: LightBakes
var _source := Label.new()
var _bake := Button.new()
var _clear := Button.new()
var _status := Label.new()


static func make(bakes: LightBakes, for_probe: LobeProbe3D) -> VBoxContainer:
	var panel := new()
	panel._bakes = bakes
	panel.probe = for_probe
	panel._build()
	return panel


func _build() -> void:
	_bake.tooltip_text = "Captures the room, and saves its light in a file beside the scene."
	_clear.text = "Clear Baked Light"
	_clear.tooltip_text = "The room is captured when the game runs again. The file stays."
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
	_bakes.add(probe)


## What the button Clear Baked Light does.
func press_clear() -> void:
	_status.visible = false
	_bakes.clear(probe)


## Where the light comes from, in a sentence.
func get_source() -> String:
	return _source.text


## What is said of the last bake; empty if there is nothing to say.
func get_status() -> String:
	return _status.text if _status.visible else ""


func _update_state() -> void:
	if not is_instance_valid(probe):
		return
	var baking := _bakes.is_baking(probe)
	_bake.text = "Baking …" if baking else "Bake Light"
	_bake.disabled = baking
	_clear.visible = probe.light != null
	_clear.disabled = baking
	_source.text = _LIVE if probe.light == null else _describe(probe.light)


static func _describe(light: LobeLight) -> String:
	var problem := light.get_problem()
	if problem:
		return problem
	var path := light.resource_path
	var place := (
		"the scene's own file" if path.is_empty() or path.contains("::") else path.get_file()
	)
	return "Baked: %d texels, in %s." % [light.size, place]


func _on_failed(failed_probe: LobeProbe3D, message: String) -> void:
	if failed_probe == probe:
		_say(message, &"error_color")


func _on_baked(baked_probe: LobeProbe3D) -> void:
	if baked_probe == probe:
		_status.visible = false


func _on_cancelled(cancelled_probe: LobeProbe3D) -> void:
	if cancelled_probe == probe:
		_say("Cancelled; the light is the one from before.", &"warning_color")


func _say(text: String, color: StringName) -> void:
	_status.text = text
	_status.visible = true
	_status.add_theme_color_override(&"font_color", get_theme_color(color, &"Editor"))
