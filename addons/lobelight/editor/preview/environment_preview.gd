@tool
extends HBoxContainer
## Spheres from smooth to rough, and a brushed one, in the light that materials show at the moment.

const SphereView := preload("sphere_view.gd")

## Roughness and anisotropy.
const SPHERES: Array[Vector2] = [Vector2(0.1, 0.0), Vector2(0.4, 0.0), Vector2(0.4, 0.95)]

const _SIDE := 72.0


func _init() -> void:
	tooltip_text = "Metal in the environment's light: smooth, rough, and brushed."
	for look in SPHERES:
		var sphere := SphereView.new()
		var material := LobeMaterial3D.new()
		material.metallic = 1.0
		material.roughness = look.x
		material.anisotropy = look.y
		material.anisotropy_enabled = true
		sphere.material_3d = material
		sphere.least_size = Vector2(_SIDE, _SIDE)
		sphere.mouse_filter = Control.MOUSE_FILTER_PASS
		add_child(sphere)
