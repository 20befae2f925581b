extends "demo_command.gd"
## Draws what two eyes see of brushed and of plain metal, side by side: tools/guide/stereo.sh.

const TwoEyes := preload("res://bake/two_eyes.gd")
const SurfaceMesh := preload("res://demo/meshes/surface_mesh.gd")
const Surfaces := preload("res://demo/meshes/surfaces.gd")
const SIDE := 320
const PANORAMA := "res://demo/environments/hall.exr"
# Frames until the engine's own maps are there.
const _SETTLING := 6


func _work(out: String) -> void:
	var eyes := TwoEyes.new(SIDE)
	eyes.use_hdr_2d = false
	eyes.transparent_bg = false
	# Each eye before the middle of its lens.
	eyes.interface.display_width = 2.0 * eyes.interface.iod
	eyes.interface.display_to_lens = 9.0
	eyes.msaa_3d = Viewport.MSAA_4X
	eyes.camera.environment = _make_surroundings()
	root.add_child(eyes)
	eyes.origin.position = Vector3(0.0, 0.0, 0.6)
	var light := LobeEnvironment3D.new()
	light.panorama = load(PANORAMA)
	eyes.add_child(light)
	var ball := Surfaces.sphere.bind(0.06)
	var knot := Surfaces.knot.bind(0.022, 0.016)
	eyes.add_child(_make_object(ball, 0.15, 0.0, Vector3(-0.065, 0.0, 0.0)))
	eyes.add_child(_make_object(knot, 0.35, 0.8, Vector3(0.075, 0.0, -0.02)))
	if not await light.rebuild():
		_arguments.fail(light.get_rebuild_error())
		return
	for frame in _SETTLING:
		await process_frame
	var pictures := await eyes.capture()
	var picture := Image.create_empty(2 * SIDE, SIDE, false, Image.FORMAT_RGB8)
	for eye: int in [TwoEyes.LEFT, TwoEyes.RIGHT]:
		pictures[eye].convert(Image.FORMAT_RGB8)
		picture.blit_rect(
			pictures[eye],
			Rect2i(0, 0, SIDE, SIDE),
			Vector2i(SIDE if eye == TwoEyes.RIGHT else 0, 0)
		)
	eyes.queue_free()
	if picture.save_png(out) != OK:
		_arguments.fail("%s: cannot be written." % out)


func _make_surroundings() -> Environment:
	var panorama := PanoramaSkyMaterial.new()
	panorama.panorama = load(PANORAMA)
	var surroundings := Environment.new()
	surroundings.background_mode = Environment.BG_SKY
	surroundings.tonemap_mode = Environment.TONE_MAPPER_ACES
	surroundings.tonemap_exposure = 0.5
	surroundings.sky = Sky.new()
	surroundings.sky.sky_material = panorama
	return surroundings


func _make_object(
	surface: Callable, roughness: float, anisotropy: float, place: Vector3
) -> MeshInstance3D:
	var material := LobeMaterial3D.new()
	material.albedo_color = Color(0.95, 0.9, 0.82)
	material.metallic = 1.0
	material.roughness = roughness
	material.anisotropy_enabled = anisotropy > 0.0
	material.anisotropy = anisotropy
	material.anisotropy_rotation = 0.5 * PI
	var object := MeshInstance3D.new()
	object.mesh = SurfaceMesh.build(surface, 160, 48)
	object.material_override = material
	object.position = place
	return object
