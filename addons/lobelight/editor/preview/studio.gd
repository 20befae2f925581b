@tool
extends Object
## The environment of previews where none is chosen: a dim room with soft boxes, as an OpenEXR file
## in the editor's cache, which the reference renderer reads too.

const NativeLibrary := preload("../bake/native_library.gd")

const WIDTH := 128
const HEIGHT := 64
const FILE := "lobelight_studio.exr"
const _ROOM := Color(0.12, 0.12, 0.13)
const _FLOOR := Color(0.05, 0.045, 0.04)
# Direction, size in radians, colour.
const _LAMPS: Array[Array] = [
	[Vector3(-0.6, 0.5, 0.6), 0.35, Color(9.0, 8.6, 8.0)],
	[Vector3(0.8, 0.2, 0.5), 0.15, Color(10.0, 11.0, 13.0)],
	[Vector3(0.1, 0.9, -0.4), 0.3, Color(4.0, 4.0, 4.0)],
	[Vector3(0.3, -0.1, -0.9), 0.5, Color(1.0, 0.8, 0.6)],
]


## The file's path, written if it is not there yet; empty if that is not possible.
static func find_path() -> String:
	var path := EditorInterface.get_editor_paths().get_cache_dir().path_join(FILE)
	if FileAccess.file_exists(path):
		return path
	var native := NativeLibrary.create(&"LobeImageFile")
	if native == null:
		return ""
	var pixels := PackedFloat32Array()
	for row in HEIGHT:
		for column in WIDTH:
			var color := radiance(_direction(column, row))
			pixels.append_array([color.r, color.g, color.b])
	var problem: String = native.call("save_exr", path, WIDTH, HEIGHT, pixels)
	return path if problem.is_empty() else ""


static func radiance(direction: Vector3) -> Color:
	var color := _FLOOR.lerp(_ROOM, smoothstep(-0.3, 0.1, direction.y))
	for lamp in _LAMPS:
		var towards: Vector3 = lamp[0]
		var angle := direction.angle_to(towards.normalized())
		var lit: Color = lamp[2]
		var half_width: float = lamp[1]
		color += lit * smoothstep(half_width, 0.7 * half_width, angle)
	return color


# As PanoramaSkyMaterial has it.
static func _direction(column: int, row: int) -> Vector3:
	var azimuth := TAU * (column + 0.5) / WIDTH
	var polar := PI * (row + 0.5) / HEIGHT
	return Vector3(sin(polar) * sin(azimuth), cos(polar), -sin(polar) * cos(azimuth))
