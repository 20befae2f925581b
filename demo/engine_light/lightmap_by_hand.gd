extends Object
## A LightmapGI whose light is written down instead of baked, which only the editor can: a texture
## for what stands still, and captures for what moves.

const _SIDE := 32
# Colours at the corners of a tetrahedron around the scene, and the directions they come from.
const _REACH := 30.0
const _CORNERS: PackedVector3Array = [
	Vector3(-_REACH, -_REACH, -_REACH),
	Vector3(3.0 * _REACH, -_REACH, -_REACH),
	Vector3(-_REACH, 3.0 * _REACH, -_REACH),
	Vector3(-_REACH, -_REACH, 3.0 * _REACH),
]


## To be added as a child of [param parent], as the users are.
static func make(parent: Node, users: Array[MeshInstance3D]) -> LightmapGI:
	var data := LightmapGIData.new()
	var textures: Array[TextureLayered] = [_make_texture()]
	data.set_lightmap_textures(textures)
	for user in users:
		var path := NodePath("../" + String(parent.get_path_to(user)))
		data.add_user(path, Rect2(0.0, 0.0, 1.0, 1.0), 0, -1)
	data.set(&"probe_data", _make_captures())
	var lightmap := LightmapGI.new()
	lightmap.light_data = data
	return lightmap


# Irradiance over pi.
static func _make_texture() -> TextureLayered:
	var image := Image.create_empty(_SIDE, _SIDE, false, Image.FORMAT_RGBAH)
	for y in _SIDE:
		for x in _SIDE:
			var u := (x + 0.5) / _SIDE
			var v := (y + 0.5) / _SIDE
			var lamp := exp(-12.0 * (pow(u - 0.4, 2.0) + pow(v - 0.5, 2.0)))
			image.set_pixel(x, y, Color(0.1 + 0.5 * lamp, 0.15 + 0.3 * v, 0.2 + 0.3 * u))
	var layers: Array[Image] = [image]
	var texture := Texture2DArray.new()
	texture.create_from_images(layers)
	return texture


# Spherical harmonics up to band 2 of the radiance at each corner, in the engine's order: 1; y, z,
# x; and five more, which are none here.
static func _make_captures() -> Dictionary:
	var harmonics := PackedColorArray()
	for corner in _CORNERS.size():
		var tint := Color.from_hsv(0.25 * corner, 0.4, 0.6)
		harmonics.append(tint)
		harmonics.append(0.5 * tint)
		harmonics.append(0.2 * tint)
		harmonics.append(0.3 * tint * (1.0 if corner < 2 else -1.0))
		for more in 5:
			harmonics.append(Color(0.0, 0.0, 0.0, 0.0))
	# One plane far above everything: what is below it is in the one tetrahedron.
	var plane := PackedFloat32Array([0.0, 1.0, 0.0, 1000.0]).to_byte_array().to_int32_array()
	plane.append_array([-2147483648, -1])
	return {
		"bounds": AABB(Vector3.ONE * -10.0, Vector3.ONE * 20.0),
		"interior": true,
		"points": _CORNERS,
		"tetrahedra": PackedInt32Array([0, 1, 2, 3]),
		"bsp": plane,
		"sh": harmonics,
		"baked_exposure": 1.0,
	}
