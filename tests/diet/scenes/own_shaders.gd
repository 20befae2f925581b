extends Node3D
## Binds a material whose shader includes what the addon has for others.


func _ready() -> void:
	LobeLight.bind(($Other as MeshInstance3D).get_active_material(0) as ShaderMaterial)
