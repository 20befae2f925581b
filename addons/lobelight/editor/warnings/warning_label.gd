@tool
extends Label
## A sentence in the inspector, in the colour that the editor's theme has for warnings.


func _init(sentence := "") -> void:
	text = sentence
	autowrap_mode = TextServer.AUTOWRAP_WORD_SMART


func _enter_tree() -> void:
	add_theme_color_override(&"font_color", get_theme_color(&"warning_color", &"Editor"))
