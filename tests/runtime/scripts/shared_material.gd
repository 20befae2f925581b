extends SceneTree
## Threads bring one material up to date, as a loader's and the main thread may; exit_test.gd looks
## at how it ends.

const THREADS := 4
const UPDATES := 1500


func _process(_delta: float) -> bool:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.roughness = 0.3
	material.anisotropy = 0.6
	material.anisotropy_enabled = true
	material.clearcoat = 1.0
	material.clearcoat_enabled = true
	var threads: Array[Thread] = []
	for i in THREADS:
		var thread := Thread.new()
		thread.start(_update_often.bind(material))
		threads.append(thread)
	for thread in threads:
		thread.wait_to_finish()
	return true


static func _update_often(material: LobeMaterial3D) -> void:
	for i in UPDATES:
		material._update()
