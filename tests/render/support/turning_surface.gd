extends LobeMaterial3D
## Draws a surface that turns, see turning_surface.gdshaderinc.

const NORMALS := 8192


func _get_fragment_path() -> String:
	return "res://tests/render/support/turning_surface.gdshaderinc"
