@tool
extends RefCounted
## Which lobes a [LobeMaterial3D] draws: a table, or all tables of a set.

const Widths := preload("../table/widths.gd")
const WidthsTexture := preload("../table/widths_texture.gd")
const DEFAULT_SET := "res://addons/lobelight/tables/ggx_8.res"
const SHEEN_SET := "res://addons/lobelight/tables/charlie_4.res"

# Kept from one look to the next: loading a set takes a while.
static var _sets: Dictionary[String, LobeTableSet] = {}
static var _mutex := Mutex.new()

## The lobes, where one table serves the whole surface.
var table: LobeTable
## The lobes of all widths, where these vary from pixel to pixel; otherwise [code]null[/code].
var widths_texture: WidthsTexture
## The clear coat's lobes, or [code]null[/code].
var coat: LobeTable
## The sheen's lobes, or [code]null[/code].
var sheen: LobeTable
var is_isotropic := true
var lobe_count := 1
## Whether the lobes come from a set, which goes with roughness and anisotropy.
var is_from_set := false
## Roughness, anisotropy and the angle of the first axis, as the shader is to take them.
var roughness := 0.0
var anisotropy := 0.0
var rotation := 0.0

var _stand_in: LobeTable


## Looks anew at what the material says.
func choose(surface: LobeBaseMaterial3D) -> void:
	# Sets find a shared table again only while somebody holds it, and the rendering server goes on
	# drawing with its texture.
	@warning_ignore("unused_variable")
	var held := [table, widths_texture, coat, sheen]
	roughness = surface.roughness
	anisotropy = surface.get_shown_anisotropy()
	rotation = surface.anisotropy_rotation
	table = null
	widths_texture = null
	var tables := get_set(surface)
	is_from_set = surface.table == null and tables != null
	if is_from_set:
		_choose_from(tables, surface)
	else:
		_choose_table(surface)
	coat = null
	if surface.is_coated() and tables != null:
		var width := Widths.from_coat_roughness(surface.clearcoat_roughness)
		coat = tables.shared_table_at(Vector2(width, width))
	sheen = null
	if surface.has_sheen():
		_choose_sheen(surface)


## A number that is another one where the shader's code is, as far as it goes by the lobes.
func get_shape() -> int:
	var has_second_texels := table != null and table.has_second_texels()
	var shape := lobe_count
	shape = 64 * shape + (coat.lobe_count if coat != null else 0)
	shape = 64 * shape + (sheen.lobe_count if sheen != null else 0)
	var facts: Array[bool] = [
		is_isotropic,
		is_from_set,
		widths_texture != null,
		has_second_texels,
		rotation != 0.0,
		anisotropy < 0.0,
	]
	for fact in facts:
		shape = 2 * shape + int(fact)
	return shape


func _choose_from(tables: LobeTableSet, surface: LobeBaseMaterial3D) -> void:
	_stand_in = null
	# Neither the engine nor flow maps turn negative anisotropy.
	if anisotropy < 0.0 and rotation != 0.0 and surface.anisotropy_flowmap == null:
		anisotropy = Widths.exchanged(anisotropy)
		rotation += 0.5 * PI
	if tables.is_isotropic():
		anisotropy = 0.0
	lobe_count = tables.lobe_count
	is_isotropic = anisotropy == 0.0
	if surface.varies() and WidthsTexture.find_problem(tables.widths, is_isotropic).is_empty():
		widths_texture = tables.get_widths_texture(is_isotropic)
	else:
		table = tables.shared_table_at(Widths.from_roughness(roughness, anisotropy))
		is_isotropic = table.is_isotropic()


func _choose_sheen(surface: LobeBaseMaterial3D) -> void:
	var tables := _get_ready_set(SHEEN_SET)
	if tables != null:
		var width := surface.sheen_roughness * surface.sheen_roughness
		sheen = tables.shared_table_at(Vector2.ONE * maxf(width, tables.widths[0]))


# A material's own table, or one that stands in for it.
func _choose_table(surface: LobeBaseMaterial3D) -> void:
	if surface.table != null and surface.table.get_problem().is_empty():
		_stand_in = null
		table = surface.table
	else:
		if _stand_in == null:
			_stand_in = LobeTable.make_single_lobe()
		table = _stand_in
	lobe_count = table.lobe_count
	is_isotropic = table.is_isotropic()
	var godots := Widths.to_roughness(table.alpha)
	roughness = godots.x
	anisotropy = 0.0 if is_isotropic else godots.y


## The set that a material's lobes, or its coat's, come from; null if it has a table of its own and
## no coat, or there is none.
static func get_set(surface: LobeBaseMaterial3D) -> LobeTableSet:
	if surface.table_set != null:
		return surface.table_set if surface.table_set.get_problem().is_empty() else null
	if surface.table != null and not surface.is_coated():
		return null
	return _get_ready_set(DEFAULT_SET)


# Null if there is none.
static func _get_ready_set(path: String) -> LobeTableSet:
	_mutex.lock()
	var found: LobeTableSet = _sets.get(path)
	_mutex.unlock()
	# Not under the lock: who loads may wait for other threads, and these for the lock. The loader
	# gives all of them the same set.
	if found == null and ResourceLoader.exists(path):
		found = load(path)
		_mutex.lock()
		_sets[path] = found
		_mutex.unlock()
	return found
