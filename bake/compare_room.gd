class_name CompareRoom
extends RefCounted
## The room of `./dev compare --room`: a box about the origin whose walls emit the radiance of
## pictures, a place that its light is captured at, and a sphere.

## The keys of the walls in the file, in the order of a cube map's faces. A wall's picture lies as
## on the face.
const WALLS: PackedStringArray = ["+x", "-x", "+y", "-y", "+z", "-z"]
## The layer that the walls are on; cameras that show the sphere leave it out.
const WALL_LAYER := 1 << 19

const NeutralLight := preload("res://addons/lobelight/runtime/light/neutral_light.gd")
const _KEYS: PackedStringArray = ["size", "walls", "probe", "sphere"]
const _SPHERE_KEYS: PackedStringArray = ["centre", "radius"]
# Metres; single precision holds millimetres up to there.
const _LARGEST := 10000.0

## Absolute.
var path: String
var size: Vector3
## Absolute paths of the pictures, in the order of [constant WALLS].
var walls: PackedStringArray = []
var probe: Vector3
var centre: Vector3
var radius: float
## What there is to say of the pictures.
var remarks: PackedStringArray = []

# As in the file, in double precision.
var _numbers: Dictionary[String, Array] = {}
var _radius := 0.0
var _textures: Array[Texture2D] = []
var _error := ""


## Reads a file and its pictures. [method get_error] is empty if they make a room.
static func read(file: String) -> CompareRoom:
	var room := CompareRoom.new()
	room.path = file
	room._read()
	return room


## One sentence that names the file and the key, otherwise empty.
func get_error() -> String:
	return "" if _error.is_empty() else "%s: %s" % [path, _error]


## What [code]LobeReference[/code] wants to know of it.
func get_reference_options() -> Dictionary:
	return {
		"walls": Array(walls),
		"room_size": _numbers["size"],
		"centre": _numbers["centre"],
		"radius": _radius,
	}


## The point of a wall's picture at (u, v) in [0, 1]², from the upper left.
func get_point(wall: int, uv: Vector2) -> Vector3:
	return 0.5 * size * NeutralLight.face_direction(wall, 2.0 * uv - Vector2.ONE)


## The walls as quads that shade nothing and emit exactly their pictures' radiance, in all
## renderers.
func make_walls() -> Node3D:
	var node := Node3D.new()
	for wall in WALLS.size():
		node.add_child(_make_wall(wall))
	return node


## A world of its own with the walls, to be added to the tree.
func make_world() -> SubViewport:
	var world := SubViewport.new()
	world.own_world_3d = true
	world.render_target_update_mode = SubViewport.UPDATE_DISABLED
	world.add_child(make_walls())
	return world


## Puts the sphere of [SphereImpostor] where the room has it, and the viewport's camera before it.
func place(viewport: LinearViewport, sphere: MeshInstance3D, distance := 4.0) -> void:
	sphere.transform = Transform3D(Basis.from_scale(radius * Vector3.ONE), centre)
	viewport.camera.cull_mask &= ~WALL_LAYER
	viewport.camera.position = centre + Vector3(0.0, 0.0, distance)
	var depth := radius + 1.0
	viewport.camera.set_orthogonal(2.0 * radius, maxf(distance - depth, 0.05), distance + depth)


func _make_wall(wall: int) -> MeshInstance3D:
	var corners: PackedVector2Array = [Vector2.ZERO, Vector2.RIGHT, Vector2.ONE, Vector2.DOWN]
	var arrays: Array = []
	arrays.resize(Mesh.ARRAY_MAX)
	var points: PackedVector3Array = []
	for corner in corners:
		points.append(get_point(wall, corner))
	arrays[Mesh.ARRAY_VERTEX] = points
	arrays[Mesh.ARRAY_TEX_UV] = corners
	arrays[Mesh.ARRAY_INDEX] = PackedInt32Array([0, 1, 2, 0, 2, 3])
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var material := ShaderMaterial.new()
	material.shader = preload("comparators/wall.gdshader")
	material.set_shader_parameter(&"wall", _textures[wall])
	mesh.surface_set_material(0, material)
	var instance := MeshInstance3D.new()
	instance.mesh = mesh
	instance.layers = WALL_LAYER
	instance.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	return instance


func _read() -> void:
	if not FileAccess.file_exists(path):
		_fail("there is no such file.")
		return
	var json := JSON.new()
	if json.parse(FileAccess.get_file_as_string(path)) != OK:
		var line := json.get_error_line() + 1
		_fail("is not JSON: %s in line %d." % [json.get_error_message(), line])
		return
	var values := _read_object(json.data, "", _KEYS)
	_numbers["size"] = _read_point(values.get("size"), "size")
	_numbers["probe"] = _read_point(values.get("probe"), "probe")
	var sphere := _read_object(values.get("sphere"), "sphere", _SPHERE_KEYS)
	_numbers["centre"] = _read_point(sphere.get("centre"), "sphere.centre")
	_radius = _read_number(sphere.get("radius"), "sphere.radius")
	var paths := _read_object(values.get("walls"), "walls", WALLS)
	if _error.is_empty():
		_check_box()
	for wall in WALLS:
		if _error.is_empty():
			_read_wall(paths[wall], "walls.%s" % wall)


func _check_box() -> void:
	size = _to_vector(_numbers["size"])
	probe = _to_vector(_numbers["probe"])
	centre = _to_vector(_numbers["centre"])
	radius = _radius
	for axis in 3:
		var length: float = _numbers["size"][axis]
		if not (length > 0.0 and length <= _LARGEST):
			_fail("size is %s, but must be above 0 and at most %d." % [_numbers["size"], _LARGEST])
	if not (_radius > 0.0 and _radius <= _LARGEST):
		_fail("sphere.radius is %s, but must be above 0." % _radius)
	for axis in 3:
		var half: float = 0.5 * _numbers["size"][axis]
		if not absf(_numbers["probe"][axis] as float) < half:
			_fail("probe is %s, which is not inside the box." % [_numbers["probe"]])
		var distance := absf(_numbers["centre"][axis] as float)
		if not distance < half:
			_fail("sphere.centre is %s, which is not inside the box." % [_numbers["centre"]])
		if not distance + _radius < half:
			_fail("sphere.radius is %s: the sphere reaches through a wall." % _radius)


func _read_wall(value: Variant, key: String) -> void:
	var file := value as String if value is String else ""
	if file.is_empty():
		_fail("%s must be the path of a picture." % key)
		return
	if not file.is_absolute_path():
		file = path.get_base_dir().path_join(file).simplify_path()
	if not FileAccess.file_exists(file):
		_fail("%s is %s: there is no such file." % [key, file])
		return
	var picture := NativeLibrary.load_panorama(file)
	if picture.has("error"):
		_fail("%s is %s." % [key, (picture["error"] as String).trim_suffix(".")])
		return
	var width: int = picture["width"]
	var height: int = picture["height"]
	if maxi(width, height) > NativeLibrary.LARGEST_TEXTURE:
		var text := "%s is %s: has %d texels along a side; a texture holds %d."
		_fail(text % [key, file, maxi(width, height), NativeLibrary.LARGEST_TEXTURE])
		return
	for remark: String in picture["warnings"] + picture["notes"]:
		# A wall may have any proportions.
		if not "but a panorama" in remark and not remarks.has("%s: %s." % [file, remark]):
			remarks.append("%s: %s." % [file, remark])
	var pixels: PackedFloat32Array = picture["pixels"]
	var image := Image.create_from_data(
		width, height, false, Image.FORMAT_RGBF, pixels.to_byte_array()
	)
	# Walls are seen from near and far.
	image.generate_mipmaps()
	walls.append(file)
	_textures.append(ImageTexture.create_from_image(image))


# An object that has these keys and no others; empty otherwise.
func _read_object(value: Variant, key: String, keys: PackedStringArray) -> Dictionary:
	var name := key if not key.is_empty() else "the file"
	if not _error.is_empty():
		return {}
	if not value is Dictionary:
		_fail("%s must be an object with the keys %s." % [name, ", ".join(keys)])
		return {}
	var object: Dictionary = value
	var prefix := key + "." if not key.is_empty() else ""
	for known in keys:
		if not object.has(known):
			_fail("%s%s is missing." % [prefix, known])
	for given: String in object:
		if given not in keys:
			var text := "%s%s is not known; %s has the keys %s."
			_fail(text % [prefix, given, name, ", ".join(keys)])
	return object


func _read_point(value: Variant, key: String) -> Array:
	var is_point := value is Array and (value as Array).size() == 3
	if is_point:
		for number: Variant in value:
			is_point = is_point and number is float and is_finite(number as float)
	if not is_point:
		_fail("%s must be three finite numbers." % key)
		return [0.0, 0.0, 0.0]
	return value


func _read_number(value: Variant, key: String) -> float:
	if not (value is float and is_finite(value as float)):
		_fail("%s must be a finite number." % key)
		return 0.0
	return value


# Keeps the first one.
func _fail(sentence: String) -> void:
	if _error.is_empty():
		_error = sentence


static func _to_vector(numbers: Array) -> Vector3:
	return Vector3(numbers[0] as float, numbers[1] as float, numbers[2] as float)
