@tool
extends RefCounted
## Panoramas no finer than the cube maps that are made of them.
##
## A cube map of S texels a side has 4 S of them around, so that 4 S texels are all that it can show
## of a panorama. Finer ones are halved, each texel the mean of four, while that many are left: at
## least twice S, so that level 0 stays as sharp as it is (runtime/pyramid/pyramid.gd,
## base_variance). Only panoramas that are seen through the cube map alone: what else shows one may
## need all of it. Those that no environment shows any more, because its light was baked of them,
## stay out.

const EnvironmentFit := preload("environment_fit.gd")
const Features := preload("features.gd")
const OnDemand := preload("../../runtime/on_demand.gd")
const Pyramid := preload("../../runtime/pyramid/pyramid.gd")
const ProjectFiles := preload("project_files.gd")

## Along the panorama, of each texel along a cube map's side.
const TEXELS_AROUND := 4
## Half floats end here.
const MOST := 65504.0
## In which textures are pictures, rather than heights or other numbers.
const COLOUR_FORMATS: Array[Image.Format] = [
	Image.FORMAT_RGBF,
	Image.FORMAT_RGBAF,
	Image.FORMAT_RGBH,
	Image.FORMAT_RGBAH,
	Image.FORMAT_RGBE9995,
	Image.FORMAT_BPTC_RGBF,
	Image.FORMAT_BPTC_RGBFU,
	Image.FORMAT_ASTC_4x4_HDR,
	Image.FORMAT_ASTC_8x8_HDR,
]


## What becomes of a panorama.
class Share:
	extends RefCounted
	var path := ""
	## Bytes of the imported texture, and what is exported in its place.
	var before := 0
	var after := 0
	var extent_before := Vector2i.ZERO
	var extent_after := Vector2i.ZERO
	var why := ""
	## A .ctex file; empty if the texture goes along as it is.
	var bytes := PackedByteArray()
	var is_left_out := false

	## The .import file of a panorama whose texture is another file.
	func make_import(texture: String) -> PackedByteArray:
		var config := ConfigFile.new()
		config.load(path + ".import")
		for section in config.get_sections():
			if section != "remap":
				config.erase_section(section)
		for key in config.get_section_keys("remap"):
			if key.begins_with("path"):
				config.erase_section_key("remap", key)
		config.set_value("remap", "path", texture)
		config.set_value("remap", "type", "CompressedTexture2D")
		config.set_value("remap", "metadata", {"vram_texture": false})
		return config.encode_to_text().to_utf8_buffer()

	func describe() -> String:
		return (
			"%s: %d x %d texels in %d bytes, %d x %d in %d: %s"
			% [
				path.get_file(),
				extent_before.x,
				extent_before.y,
				before,
				extent_after.x,
				extent_after.y,
				after,
				why
			]
		)


## By the panoramas' paths.
var shares: Dictionary[String, Share] = {}
## Scenes with environments whose panoramas are left out.
var scenes: Dictionary[String, bool] = {}


## Of the environments' panoramas among a project's files. [param fit] knows the cubes' sizes.
static func of(files: PackedStringArray, features: Features, fit: EnvironmentFit) -> RefCounted:
	var panoramas := new()
	# By path, the largest cube that is made of it.
	var sizes: Dictionary[String, int] = {}
	for entry in features.environments:
		var panorama := (entry[1] as Dictionary).get("panorama") as Texture2D
		if panorama != null and FileAccess.file_exists(panorama.resource_path + ".import"):
			var size := fit.get_exported_size((entry[1] as Dictionary).get("size", 0), panorama)
			var path := panorama.resource_path
			sizes[path] = maxi(sizes.get(path, 0), size)
	for path in sizes:
		panoramas.shares[path] = _share_of(path, sizes[path], files, features)
	for entry in features.baked:
		panoramas._leave_out((entry[1] as Dictionary).get("panorama"), entry[0], files, features)
	return panoramas


## A panorama, whatever shows it, that is to load fast: halved while it keeps [param width] texels
## in a row. Panoramas are imported textures of colours in linear floats, twice as wide as high.
## Null for what is none, or would not get smaller.
static func narrow(path: String, width: int) -> Share:
	if not FileAccess.file_exists(path + ".import"):
		return null
	var texture := load(path) as Texture2D
	if texture == null or texture.get_width() != 2 * texture.get_height():
		return null
	var image := texture.get_image()
	if image == null or image.get_format() not in COLOUR_FORMATS:
		return null
	var share := Share.new()
	share.path = path
	share.before = _get_imported_bytes(path)
	share.extent_before = image.get_size()
	share.why = "the preset asks for panoramas of %d texels" % width
	var narrowed := shrink(image, width)
	share.extent_after = narrowed.get_size()
	share.bytes = _make_texture(narrowed)
	share.after = share.bytes.size()
	return share if share.after < share.before else null


## Takes the panoramas that are left out from the environments in a scene. Returns whether there was
## one.
func edit(packed: PackedScene) -> bool:
	var scene := packed.instantiate(PackedScene.GEN_EDIT_STATE_INSTANCE)
	var is_changed := false
	for node: Node in scene.find_children("*", "LobeEnvironment3D") + [scene]:
		var environment := node as LobeEnvironment3D
		var panorama := environment.panorama if environment != null else null
		if panorama != null and (node == scene or node.owner == scene):
			var share: Share = shares.get(panorama.resource_path)
			if share != null and share.is_left_out:
				environment.panorama = null
				is_changed = true
	is_changed = is_changed and packed.pack(scene) == OK
	scene.free()
	return is_changed


# A panorama of an environment that shows a baked light.
func _leave_out(
	panorama: Texture2D, file: String, files: PackedStringArray, features: Features
) -> void:
	var path := panorama.resource_path if panorama != null else ""
	if not FileAccess.file_exists(path + ".import"):
		return
	if not shares.has(path):
		var share := Share.new()
		share.path = path
		share.before = _get_imported_bytes(path)
		share.after = share.before
		share.extent_before = Vector2i(panorama.get_size())
		share.extent_after = share.extent_before
		share.why = features.resizing
		if share.why.is_empty() and features.reached.has(OnDemand.LIVE):
			share.why = "%s asks for %s" % [features.reached[OnDemand.LIVE], OnDemand.LIVE]
		if share.why.is_empty():
			share.why = _find_other_use(path, files, features)
		if share.why.is_empty():
			share.is_left_out = true
			share.after = 0
			share.extent_after = Vector2i.ZERO
			share.why = "the light that was baked of it is shown in its place"
		shares[path] = share
	if shares[path].is_left_out:
		scenes[file] = true


func describe() -> PackedStringArray:
	var lines: PackedStringArray = []
	for share: Share in shares.values():
		lines.append(share.describe())
	return lines


static func _share_of(
	path: String, size: int, files: PackedStringArray, features: Features
) -> Share:
	var panorama: Texture2D = load(path)
	var share := Share.new()
	share.path = path
	share.before = _get_imported_bytes(path)
	share.after = share.before
	share.extent_before = Vector2i(panorama.get_size())
	share.extent_after = share.extent_before
	var wanted := TEXELS_AROUND * size
	if share.extent_before.x < 2 * wanted:
		share.why = "it is no finer than a cube map of %d texels a side shows" % size
		return share
	share.why = features.resizing
	if share.why.is_empty():
		share.why = _find_other_use(path, files, features)
	if share.why:
		return share
	var image := panorama.get_image()
	if image == null or image.get_format() not in Pyramid.LINEAR_FORMATS:
		share.why = "it is not in linear floats"
		return share
	var fitted := shrink(image, wanted)
	var bytes := _make_texture(fitted)
	if bytes.size() >= share.before:
		share.why = "compressed as it is, it is smaller"
		return share
	share.bytes = bytes
	share.after = bytes.size()
	share.extent_after = fitted.get_size()
	share.why = "a cube map of %d texels a side shows no more" % size
	return share


## Halves an image in linear light while it keeps [param width] texels in a row. What is negative or
## no number counts as 0. Shared exponents, because phones filter them and they take half of what
## half floats do.
static func shrink(image: Image, width: int) -> Image:
	var fitted: Image = image.duplicate()
	if fitted.is_compressed():
		fitted.decompress()
	fitted.clear_mipmaps()
	fitted.convert(Image.FORMAT_RGBF)
	var values := fitted.get_data().to_float32_array()
	for i in values.size():
		var value := values[i]
		if not (value >= 0.0 and value <= MOST):
			values[i] = MOST if is_finite(value) and value > MOST else 0.0
	var extent := fitted.get_size()
	fitted = Image.create_from_data(
		extent.x, extent.y, false, Image.FORMAT_RGBF, values.to_byte_array()
	)
	while fitted.get_width() >= 2 * width and fitted.get_size() % 2 == Vector2i.ZERO:
		fitted.shrink_x2()
	fitted.convert(Image.FORMAT_RGBE9995)
	return fitted


# Who else uses the texture, in a sentence; empty if nobody does.
static func _find_other_use(path: String, files: PackedStringArray, features: Features) -> String:
	var uid := ResourceUID.id_to_text(ResourceLoader.get_resource_uid(path))
	for file in files:
		if file.begins_with("res://addons/lobelight/"):
			continue
		var ending := file.get_extension()
		if ending in ProjectFiles.SCRIPTS or ending in ProjectFiles.SHADERS:
			var text := FileAccess.get_file_as_string(file)
			if path.get_file().get_basename() in text or uid in text:
				return "%s names it" % file
		elif path in ProjectFiles.get_dependencies(file):
			if ending not in ["tscn", "scn"] or _shows_elsewhere(path, file, features):
				return "%s shows it elsewhere, too" % file
	return ""


# Whether a scene has the texture anywhere but as the panorama of environments.
static func _shows_elsewhere(path: String, file: String, features: Features) -> bool:
	var texture: Texture2D = load(path)
	var uses := 0
	for entry in features.environments + features.baked:
		if entry[0] == file and (entry[1] as Dictionary).get("panorama") == texture:
			uses += 1
	var state := (load(file) as PackedScene).get_state()
	var seen: Dictionary[Object, bool] = {}
	for node in state.get_node_count():
		for property in state.get_node_property_count(node):
			var value: Variant = state.get_node_property_value(node, property)
			if value is Object and value == texture:
				uses -= 1
			elif _holds(value, texture, seen):
				return true
	return uses != 0


# Resources of other files have dependencies of their own.
static func _holds(value: Variant, texture: Texture2D, seen: Dictionary[Object, bool]) -> bool:
	if value is Array:
		return (value as Array).any(func(part: Variant) -> bool: return _holds(part, texture, seen))
	if value is Dictionary:
		var parts: Array = (value as Dictionary).keys() + (value as Dictionary).values()
		return _holds(parts, texture, seen)
	if value is Object and value == texture:
		return true
	var resource := value as Resource if value is Object else null
	if resource == null or seen.has(resource) or FileAccess.file_exists(resource.resource_path):
		return false
	seen[resource] = true
	for property in resource.get_property_list():
		if property["usage"] & PROPERTY_USAGE_STORAGE:
			if _holds(resource.get(property["name"]), texture, seen):
				return true
	return false


# Of the variants for several systems, the largest.
static func _get_imported_bytes(path: String) -> int:
	var config := ConfigFile.new()
	if config.load(path + ".import") != OK:
		return 0
	var most := 0
	for key in config.get_section_keys("remap"):
		if key.begins_with("path"):
			var file: String = config.get_value("remap", key)
			most = maxi(most, FileAccess.get_file_as_bytes(file).size())
	return most


# The file that the engine's importer writes of an image that it does not compress (Godot 4.6,
# editor/import/resource_importer_texture.cpp, _save_ctex): an ImageTexture would be stored under
# names that differ from export to export.
static func _make_texture(image: Image) -> PackedByteArray:
	var header := StreamPeerBuffer.new()
	header.put_data("GST2".to_ascii_buffer())
	# The version, flags, no limit of mipmaps, reserved numbers, and that texels follow as they are.
	for number: int in [1, image.get_width(), image.get_height(), 0, -1, 0, 0, 0, 0]:
		header.put_32(number)
	header.put_u16(image.get_width())
	header.put_u16(image.get_height())
	header.put_u32(0)
	header.put_u32(image.get_format())
	return header.data_array + image.get_data()
