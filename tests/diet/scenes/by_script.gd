extends Node3D


func _ready() -> void:
	var material: LobeMaterial3D = ($Ball as MeshInstance3D).get_surface_override_material(0)
	material.roughness = 0.25
	material.anisotropy = 0.8
	material.anisotropy_enabled = true
