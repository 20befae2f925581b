@tool
extends "../material/conversion.gd"
## Between Godot's own materials and [LobeMaterial3D]; see [method LobeMaterial3D.from_standard] and
## [method LobeMaterial3D.to_standard].

const StencilPass := preload("../material/stencil_pass.gd")
const Widths := preload("../table/widths.gd")

# Of Material: of the same meaning on both sides too.
const _OF_ALL_MATERIALS: Array[StringName] = [&"render_priority", &"next_pass", &"resource_name"]
# Of no meaning, and refused by the engine, without physical light units.
const _OF_PHYSICAL_UNITS := &"emission_intensity"
# Properties of both BaseMaterial3D and LobeBaseMaterial3D.
static var _shared: Array[StringName] = []


func from_standard(source: BaseMaterial3D) -> LobeMaterial3D:
	var made := LobeMaterial3D.new()
	_copy(source, made)
	if source is ORMMaterial3D:
		# Its texture alone tells them.
		made.roughness = 1.0
		made.metallic = 1.0
	else:
		made.orm_texture = null
	return made


func to_standard(shown: ShaderMaterial) -> BaseMaterial3D:
	var source := shown as LobeMaterial3D
	var is_packed := (
		source.orm_texture != null
		and source.roughness == 1.0
		and source.metallic == 1.0
		and source.metallic_specular == 0.5
	)
	var made: BaseMaterial3D = ORMMaterial3D.new() if is_packed else StandardMaterial3D.new()
	_copy(source, made)
	if not is_packed:
		_give_parts(source, made)
	_give_anisotropy(source, made)
	return made


func get_losses(source: BaseMaterial3D) -> PackedStringArray:
	var losses: PackedStringArray = []
	var shared := _find_shared()
	var usual := StandardMaterial3D.new()
	for property: Dictionary in ClassDB.class_get_property_list(&"BaseMaterial3D", true):
		var name: String = property["name"]
		if (
			property["usage"] & PROPERTY_USAGE_STORAGE == 0
			or name in shared
			or name == _OF_PHYSICAL_UNITS
		):
			continue
		if source.get(name) != usual.get(name):
			losses.append(name)
	return losses


static func _copy(source: Material, made: Material) -> void:
	for name in _find_shared():
		made.set(name, source.get(name))
	if LobeBaseMaterial3D.has_physical_units():
		made.set(_OF_PHYSICAL_UNITS, source.get(_OF_PHYSICAL_UNITS))
	if made.next_pass != null and made.next_pass.has_meta(StencilPass.OWNED):
		# Either draws its own.
		made.next_pass = made.next_pass.duplicate()


static func _find_shared() -> Array[StringName]:
	if not _shared.is_empty():
		return _shared
	var shared := _OF_ALL_MATERIALS.duplicate()
	var ours: Script = LobeBaseMaterial3D
	for property: Dictionary in ours.get_script_property_list():
		var name: StringName = property["name"]
		if name != _OF_PHYSICAL_UNITS and ClassDB.class_get_property_setter("BaseMaterial3D", name):
			shared.append(name)
	_shared = shared
	return _shared


# A StandardMaterial3D has no packed texture, nor a table.
static func _give_parts(source: LobeMaterial3D, made: BaseMaterial3D) -> void:
	made.roughness = _get_godots(source).x
	var orm := source.orm_texture
	made.orm_texture = null
	if orm == null:
		return
	made.metallic_texture = orm
	made.metallic_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_BLUE
	made.roughness_texture = orm
	made.roughness_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_GREEN
	made.ao_texture = orm
	made.ao_texture_channel = BaseMaterial3D.TEXTURE_CHANNEL_RED
	made.ao_on_uv2 = false


# Godot has no angle beside the flow map: without a map, one of a single direction stands for it.
static func _give_anisotropy(source: LobeMaterial3D, made: BaseMaterial3D) -> void:
	var anisotropy := _get_godots(source).y
	var angle := source.anisotropy_rotation
	if angle != 0.0 and anisotropy != 0.0 and source.anisotropy_flowmap == null:
		if anisotropy < 0.0:
			anisotropy = Widths.exchanged(anisotropy)
			angle += 0.5 * PI
		var flow := 0.5 * Vector2.from_angle(angle) + Vector2(0.5, 0.5)
		var image := Image.create_empty(4, 4, false, Image.FORMAT_RGBAH)
		image.fill(Color(flow.x, flow.y, 0.0, 1.0))
		made.anisotropy_flowmap = ImageTexture.create_from_image(image)
	made.anisotropy_enabled = anisotropy != 0.0
	if made.anisotropy_enabled:
		made.anisotropy = clampf(anisotropy, -1.0, 1.0)


# Roughness and shown anisotropy, of the material's own table where it has one.
static func _get_godots(source: LobeMaterial3D) -> Vector2:
	if source.table != null and source.table.get_problem().is_empty():
		return Widths.to_roughness(source.table.alpha)
	return Vector2(source.roughness, source.get_shown_anisotropy())
