extends SceneTree
## Draws an SVG as a square PNG:
## [code]godot --headless --script draw_icon.gd -- IN.svg OUT.png SIDE[/code].


func _initialize() -> void:
	var arguments := OS.get_cmdline_user_args()
	quit(_draw(arguments[0], arguments[1], arguments[2].to_int()))


static func _draw(source: String, target: String, side: int) -> int:
	var text := FileAccess.get_file_as_string(source)
	var image := Image.new()
	if image.load_svg_from_string(text) != OK or image.get_width() != image.get_height():
		printerr("%s is no square SVG." % source)
		return 1
	image.load_svg_from_string(text, float(side) / image.get_width())
	return 0 if image.save_png(target) == OK else 1
