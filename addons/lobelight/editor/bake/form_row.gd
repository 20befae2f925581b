@tool
extends HBoxContainer
## A row of a form as the inspector draws its properties: a name, and beside it what is set.

var _label := Label.new()


static func make(text: String, control: Control, tooltip := "") -> HBoxContainer:
	var row := new()
	row._label.text = text
	row._label.clip_text = true
	row._label.mouse_filter = Control.MOUSE_FILTER_PASS
	for part: Control in [row._label, control]:
		part.size_flags_horizontal = Control.SIZE_EXPAND_FILL
		part.tooltip_text = tooltip
		row.add_child(part)
	return row


## A field for a number, as the inspector has them.
static func make_number(least: float, most: float, step: float, suffix := "") -> EditorSpinSlider:
	var field := EditorSpinSlider.new()
	field.min_value = least
	field.max_value = most
	field.step = step
	field.suffix = suffix
	field.hide_slider = false
	return field


## A choice of one of some texts.
static func make_choice(texts: PackedStringArray) -> OptionButton:
	var choice := OptionButton.new()
	choice.clip_text = true
	for text in texts:
		choice.add_item(text)
	return choice
