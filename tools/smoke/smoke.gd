extends SceneTree
## Loads the editor's library and bakes a small table, in a project with the addon:
## [code]--script res://smoke.gd -- NAME[/code]. The last line says how much of it held; smoke.json,
## beside it, too.

const CLASSES: PackedStringArray = ["LobeBaker", "LobeImageFile", "LobeReference", "LobeTask"]
const RECIPE := {"brdf": "ward_bounded", "alpha": [0.1, 0.2], "lobes": 4, "views": [6, 3]}
## The share by which the light of the lobes may differ from what the BRDF reflects.
const MOST_ERROR := 0.005

var _checks: Dictionary[String, bool] = {}


func _initialize() -> void:
	for name in CLASSES:
		_check("the library has %s" % name, ClassDB.class_exists(name))
	if ClassDB.class_exists(&"LobeBaker"):
		_bake(ClassDB.instantiate(&"LobeBaker"))
	_finish()


func _bake(baker: RefCounted) -> void:
	var result: Dictionary = baker.call("bake", RECIPE)
	_check("a table is baked", not result.has("error"))
	if result.has("error"):
		printerr(result["error"])
		return
	var table := LobeTable.from_baked(result)
	_check("the table is sound", table.get_problem().is_empty())
	_check("it can be saved", ResourceSaver.save(table, "res://baked.res") == OK)
	var loaded: LobeTable = load("res://baked.res")
	_check("it can be loaded", loaded.image.get_data() == table.image.get_data())
	var view := loaded.get_view(2, 1)
	var albedo: Variant = baker.call("directional_albedo", "ward_bounded", Vector2(0.1, 0.2), view)
	var error := absf(loaded.directional_albedo(view) - float(albedo)) / float(albedo)
	_check("its lobes hold the light of the BRDF", error < MOST_ERROR)
	_check(
		"a bad recipe is refused", (baker.call("bake", {"brdf": "none"}) as Dictionary).has("error")
	)


func _check(what: String, holds: bool) -> void:
	_checks[what] = holds
	print("  %s: %s" % [what, "passed" if holds else "FAILED"])


func _finish() -> void:
	var passed := _checks.values().count(true)
	var failed := _checks.size() - passed
	var arguments := OS.get_cmdline_user_args()
	var summary := {
		"library": arguments[0] if arguments else "",
		"engine": Engine.get_version_info()["string"],
		"passed": passed,
		"failed": failed,
		"checks": _checks,
	}
	var file := FileAccess.open("res://smoke.json", FileAccess.WRITE)
	file.store_string(JSON.stringify(summary, "  ") + "\n")
	print("smoke: %d passed, %d failed" % [passed, failed])
	quit(mini(failed, 1))
