class_name SphereImpostor
extends LobeMaterial3D
## A [LobeMaterial3D] that draws the unit sphere on a quad, with exact normals, as pictures that are
## compared pixel by pixel need it.
##
## The picture: pixel (c, r) of [code]side[/code]² is x = (2c + 1) / side − 1,
## y = 1 − (2r + 1) / side, the normal n = (x, y, √(1 − x² − y²)), the viewer at +z and the tangent
## along (0, 1, 0) × n. Everything but the normals is the shader of the addon.

## The fragment function.
const FRAGMENT_PATH := "res://bake/sphere_impostor.gdshaderinc"

# [brdf, widths, number of lobes] of a line.
var _line := []


## The quad, to be put into a [LinearViewport], with a material made of the table.
static func make(used_table: LobeTable) -> MeshInstance3D:
	var material := SphereImpostor.new()
	material.table = used_table
	return make_quad(material)


## The quad with any material that has the fragment function.
static func make_quad(material: Material) -> MeshInstance3D:
	var quad := QuadMesh.new()
	quad.size = Vector2(2.0, 2.0)
	quad.material = material
	var instance := MeshInstance3D.new()
	instance.mesh = quad
	return instance


## Draws the lobes of a line, see [LobeBaseMaterial3D.quality], whatever the widths are.
func show_line(brdf: String, widths: Vector2, count: int) -> void:
	_line = [brdf, widths, count]
	_queue_update()


## Draws the widths as any material does.
func show_widths(widths: Vector2) -> void:
	# The longer one first: there is no end to these.
	var godots := Widths.to_roughness(Vector2(maxf(widths.x, widths.y), minf(widths.x, widths.y)))
	anisotropy_rotation = 0.5 * PI if widths.x < widths.y else 0.0
	anisotropy_enabled = true
	roughness = godots.x
	anisotropy = godots.y


# Without compensation for lost energy, as the reference is.
func _look() -> void:
	super()
	if _line:
		_choice.choose_line(_line[0], _line[1], _line[2])
	_choice.is_from_set = false


func _get_fragment_path() -> String:
	return FRAGMENT_PATH
