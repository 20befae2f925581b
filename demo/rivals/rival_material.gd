extends LobeMaterial3D
## A material with the properties of a [LobeMaterial3D] that is lit by another method.

const DemoTables := preload("../demo_tables.gd")
const ThesisTable := preload("thesis_table.gd")
const RivalLight := preload("rival_light.gd")
const Samples := preload("samples.gd")
# Loaded here so that exported projects contain them.
const _INCLUDES_OF_RIVALS: Array[ShaderInclude] = [
	preload("thesis.gdshaderinc"),
	preload("thesis_round.gdshaderinc"),
	preload("fis.gdshaderinc"),
	preload("fis_round.gdshaderinc"),
]

## Whether by the thesis' method, otherwise by filtered importance sampling.
var is_thesis := false

var _map: RivalLight
var _tables: LobeTableSet


## A material like [param source] by another method.
static func make(thesis: bool) -> LobeMaterial3D:
	var material := new()
	material.is_thesis = thesis
	material.emit_changed()
	return material


## Takes over what the demo's sliders and objects set; [param light] is what it is lit by.
func follow(source: LobeMaterial3D, light: RivalLight) -> void:
	_map = light
	albedo_color = source.albedo_color
	metallic = source.metallic
	metallic_specular = source.metallic_specular
	clearcoat_enabled = source.clearcoat_enabled
	clearcoat = source.clearcoat
	clearcoat_roughness = source.clearcoat_roughness
	roughness = source.roughness
	anisotropy_rotation = source.anisotropy_rotation
	anisotropy_enabled = source.anisotropy_enabled
	anisotropy = source.anisotropy
	if is_thesis:
		_follow_thesis()
	else:
		_follow_samples()


func _follow_thesis() -> void:
	if _tables == null:
		_tables = DemoTables.thesis_set()
	if _tables == null or _map == null:
		return
	var table := ThesisTable.nearest(_tables, widths_of(roughness, get_shown_anisotropy()))
	# Where the nearest widths are equal, the table is for a frame along the view.
	if table.is_isotropic():
		anisotropy = 0.0
	_give(&"toral_lobes", ThesisTable.texture_of(table))
	_give(&"toral_map", _map.cubemap)
	_give(&"toral_grid", ThesisTable.grid_of(table))
	_give(&"toral_constants", Vector2(0.0, ThesisTable.level_of(_map)))


func _follow_samples() -> void:
	if _map == null:
		return
	var widths := widths_of(roughness, get_shown_anisotropy())
	_give(&"fis_environment", _map.cubemap)
	_give(&"fis_samples", Samples.constants())
	_give(&"fis_alpha", widths)
	_give(&"fis_level_scale", Samples.level_scale(widths, _map))
	var dielectric := 0.16 * metallic_specular * metallic_specular
	var f0 := Color(dielectric, dielectric, dielectric).lerp(
		albedo_color.srgb_to_linear(), metallic
	)
	_give(&"fis_f0", Vector3(f0.r, f0.g, f0.b))


func _get_fragment_path() -> String:
	var folder := (get_script() as Script).resource_path.get_base_dir()
	var title := "thesis" if is_thesis else "fis"
	if _map != null and _map.is_round:
		title += "_round"
	return folder.path_join(title + ".gdshaderinc")


# The rendering server keeps textures by their number only.
func _give(parameter: StringName, value: Variant) -> void:
	set_meta(parameter, value)
	var given: Variant = (value as Texture).get_rid() if value is Texture else value
	RenderingServer.material_set_param(get_rid(), parameter, given)
