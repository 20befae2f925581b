extends Node3D


func _process(_delta: float) -> void:
	var material: LobeMaterial3D = ($Ball as MeshInstance3D).get_surface_override_material(0)
	material.roughness = 0.35 + 0.05 * sin(0.001 * Time.get_ticks_msec())
