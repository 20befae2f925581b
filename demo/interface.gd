extends CanvasLayer
## The interactive demo's controls.

const DemoRoot := preload("demo.gd")
const _TURN_PER_SECOND := 0.4

var _demo: DemoRoot
var _turning := false

@onready var _status: Label = %Status
@onready var _environments: OptionButton = %Environments
@onready var _lobes: OptionButton = %Lobes


func _ready() -> void:
	_demo = get_parent()
	for setting in _demo.settings:
		_environments.add_item(setting.title)
	for count in DemoRoot.LOBE_COUNTS:
		_lobes.add_item("%d lobes" % count, count)
	_environments.item_selected.connect(func(index: int) -> void: _demo.environment_index = index)
	_lobes.item_selected.connect(_choose_lobes)
	(%Turn as CheckButton).toggled.connect(func(pressed: bool) -> void: _turning = pressed)
	_demo.changed.connect(_show_state)
	_show_state()


func _process(delta: float) -> void:
	if _turning:
		_demo.turn += _TURN_PER_SECOND * delta


func _unhandled_key_input(event: InputEvent) -> void:
	var key := event as InputEventKey
	if not key.pressed or key.echo:
		return
	match key.keycode:
		KEY_E:
			_demo.environment_index = (_demo.environment_index + 1) % _demo.settings.size()
		KEY_L:
			_choose_lobes((_lobes.selected + 1) % _lobes.item_count)
		KEY_R:
			(%Turn as CheckButton).button_pressed = not _turning
		KEY_ESCAPE:
			get_tree().quit()


func _choose_lobes(index: int) -> void:
	_demo.lobe_count = _lobes.get_item_id(index)


func _show_state() -> void:
	_environments.select(_demo.environment_index)
	_lobes.select(_lobes.get_item_index(_demo.lobe_count))
	_status.text = "Drag to look around, wheel to come closer. E environment, L lobes, R turn."
	if _demo.missing_tables:
		_status.text = "Tables are missing: run ./dev demo --window to bake them."
