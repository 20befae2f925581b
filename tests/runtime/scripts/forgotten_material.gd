extends SceneTree
## Ends while the registry of lights still has a material that nobody took back, with a lambda whose
## object it keeps; exit_test.gd looks at how.

const LightRegistry := preload("res://addons/lobelight/runtime/light/light_registry.gd")


class Owner:
	extends RefCounted
	var material := ShaderMaterial.new()
	var updates := 0

	func _init() -> void:
		LightRegistry.add_material(material.get_rid(), func() -> void: updates += 1)


func _process(_delta: float) -> bool:
	Owner.new()
	return true
