extends SceneTree
## Bakes brushed.res with the addon's library: [code]--script res://bake.gd[/code].


func _initialize() -> void:
	var baker := LobeBaker.new()
	if not baker.start({"brdf": "ward", "alpha": [0.05, 0.2], "lobes": 4, "views": [8, 4]}):
		printerr("bake: ", baker.get_error())
		quit(1)
		return
	while baker.is_running():
		OS.delay_msec(10)
	var table := LobeTable.from_baked(baker.get_result())
	quit(0 if ResourceSaver.save(table, "res://brushed.res") == OK else 1)
