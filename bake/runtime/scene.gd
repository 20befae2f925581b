extends RefCounted
## What the parts of `./dev bench runtime` draw: a frame that eight lobes light, and panoramas.

const TABLES := "res://addons/lobelight/tables/ggx_8.res"
const FRAME := Vector2i(1280, 720)
const ALPHA := Vector2(0.1, 0.1)


## A viewport of 720p, its sides divided by [param scale], that a sphere fills.
static func make_view(tree: SceneTree, scale: int) -> LinearViewport:
	var view := LinearViewport.new()
	view.size = FRAME / scale
	tree.root.add_child(view)
	view.add_child(_make_sphere())
	return view


# Eight lobes in every pixel of a frame, of all directions and many levels.
static func _make_sphere() -> MeshInstance3D:
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = (load(TABLES) as LobeTableSet).table_at(ALPHA)
	var mesh := SphereMesh.new()
	mesh.radius = 1.0
	mesh.height = 2.0
	mesh.material = material
	var sphere := MeshInstance3D.new()
	sphere.mesh = mesh
	sphere.scale = Vector3(3.0, 3.0, 1.0)
	return sphere


## Light of all sizes and strengths, in half floats.
static func make_panorama(size: Vector2i) -> ImageTexture:
	var random := RandomNumberGenerator.new()
	random.seed = 7
	var image := Image.create_empty(64, 32, false, Image.FORMAT_RGBF)
	for y in 32:
		for x in 64:
			var strength := pow(2.0, random.randf_range(-4.0, 4.0))
			image.set_pixel(x, y, strength * Color(random.randf(), random.randf(), random.randf()))
	image.resize(size.x, size.y, Image.INTERPOLATE_BILINEAR)
	image.convert(Image.FORMAT_RGBH)
	return ImageTexture.create_from_image(image)


## What textures take on the GPU, in bytes.
static func texture_bytes() -> int:
	return RenderingServer.get_rendering_info(RenderingServer.RENDERING_INFO_TEXTURE_MEM_USED)
