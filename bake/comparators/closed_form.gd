extends "line_method.gd"
## `closed8`: eight lobes along the highlight with weights in closed form, without a table; see
## closed_form.gdshaderinc.


func make_sphere() -> MeshInstance3D:
	return _make_line_sphere("closed_form.gdshaderinc", "closed_form_specular", brdf == "ggx")
