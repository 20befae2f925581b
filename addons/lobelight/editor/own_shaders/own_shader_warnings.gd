@tool
extends Object
## What keeps a shader of one's own from being lit.

const Binding := preload("../../runtime/own_shaders/shader_binding.gd")


## Of a material that may be anybody's.
static func of(material: ShaderMaterial) -> PackedStringArray:
	if material == null or material.shader == null or material is LobeShaderMaterial:
		return []
	if not Binding.takes_light(material.shader) or Binding.is_bound(material):
		return []
	return [
		(
			"The material's shader includes lobelight.gdshaderinc, and shows black until a script calls"
			+ " LobeLight.bind(material). A LobeShaderMaterial does that by itself, in the editor too."
		)
	]
