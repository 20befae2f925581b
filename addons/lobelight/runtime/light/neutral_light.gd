@tool
extends RefCounted
## What materials reflect where no environment has been set up: a bright ceiling with one soft
## light, a grey horizon and a dark floor.

const SIZE := 16
const CEILING := Color(0.9, 0.95, 1.0)
const HORIZON := Color(0.45, 0.45, 0.47)
const FLOOR := Color(0.12, 0.11, 0.10)
# Above the viewer's left shoulder, as in the editor's previews.
const LAMP_DIRECTION := Vector3(-0.48, 0.64, 0.6)
const LAMP := Color(3.0, 2.9, 2.7)
const LAMP_SHARPNESS := 24.0


static func make() -> LobeLight:
	var light := LobeLight.new()
	light.cubemap = Cubemap.new()
	var faces: Array[Image] = []
	for face in 6:
		faces.append(_make_face(face))
	light.cubemap.create_from_images(faces)
	light.size = SIZE
	# generate_mipmaps makes means of 2 × 2 texels, for which LobeLight's default variance is right.
	# Their blur shrinks towards the corners of the cube; in light as soft as this it does not show.
	light.is_even = true
	return light


static func radiance(direction: Vector3) -> Color:
	var end := CEILING if direction.y > 0.0 else FLOOR
	var colour := HORIZON.lerp(end, smoothstep(0.0, 1.0, absf(direction.y)))
	return colour + LAMP * exp(LAMP_SHARPNESS * (LAMP_DIRECTION.dot(direction) - 1.0))


static func _make_face(face: int) -> Image:
	var image := Image.create_empty(SIZE, SIZE, false, Image.FORMAT_RGBAF)
	for y in SIZE:
		for x in SIZE:
			var p := (Vector2(x, y) + Vector2(0.5, 0.5)) * (2.0 / SIZE) - Vector2.ONE
			image.set_pixel(x, y, radiance(face_direction(face, p).normalized()))
	image.generate_mipmaps()
	image.convert(Image.FORMAT_RGBAH)
	return image


## The direction of a place on a face of a cube map, from (−1, −1) in the upper left to (1, 1); not
## of unit length. The same as lobelight_face_direction in shaders/cube_faces.gdshaderinc.
static func face_direction(face: int, p: Vector2) -> Vector3:
	match face:
		0:
			return Vector3(1.0, -p.y, -p.x)
		1:
			return Vector3(-1.0, -p.y, p.x)
		2:
			return Vector3(p.x, 1.0, p.y)
		3:
			return Vector3(p.x, -1.0, -p.y)
		4:
			return Vector3(p.x, -p.y, 1.0)
		_:
			return Vector3(-p.x, -p.y, -1.0)
