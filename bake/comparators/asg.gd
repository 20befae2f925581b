extends "line_method.gd"
## `asg`: the density of the normals as one anisotropic spherical Gaussian, warped into the light,
## Xu et al. 2013, "Anisotropic Spherical Gaussians"; see asg.gdshaderinc for how it meets the
## environment here.


func make_sphere() -> MeshInstance3D:
	return _make_line_sphere(
		"asg.gdshaderinc",
		"asg_specular",
		false,
		{&"asg_weight": Microfacet.normals_integral(brdf, alpha)}
	)


func settings() -> Dictionary:
	var found := super()
	found["environment"] = "round lobes along the longer axis, not the paper's sum of Gaussians"
	return found
