extends Node
## Where materials with shaders of one's own are drawn beside the equal LobeMaterial3D: a sphere
## under an environment.

const Kit := preload("render_kit.gd")
const Oracle := preload("material_oracle.gd")
const SIDE := 48
const COLOUR := Color(0.9, 0.6, 0.3)

var view := LinearViewport.new(SIDE)
var environment := LobeEnvironment3D.new()
var sphere: MeshInstance3D = Kit.make_sphere(null)


func _init() -> void:
	add_child(view)
	view.add_child(environment)
	view.add_child(sphere)


## Light without symmetry, with a sun of this radiance. To be awaited.
func light_up(sun: float) -> void:
	var direction := Vector3(0.3, 0.5, 0.8).normalized()
	var light := func(d: Vector3) -> Color:
		var colour: Color = Oracle.light(d)
		return colour + Color.WHITE * sun if d.dot(direction) > 0.9995 else colour
	environment.panorama = Kit.make_panorama(128, light)
	await environment.rebuild()
	# Sources are found while frames are drawn.
	for frame in 8:
		await view.capture()


## The sphere with a material. To be awaited.
func capture(material: Material) -> Image:
	(sphere.mesh as PrimitiveMesh).material = material
	await view.capture()
	return await view.capture()


## What a LobeMaterial3D of these properties is.
static func lobe_material(roughness: float, anisotropy: float, metallic: float) -> LobeMaterial3D:
	var material := LobeMaterial3D.new()
	material.albedo_color = COLOUR
	material.metallic = metallic
	material.roughness = roughness
	material.anisotropy_enabled = anisotropy != 0.0
	material.anisotropy = anisotropy
	return material


## The largest difference of two pictures as screens show them, and the mean of the second one.
static func compare(picture: Image, expected: Image) -> Dictionary[String, float]:
	var largest := 0.0
	var mean := 0.0
	for y in SIDE:
		for x in SIDE:
			var one := picture.get_pixel(x, y).linear_to_srgb()
			var other := expected.get_pixel(x, y).linear_to_srgb()
			for channel in 3:
				mean += other[channel] / (3 * SIDE * SIDE)
				largest = maxf(largest, absf(minf(one[channel], 1.0) - minf(other[channel], 1.0)))
	return {"largest": largest, "mean": mean}
