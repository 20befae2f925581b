extends CanvasLayer
## The interactive demo's controls, in a panel at the side, or below where the picture is higher
## than wide.

const Controls := preload("controls.gd")
const DemoRoot := preload("../demo.gd")
const Divider := preload("divider.gd")
const FrameTimes := preload("frame_times.gd")
const Look := preload("look.gd")
const Methods := preload("../methods.gd")
const _MARGIN := 12.0
const _PANEL_WIDTH := 342.0
## Of the height, in portrait.
const _SHEET_SHARE := 0.42
# Of the labels' text, in seconds.
const _REFRESH := 0.25

## Pixels of a unit of the interface; 0 for what the screen's density asks for.
var ui_scale := 0.0:
	set(value):
		ui_scale = value
		arrange()
## Whether the titles say how long frames take.
var shows_times := true
## Whether the panel is open.
var is_open := true:
	set(value):
		is_open = value
		arrange()

var controls := Controls.new()
var divider := Divider.new()
var fold := Button.new()
var left_title := _make_title()
var right_title := _make_title()

var _demo: DemoRoot
var _root := Control.new()
var _times := FrameTimes.new()
var _since_refresh := INF
# Where the divider's handle goes at most.
var _most_divider := 1.0


func _ready() -> void:
	_demo = get_parent()
	layer = 1
	_root.theme = Look.make_theme()
	_root.mouse_filter = Control.MOUSE_FILTER_IGNORE
	add_child(_root)
	for part: Control in [divider, left_title, right_title, controls, fold]:
		_root.add_child(part)
	divider.moved.connect(_move_divider)
	fold.focus_mode = Control.FOCUS_NONE
	fold.pressed.connect(func() -> void: is_open = not is_open)
	# The demo's own _ready comes after that of its children.
	_demo.ready.connect(_start)
	visibility_changed.connect(arrange)
	get_viewport().size_changed.connect(arrange)


func _start() -> void:
	controls.set_up(_demo)
	# What is shown may need more controls than before.
	_demo.changed.connect(arrange)
	arrange()


func _process(delta: float) -> void:
	if not visible:
		return
	_times.add_frame(_demo.compare_view.get_viewports())
	_since_refresh += delta
	if _since_refresh >= _REFRESH:
		_since_refresh = 0.0
		_show_titles()


func _unhandled_key_input(event: InputEvent) -> void:
	var key := event as InputEventKey
	if not key.pressed or key.echo:
		return
	match key.keycode:
		KEY_E:
			Controls.choose_next(controls.environments)
		KEY_L:
			Controls.choose_next(controls.lobes)
		KEY_M:
			Controls.choose_next(controls.left)
		KEY_B:
			Controls.choose_next(controls.right)
		KEY_R:
			controls.is_turning = not controls.is_turning
		KEY_H:
			is_open = not is_open
		KEY_LEFT:
			_demo.divider -= 0.02
		KEY_RIGHT:
			_demo.divider += 0.02
		KEY_ESCAPE:
			# A page stays, and would be dead.
			if not OS.has_feature("web"):
				get_tree().quit()


## Lays the controls out for the viewport's size.
func arrange() -> void:
	if not is_inside_tree() or _demo == null or not _demo.is_node_ready():
		return
	var unit := ui_scale if ui_scale > 0.0 else _get_density()
	scale = unit * Vector2.ONE
	var size := get_viewport().get_visible_rect().size / unit
	_root.size = size
	var is_portrait := size.y > size.x
	var panel := _get_panel(size, is_portrait)
	controls.visible = is_open
	controls.position = panel.position
	controls.size = panel.size
	fold.text = "Hide" if is_open else "Controls"
	fold.size = Vector2(104.0, Look.TOUCH)
	fold.position = Vector2(size.x - fold.size.x - _MARGIN, _MARGIN)
	var free := Rect2(Vector2.ZERO, size)
	if is_open and visible:
		free.size -= (
			Vector2(0.0, size.y - panel.position.y)
			if is_portrait
			else Vector2(size.x - panel.position.x, 0.0)
		)
	_demo.camera.free_area = Rect2(free.position * unit, free.size * unit)
	left_title.position = Vector2(_MARGIN, _MARGIN)
	divider.size = Vector2(Look.TOUCH, free.size.y)
	# Where the panel is not, so that the handle can be taken again.
	_most_divider = free.size.x / size.x if is_open and not is_portrait else 1.0
	_show_state()


func _move_divider(to: float) -> void:
	_demo.divider = minf(to, _most_divider)


func _get_panel(size: Vector2, is_portrait: bool) -> Rect2:
	if is_portrait:
		var height := _SHEET_SHARE * size.y
		return Rect2(_MARGIN, size.y - height, size.x - 2.0 * _MARGIN, height - _MARGIN)
	var top := 2.0 * _MARGIN + Look.TOUCH
	var height := minf(controls.get_whole_height(), size.y - top - _MARGIN)
	return Rect2(size.x - _PANEL_WIDTH, top, _PANEL_WIDTH - _MARGIN, height)


# Android's density-independent pixels; elsewhere the desktop's scale.
func _get_density() -> float:
	if OS.has_feature("mobile"):
		return maxf(DisplayServer.screen_get_dpi() / 160.0, 1.0)
	return maxf(DisplayServer.screen_get_scale(), 1.0)


func _make_title() -> Label:
	var title := Label.new()
	title.mouse_filter = Control.MOUSE_FILTER_IGNORE
	title.add_theme_stylebox_override(&"normal", Look.make_box(Look.PANEL, 8, 10))
	return title


func _show_state() -> void:
	var is_comparing := _demo.right_method != Methods.NONE
	var width := _root.size.x
	divider.visible = is_comparing
	divider.position = Vector2(_demo.divider * width - 0.5 * divider.size.x, 0.0)
	divider.queue_redraw()
	_show_titles()


func _show_titles() -> void:
	var is_comparing := _demo.right_method != Methods.NONE
	var left_lines: PackedStringArray = [Methods.title_of(_demo.left_method, _demo.lobe_count)]
	if shows_times:
		left_lines.append_array([_times.get_gpu_text(0), _times.get_frame_text()])
	if _demo.missing_tables:
		left_lines.append("Tables are missing: run ./dev demo --window.")
	_set_lines(left_title, left_lines)
	right_title.visible = is_comparing and _demo.divider < 1.0
	if right_title.visible:
		var right_lines: PackedStringArray = [
			Methods.title_of(_demo.right_method, _demo.lobe_count)
		]
		if shows_times:
			right_lines.append(_times.get_gpu_text(1))
		_set_lines(right_title, right_lines)
		# Below the left one and the button, so that the three never meet.
		var below := maxf(left_title.size.y, Look.TOUCH) + 2.0 * _MARGIN
		var most := _root.size.x - right_title.size.x - _MARGIN
		if controls.visible and controls.position.y < below + right_title.size.y:
			most = controls.position.x - right_title.size.x - _MARGIN
		var at := _demo.divider * _root.size.x + _MARGIN
		right_title.position = Vector2(clampf(at, _MARGIN, maxf(most, _MARGIN)), below)


# Those that are not empty.
static func _set_lines(title: Label, lines: PackedStringArray) -> void:
	title.text = "\n".join(
		Array(lines).filter(func(line: String) -> bool: return not line.is_empty())
	)
	title.reset_size()
