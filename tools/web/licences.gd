extends SceneTree
## Writes the licences of the engine and of all that is linked into it to the file that is named: `-- FILE`.

const RULE := "=============================================================================="


func _initialize() -> void:
	var parts: PackedStringArray = ["%s\nGodot Engine\n%s\n\n%s" % [RULE, RULE, Engine.get_license_text().strip_edges()]]
	parts.append("The engine contains:\n")
	for component in Engine.get_copyright_info():
		for part: Dictionary in component["parts"]:
			var holders := "; ".join(part["copyright"] as PackedStringArray)
			parts.append("%s: (c) %s; %s" % [component["name"], holders, part["license"]])
	var texts := Engine.get_license_info()
	for licence: String in texts:
		parts.append("\n%s\n%s\n%s\n\n%s" % [RULE, licence, RULE, (texts[licence] as String).strip_edges()])
	var path := OS.get_cmdline_user_args()[0]
	var file := FileAccess.open(path, FileAccess.WRITE)
	if file == null or not file.store_string("\n".join(parts) + "\n"):
		printerr("licences: %s cannot be written: %s" % [path, error_string(FileAccess.get_open_error())])
		quit(1)
		return
	quit()
