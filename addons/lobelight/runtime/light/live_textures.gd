@tool
extends Object
## Textures whose contents change without a signal: whoever shows one looks at it in every frame.

# By name, since templates may lack some of them.
const _CLASSES: Array[String] = [
	"ViewportTexture",
	"AnimatedTexture",
	"CameraTexture",
	"ExternalTexture",
	"Texture2DRD",
	"TextureLayeredRD",
	"Texture3DRD",
]


## Whether a value is such a texture, or an array with one.
static func is_live(value: Variant) -> bool:
	if value is Array:
		return (value as Array).any(is_live)
	return value is Texture and _CLASSES.any((value as Texture).is_class)
