extends RefCounted
## Environments and measurements for the suites of the methods that `./dev compare` sets beside this
## project's own.

const Kit := preload("render_kit.gd")

## Pixels along the side of a picture.
const SIDE := 32
const NORMALS: Array[Vector3] = [
	Vector3(0.05, 0.03, 1.0),
	Vector3(0.6, 0.3, 1.0),
	Vector3(-0.5, 0.9, 1.0),
	Vector3(0.4, -1.9, 1.0)
]


## The root of the mean squared difference over that of the mean square, where the sphere is seen at
## less than 80 degrees.
static func error(pixels: PackedFloat32Array, expected: PackedFloat32Array) -> float:
	var difference := 0.0
	var square := 0.0
	for y in SIDE:
		for x in SIDE:
			if Kit.sphere_normal(x, y, SIDE).z < 0.17:
				continue
			for channel in 3:
				var i := 3 * (y * SIDE + x) + channel
				difference += pow(pixels[i] - expected[i], 2.0)
				square += pow(expected[i], 2.0)
	return sqrt(difference / square)


## Saves a smooth panorama with bright and dark parts; one sentence on failure.
static func save_lamps(file: String) -> String:
	var height := 32
	var pixels := PackedFloat32Array()
	for y in height:
		for x in 2 * height:
			var d := Kit.panorama_direction((x + 0.5) / (2.0 * height), (y + 0.5) / height)
			var lamp := 20.0 * exp(12.0 * (d.dot(Vector3(-0.48, 0.64, 0.6)) - 1.0))
			pixels.append_array([0.5 + lamp, 0.4 + 0.3 * d.y + lamp, 0.6 - 0.4 * d.x + 0.5 * lamp])
	return NativeLibrary.save_exr(file, 2 * height, height, pixels)


## A saved panorama as a stage wants it.
static func load_panorama(file: String) -> Texture2D:
	var panorama := NativeLibrary.load_panorama(file)
	var pixels: PackedFloat32Array = panorama["pixels"]
	var size := Vector2i(panorama["width"], panorama["height"])
	var bytes := pixels.to_byte_array()
	return ImageTexture.create_from_image(
		Image.create_from_data(size.x, size.y, false, Image.FORMAT_RGBF, bytes)
	)


## Mip level l holds 1 + l.
static func level_image(size: int) -> Image:
	var data := PackedByteArray()
	var level := 0
	while size >> level > 0:
		var image := Image.create_empty(size >> level, size >> level, false, Image.FORMAT_RGBAH)
		image.fill(Color(1.0 + level, 1.0 + level, 1.0 + level))
		data.append_array(image.get_data())
		level += 1
	return Image.create_from_data(size, size, true, Image.FORMAT_RGBAH, data)


## A cube map of such levels, blurred as by a filter of [ComparisonStage].
static func level_light(size: int, filter: String) -> LobeLight:
	var light := LobeLight.new()
	light.cubemap = Cubemap.new()
	var face := level_image(size)
	light.cubemap.create_from_images([face, face, face, face, face, face])
	light.size = size
	light.level_variance = ComparisonStage.Pyramid.LEVEL_VARIANCES[ComparisonStage.FILTERS[filter]]
	return light


## The frame that the shaders use: isotropic materials have the view in the x-z plane.
static func frame(normal: Vector3, isotropic: bool) -> Basis:
	if not isotropic:
		return Kit.sphere_frame(normal)
	var across := (Vector3.BACK - normal * normal.z).normalized()
	return Basis(across, normal.cross(across), normal)


## Where a picture shows a normal.
static func pixel_of(normal: Vector3) -> Vector2i:
	var p := normal.normalized()
	return Vector2i(floori((p.x + 1.0) * 0.5 * SIDE), floori((1.0 - p.y) * 0.5 * SIDE))


## What a picture of three floats a pixel has in its first channel where it shows a normal.
static func value_at(pixels: PackedFloat32Array, normal: Vector3) -> float:
	var pixel := pixel_of(normal)
	return pixels[3 * (pixel.y * SIDE + pixel.x)]


## The exact normal of the pixel where a picture shows about [param normal].
static func exact_normal(normal: Vector3) -> Vector3:
	var pixel := pixel_of(normal)
	return Kit.sphere_normal(pixel.x, pixel.y, SIDE)


## The directional albedo there, for the viewer of the picture.
static func albedo_at(brdf: String, widths: Vector2, normal: Vector3) -> float:
	var view := Kit.sphere_frame(exact_normal(normal)).transposed() * Vector3.BACK
	return LobeBaker.directional_albedo(brdf, widths, view)
