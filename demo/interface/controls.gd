extends PanelContainer
## The panel of controls: what is shown, by which methods, and the widths of the objects.

const DemoRoot := preload("../demo.gd")
const DemoTables := preload("../demo_tables.gd")
const Look := preload("look.gd")
const Methods := preload("../methods.gd")
const _TURN_PER_SECOND := 0.5
# As the labels' longest word.
const _LABEL_WIDTH := 92.0

var is_turning := false:
	set(value):
		is_turning = value
		turning.set_pressed_no_signal(value)

var environments := OptionButton.new()
var turning := CheckButton.new()
var turn := HSlider.new()
var left := OptionButton.new()
var right := OptionButton.new()
var lobes := OptionButton.new()
var objects := OptionButton.new()
var roughness := HSlider.new()
var anisotropy := HSlider.new()
var direction := HSlider.new()
var reset := Button.new()
## Shown where there is a lamp to switch.
var lamp := CheckButton.new()

var _demo: DemoRoot
# The objects among which one can be chosen.
var _listed := []
var _rows := VBoxContainer.new()
var _values: Dictionary[HSlider, Label] = {}


## Builds the controls of a demo.
func set_up(demo: DemoRoot) -> void:
	_demo = demo
	var scroll := ScrollContainer.new()
	scroll.horizontal_scroll_mode = ScrollContainer.SCROLL_MODE_DISABLED
	add_child(scroll)
	_rows.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	_rows.add_theme_constant_override(&"separation", 4)
	# Room for the bar by which the panel is scrolled.
	var inset := MarginContainer.new()
	inset.add_theme_constant_override(&"margin_right", 6)
	inset.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	inset.add_child(_rows)
	scroll.add_child(inset)
	_add_environment()
	_add_methods()
	_add_widths()
	demo.changed.connect(show_state)
	show_state()


## The height at which nothing has to be scrolled.
func get_whole_height() -> float:
	var frame := get_theme_stylebox(&"panel").get_minimum_size().y
	return _rows.get_combined_minimum_size().y + frame


## The next item of an option button, around the end.
static func choose_next(options: OptionButton) -> void:
	var index := options.selected
	for step in options.item_count:
		index = (index + 1) % options.item_count
		if not options.is_item_disabled(index):
			break
	options.select(index)
	options.item_selected.emit(index)


## Shows what the demo shows.
func show_state() -> void:
	environments.select(_demo.environment_index)
	left.select(left.get_item_index(_demo.left_method))
	right.select(right.get_item_index(_demo.right_method + 1))
	lobes.select(lobes.get_item_index(_demo.lobe_count))
	_show_objects()
	turning.text = _get_turning_text()
	lamp.get_parent_control().visible = _demo.is_inside()
	lamp.set_pressed_no_signal(_demo.is_lamp_on())
	_show_methods()
	_show_value(turn, fposmod(rad_to_deg(_demo.turn), 360.0), "%.0f°")
	var widths := _demo.get_widths()
	_show_value(roughness, widths.x, "%.2f")
	_show_value(anisotropy, widths.y, "%.2f")
	_show_value(direction, rad_to_deg(widths.z), "%.0f°")


func _process(delta: float) -> void:
	if is_turning:
		_demo.turn += _TURN_PER_SECOND * delta
		_show_value(turn, fposmod(rad_to_deg(_demo.turn), 360.0), "%.0f°")


func _get_turning_text() -> String:
	if _demo.is_inside():
		return "Roll the ball"
	return "Move the lamp" if _demo.is_live() else "Turn"


# What is shown has objects of its own.
func _show_objects() -> void:
	if not is_same(_listed, _demo.objects):
		_listed = _demo.objects
		objects.clear()
		objects.add_item("All objects", 0)
		for index in _listed.size():
			objects.add_item(_listed[index].title, index + 1)
	objects.select(objects.get_item_index(_demo.chosen + 1))


# What has not been baked, and what has no rooms in the interior, cannot be chosen.
func _show_methods() -> void:
	for method: int in Methods.Method.values():
		var is_missing := method == Methods.Method.THESIS and DemoTables.thesis_set() == null
		var is_off := is_missing or _demo.is_inside() and not Methods.has_rooms(method)
		left.set_item_disabled(left.get_item_index(method), is_off)
		right.set_item_disabled(right.get_item_index(method + 1), is_off)


func _add_environment() -> void:
	for setting in _demo.settings:
		environments.add_item(setting.title)
	environments.item_selected.connect(func(index: int) -> void: _demo.environment_index = index)
	_add_row("Light", environments)
	turning.toggled.connect(func(pressed: bool) -> void: is_turning = pressed)
	_add_slider("Direction", turn, 0.0, 360.0, 1.0)
	turn.value_changed.connect(
		func(degrees: float) -> void:
			_demo.turn = deg_to_rad(degrees)
			_show_value(turn, degrees, "%.0f°")
	)
	_add_row("", turning)
	lamp.text = "Lamp"
	lamp.toggled.connect(func(pressed: bool) -> void: _demo.switch_lamp(pressed))
	_add_row("", lamp)


func _add_methods() -> void:
	right.add_item("Nothing", 0)
	for method: int in Methods.Method.values():
		left.add_item(Methods.TITLES[method], method)
		right.add_item(Methods.TITLES[method], method + 1)
	left.item_selected.connect(
		func(index: int) -> void: _demo.left_method = left.get_item_id(index)
	)
	right.item_selected.connect(
		func(index: int) -> void: _demo.right_method = right.get_item_id(index) - 1
	)
	for count in DemoTables.LOBE_COUNTS:
		lobes.add_item(Methods.describe_lobes(count), count)
		if DemoTables.set_of(count) == null:
			lobes.set_item_disabled(lobes.get_item_index(count), true)
	lobes.item_selected.connect(
		func(index: int) -> void: _demo.lobe_count = lobes.get_item_id(index)
	)
	_add_row("Method", left)
	_add_row("Lobes", lobes)
	_add_row("Beside it", right)


func _add_widths() -> void:
	objects.item_selected.connect(
		func(index: int) -> void: _demo.chosen = objects.get_item_id(index) - 1
	)
	_add_row("Object", objects)
	_add_slider("Roughness", roughness, 0.12, 0.8, 0.01)
	_add_slider("Anisotropy", anisotropy, 0.0, 1.0, 0.01)
	_add_slider("Brushing", direction, -90.0, 90.0, 1.0)
	for slider: HSlider in [roughness, anisotropy, direction]:
		slider.value_changed.connect(func(_value: float) -> void: _set_widths(slider))
	reset.text = "As at the start"
	reset.pressed.connect(func() -> void: _demo.reset_widths())
	_add_row("", reset)


func _set_widths(moved: HSlider) -> void:
	var widths := _demo.get_widths()
	if moved == roughness:
		widths.x = roughness.value
	elif moved == anisotropy:
		widths.y = anisotropy.value
	else:
		widths.z = deg_to_rad(direction.value)
	_demo.set_widths(widths)


func _add_row(text: String, control: Control) -> HBoxContainer:
	var row := HBoxContainer.new()
	row.add_theme_constant_override(&"separation", 8)
	var label := Label.new()
	label.text = text
	label.custom_minimum_size.x = _LABEL_WIDTH
	label.add_theme_color_override(&"font_color", Color(Look.TEXT, 0.75))
	row.add_child(label)
	control.custom_minimum_size.y = Look.TOUCH
	control.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	control.focus_mode = Control.FOCUS_NONE
	if control is BaseButton:
		# A finger that starts on a button may scroll the panel.
		control.mouse_filter = Control.MOUSE_FILTER_PASS
		(control as BaseButton).action_mode = BaseButton.ACTION_MODE_BUTTON_RELEASE
	row.add_child(control)
	_rows.add_child(row)
	return row


func _add_slider(text: String, slider: HSlider, low: float, high: float, step: float) -> void:
	slider.min_value = low
	slider.max_value = high
	slider.step = step
	slider.scrollable = false
	var value := Label.new()
	value.custom_minimum_size.x = 44.0
	value.horizontal_alignment = HORIZONTAL_ALIGNMENT_RIGHT
	_add_row(text, slider).add_child(value)
	_values[slider] = value


func _show_value(slider: HSlider, value: float, form: String) -> void:
	slider.set_value_no_signal(value)
	_values[slider].text = form % value
