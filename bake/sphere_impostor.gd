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


func _get_fragment_path() -> String:
	return FRAGMENT_PATH
