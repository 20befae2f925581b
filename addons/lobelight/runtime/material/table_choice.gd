@tool
extends RefCounted
## Which lobes a [LobeMaterial3D] draws: those of a table, of all tables of a set, or of a line.
##
## Widths that change time and again, as animated ones do, get no tables of their own. Isotropic
## tables are then two neighbouring rows of the texture that has all of them, which the sampler
## mixes as it mixes views; anisotropic ones are mixed on the GPU. Both cost a pixel nothing.

const LineChoice := preload("line_choice.gd")
const MixedLobes := preload("mixed_lobes.gd")
const OnDemand := preload("../on_demand.gd")
const Widths := preload("../table/widths.gd")
const WidthsTexture := preload("../table/widths_texture.gd")
const DEFAULT_BRDF := LineChoice.DEFAULT_BRDF
const DEFAULT_SET := "res://addons/lobelight/tables/ggx_8.res"
const COAT_SET := "res://addons/lobelight/tables/coat_4.res"
const SHEEN_SET := "res://addons/lobelight/tables/charlie_4.res"

const _MIXER := "res://addons/lobelight/runtime/mixing/table_mixer.gd"

# After this many changes of its widths, a material gets no more tables of its own.
const _FIRST_CHANGES := 1

# Sentences that have been told.
static var _told: Dictionary[String, bool] = {}
static var _mutex := Mutex.new()

## The lobes, where one table serves the whole surface; [code]null[/code] where widths vary or move,
## or there is a line alone.
var table: LobeTable
## The lobes of all widths, where these vary from pixel to pixel; otherwise [code]null[/code].
var widths_texture: WidthsTexture
## The lobes that need no table, if there are any.
var line := LineChoice.new()
## Whether widths vary from pixel to pixel.
var is_per_pixel := false
## The clear coat's lobes, or [code]null[/code].
var coat: LobeTable
## The sheen's lobes, or [code]null[/code].
var sheen: LobeTable
var is_isotropic := true
## The name of the lobes' BRDF.
var brdf := ""
var lobe_count := 1
## Whether the lobes come from a set, which goes with roughness and anisotropy.
var is_from_set := false
## Roughness, anisotropy and the angle of the first axis, as the shader is to take them.
var roughness := 0.0
var anisotropy := 0.0
var rotation := 0.0

# For widths that change: the isotropic tables of all widths, or a table that the GPU mixes.
var _rows: WidthsTexture
# How these are looked up: as LobeTable.get_lookup(), then scale and offset from a width's logarithm
# to v.
var _row_lookup: Vector4
var _row_step := 0.0
var _first_row := 0.0
var _mixed: MixedLobes
var _item: RID
var _due: Array[bool]
# How often the widths have changed, and the least and largest width of the set.
var _changes := 0
var _least := 0.0
var _largest := 1.0
var _ignores_anisotropy := false
# Whether the first axis is turned, and whether the axes have been exchanged for it.
var _has_turn := false
var _has_turned := false
# Whether other widths take no other table.
var _can_follow := false
var _stand_in: LobeTable


## Chooses the lobes for the material's present properties.
func choose(surface: LobeBaseMaterial3D) -> void:
	# Held until the end of this function: a set finds a shared table again only while somebody
	# holds it, and the rendering server still draws with its texture.
	@warning_ignore("unused_variable")
	var held := [table, widths_texture, coat, sheen, _rows, _mixed]
	roughness = surface.roughness
	anisotropy = surface.get_shown_anisotropy()
	rotation = surface.anisotropy_rotation
	table = null
	widths_texture = null
	_rows = null
	is_per_pixel = false
	line.clear()
	if surface.table == null and surface.table_set == null:
		# Before the ready set is loaded, which may not be needed.
		_turn(surface, false)
		_choose_line(DEFAULT_BRDF, surface, true)
		is_per_pixel = _has_line_alone() and surface.varies()
	var tables: LobeTableSet = null if _has_line_alone() else get_set(surface)
	is_from_set = surface.table == null and (tables != null or _has_line_alone())
	if not is_from_set:
		_choose_table(surface)
	elif tables != null:
		_choose_from(tables, surface)
	if is_from_set and _has_line_alone():
		_stand_in = null
		is_isotropic = false
		brdf = line.brdf
		lobe_count = line.count
	if table != null or widths_texture != null or is_isotropic or _has_line_alone():
		_mixed = null
	_can_follow = is_from_set and table == null and not _has_turned
	# A line alone follows only after its widths have changed often: until then get_narrowest()
	# counts.
	_can_follow = _can_follow and (_changes > _FIRST_CHANGES or not _has_line_alone())
	coat = null
	if surface.is_coated():
		coat = _get_layer(COAT_SET, Widths.from_coat_roughness(surface.clearcoat_roughness))
	sheen = null
	if surface.has_sheen():
		sheen = _get_layer(SHEEN_SET, surface.sheen_roughness * surface.sheen_roughness)


## A line of [param count] lobes of a BRDF of these widths, as it is, without compensation for lost
## energy: for comparisons.
func choose_line(of_brdf: String, alpha: Vector2, count: int) -> void:
	line.choose_count(of_brdf, count)
	brdf = of_brdf
	table = null
	_mixed = null
	is_from_set = false
	is_isotropic = false
	lobe_count = line.count
	var godots := Widths.to_roughness(alpha)
	roughness = godots.x
	anisotropy = godots.y


## Sets other widths at once if they need no other shader; otherwise returns false, and [method
## choose] has to be called. [param shown_anisotropy] is 0 if anisotropy is switched off. This is
## called for each animated material in each frame, so it does little.
func follow(new_roughness: float, shown_anisotropy: float, material: RID) -> bool:
	if not _can_follow:
		_changes += 1
		# Without a set widths do not count.
		return not is_from_set
	var turned := 0.0 if _ignores_anisotropy else shown_anisotropy
	if (turned == 0.0) != (anisotropy == 0.0) or turned < 0.0 and _has_turn:
		return false
	if new_roughness != roughness:
		roughness = new_roughness
		RenderingServer.material_set_param(material, &"lobelight_roughness", roughness)
	if _rows != null:
		var width := clampf(roughness * roughness, _least, _largest)
		_row_lookup.w = _row_step * log(width) + _first_row
		RenderingServer.material_set_param(material, &"lobelight_table_lookup", _row_lookup)
		return true
	if not line.follow(roughness, turned):
		return false
	if turned != anisotropy:
		anisotropy = turned
		RenderingServer.material_set_param(material, &"lobelight_anisotropy", anisotropy)
	if line.count > 0:
		var given := get_line_parameters()
		for name in given:
			RenderingServer.material_set_param(material, name, given[name])
	if _mixed != null:
		_mix()
	return true


## The texture of the lobes.
func get_texture() -> RID:
	if widths_texture != null:
		return widths_texture.texture.get_rid()
	if _rows != null:
		return _rows.texture.get_rid()
	if _mixed != null:
		return _mixed.texture
	return table.get_texture().get_rid()


## See [method LobeTable.get_lookup] and [member WidthsTexture.lookup].
func get_lookup() -> Vector4:
	if widths_texture != null:
		return widths_texture.lookup
	if _rows != null:
		var width := clampf(roughness * roughness, _least, _largest)
		_row_lookup.w = _row_step * log(width) + _first_row
		return _row_lookup
	if _mixed != null:
		return _mixed.lookup
	return table.get_lookup()


## The widths, by which the lobes' slopes are multiplied, if they are the same everywhere.
func get_alpha() -> Vector2:
	if table != null:
		return table.alpha
	if _mixed != null:
		return MixedLobes.ALPHA
	if not is_isotropic:
		return LineChoice.get_alpha(roughness, anisotropy)
	return Vector2.ONE * clampf(roughness * roughness, _least, _largest)


## The narrowest width among all lobes; 0 where widths vary or move.
func get_narrowest() -> float:
	if table == null and (not _has_line_alone() or is_per_pixel or _changes > _FIRST_CHANGES):
		return 0.0
	var widths := table.alpha if table != null else get_alpha()
	var narrowest := minf(widths.x, widths.y)
	for layer: LobeTable in [coat, sheen]:
		if layer != null:
			narrowest = minf(narrowest, layer.alpha.x)
	return narrowest


## Whether there is a table, alone or besides a line.
func has_table() -> bool:
	return not _has_line_alone()


## What the shader takes for lobes that need no table; empty if there are none.
func get_line_parameters() -> Dictionary[StringName, Variant]:
	if line.count == 0:
		return {}
	if is_per_pixel:
		return line.get_parameters_of_pixels(line.brdf)
	return line.get_parameters(roughness, anisotropy)


## Whether each lobe has a second texel.
func has_second_texels() -> bool:
	return table != null and table.has_second_texels()


## A number that differs if the lobes need another shader.
func get_shape() -> int:
	var shape := 64 * line.count + lobe_count
	var facts: Array[bool] = [
		coat != null,
		sheen != null,
		is_isotropic,
		is_from_set,
		is_per_pixel,
		line.fades,
		has_second_texels(),
		rotation != 0.0,
		anisotropy < 0.0,
	]
	for fact in facts:
		shape = 2 * shape + int(fact)
	return shape


func _choose_from(tables: LobeTableSet, surface: LobeBaseMaterial3D) -> void:
	_stand_in = null
	_least = tables.widths[0]
	_largest = tables.widths[-1]
	_turn(surface, tables.is_isotropic())
	lobe_count = tables.lobe_count
	brdf = tables.brdf
	is_isotropic = anisotropy == 0.0
	var can_vary := WidthsTexture.find_problem(tables.widths, is_isotropic).is_empty()
	is_per_pixel = surface.varies() and can_vary
	_choose_line(tables.brdf, surface, can_vary)
	if _has_line_alone():
		return
	if is_per_pixel:
		widths_texture = tables.get_widths_texture(is_isotropic)
	elif _changes > _FIRST_CHANGES and can_vary and is_isotropic:
		_rows = tables.get_widths_texture(true)
		_row_step = _rows.levels.x / log(2.0) * _rows.lookup.z
		_first_row = _rows.levels.y * _rows.lookup.z + _rows.lookup.w
		_row_lookup = _rows.lookup
	elif _changes > _FIRST_CHANGES and can_vary and _find_mixed(tables):
		_mix()
	else:
		table = tables.shared_table_at(Widths.from_roughness(roughness, anisotropy))
		is_isotropic = table.is_isotropic()


# How the surface lies, as the shader is to take it.
func _turn(surface: LobeBaseMaterial3D, ignores_anisotropy: bool) -> void:
	anisotropy = surface.get_shown_anisotropy()
	rotation = surface.anisotropy_rotation
	# Neither the engine nor flow maps turn negative anisotropy: axes that are turned are exchanged.
	_has_turn = rotation != 0.0 and surface.anisotropy_flowmap == null
	_has_turned = _has_turn and anisotropy < 0.0
	if _has_turned:
		anisotropy = Widths.exchanged(anisotropy)
		rotation += 0.5 * PI
	_ignores_anisotropy = ignores_anisotropy
	if _ignores_anisotropy:
		anisotropy = 0.0


# `can_vary` tells whether a table could be looked up for each pixel.
func _choose_line(of_brdf: String, surface: LobeBaseMaterial3D, can_vary: bool) -> void:
	line.choose(
		of_brdf,
		roughness,
		anisotropy,
		surface.get_most_lobes(),
		can_vary and surface.varies(),
		can_vary and surface.varies_in_anisotropy()
	)


func _has_line_alone() -> bool:
	return line.count > 0 and not line.fades


# Whether the GPU mixes the table. Exports leave the files for that out if no widths change.
func _find_mixed(tables: LobeTableSet) -> bool:
	if OnDemand.find_loss(_MIXER, OnDemand.MIXING):
		return false
	var mixer := OnDemand.fetch(_MIXER, OnDemand.MIXING) as GDScript
	_mixed = mixer.call(&"take", tables, _mixed)
	_item = _mixed.item
	_due = _mixed.due
	return true


func _mix() -> void:
	RenderingServer.canvas_item_set_instance_shader_parameter(
		_item, MixedLobes.SURFACE, Vector2(roughness, anisotropy)
	)
	if not _due[0]:
		_mixed.draw()


# A material's own table, or one that stands in for it.
func _choose_table(surface: LobeBaseMaterial3D) -> void:
	if surface.table != null and surface.table.get_problem().is_empty():
		_stand_in = null
		table = surface.table
	else:
		if _stand_in == null:
			_stand_in = LobeTable.make_single_lobe()
		if surface.table != null:
			_tell(surface.table, surface.table.get_file_problem())
		table = _stand_in
	line.clear()
	lobe_count = table.lobe_count
	brdf = table.brdf
	is_isotropic = table.is_isotropic()
	var godots := Widths.to_roughness(table.alpha)
	roughness = godots.x
	anisotropy = 0.0 if is_isotropic else godots.y


## The set that a material's lobes come from; null if it has a table of its own, or there is none.
static func get_set(surface: LobeBaseMaterial3D) -> LobeTableSet:
	if surface.table_set != null:
		_tell(surface.table_set, surface.table_set.get_file_problem())
		return surface.table_set if surface.table_set.get_problem().is_empty() else null
	if surface.table != null:
		return null
	return _get_ready_set(DEFAULT_SET)


## The lobes without a table that a surface draws with widths.
static func find_line(
	surface: LobeBaseMaterial3D, with_roughness: float, with_anisotropy: float
) -> LineChoice:
	var found := LineChoice.new()
	if surface.table != null:
		return found
	var tables := surface.table_set
	var of_brdf := DEFAULT_BRDF
	if tables != null:
		var is_usable := tables.get_problem().is_empty() and not tables.is_isotropic()
		of_brdf = tables.brdf if is_usable else ""
	found.choose(
		of_brdf,
		with_roughness,
		with_anisotropy,
		surface.get_most_lobes(),
		surface.varies(),
		surface.varies_in_anisotropy()
	)
	return found


# Null if there is none.
static func _get_layer(path: String, width: float) -> LobeTable:
	var tables := _get_ready_set(path)
	if tables == null:
		return null
	return tables.shared_table_at(Vector2.ONE * maxf(width, tables.widths[0]))


# Null if there is none.
static func _get_ready_set(path: String) -> LobeTableSet:
	var found := OnDemand.find(path) as LobeTableSet
	if found != null and found.get_file_problem():
		_tell(found, found.get_file_problem())
		return null
	return found


# Of a file that cannot be used, once. Tables that are not baked yet are nobody's mistake.
static func _tell(tables: Resource, problem: String) -> void:
	if problem.is_empty():
		return
	var named := tables.resource_path if tables.resource_path else "Table"
	var sentence := "LobeMaterial3D: %s: %s" % [named, problem]
	_mutex.lock()
	var is_new := not _told.has(sentence)
	_told[sentence] = true
	_mutex.unlock()
	if is_new:
		push_error(sentence)
