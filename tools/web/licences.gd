extends SceneTree
## Writes the licences of the engine and of all that is linked into it to a file: `-- FILE`.

const RULE := "=============================================================================="


func _initialize() -> void:
	var parts: PackedStringArray = [_make_chapter("Godot Engine", Engine.get_license_text())]
	parts.append("\nThe engine contains:\n")
	for component in Engine.get_copyright_info():
		for part: Dictionary in component["parts"]:
			var holders := "; ".join(part["copyright"] as PackedStringArray)
			parts.append("%s: (c) %s; %s" % [component["name"], holders, part["license"]])
	var texts := Engine.get_license_info()
	for licence: String in texts:
		parts.append("\n" + _make_chapter(licence, texts[licence]))
	var path := OS.get_cmdline_user_args()[0]
	var file := FileAccess.open(path, FileAccess.WRITE)
	if file == null or not file.store_string("\n".join(parts) + "\n"):
		printerr("licences: %s cannot be written" % path)
		quit(1)
		return
	quit()


static func _make_chapter(title: String, text: String) -> String:
	return "%s\n%s\n%s\n\n%s" % [RULE, title, RULE, text.strip_edges()]
