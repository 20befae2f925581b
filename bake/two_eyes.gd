extends SubViewport
## Two eyes on a scene, by the engine's own interface for phones in a holder, which needs no
## headset; and what a camera with one picture shows from where each eye is.
##
## The project is to have shaders for two eyes (xr/shaders/enabled), see tools/lib/stereo.sh.

const NAME := "Native mobile"
const LEFT := 0
const RIGHT := 1

var interface: MobileVRInterface
var origin := XROrigin3D.new()
var camera := XRCamera3D.new()
## With one picture, of the same world.
var single: LinearViewport


## Each eye's picture is [param side] pixels wide and high; the window is made to fit.
func _init(side := 64) -> void:
	DisplayServer.window_set_size(Vector2i(2 * side, side))
	interface = XRServer.find_interface(NAME) as MobileVRInterface
	interface.oversample = 1.0
	interface.eye_height = 0.0
	interface.initialize()
	single = LinearViewport.new(side)
	use_hdr_2d = true
	transparent_bg = true
	own_world_3d = true
	use_debanding = false
	use_xr = true
	camera.environment = single.camera.environment
	camera.near = 0.05
	camera.far = 20.0
	add_child(origin)
	origin.add_child(camera)


## Whether the renderer that is running can draw two pictures at once. Compatibility could where the
## driver has OVR_multiview, which Mesa's drivers in software have not.
static func are_possible() -> bool:
	return not LinearViewport.is_compatibility()


func _ready() -> void:
	single.own_world_3d = false
	single.world_3d = find_world_3d()
	add_sibling.call_deferred(single)


func _exit_tree() -> void:
	use_xr = false
	interface.uninitialize()
	single.queue_free()


## Draws a frame and gives both eyes' pictures as linear radiance, RGBAF. To be awaited.
func capture() -> Array[Image]:
	await RenderingServer.frame_post_draw
	var texture := RenderingServer.viewport_get_texture(get_viewport_rid())
	var pictures: Array[Image] = []
	for eye: int in [LEFT, RIGHT]:
		var picture := RenderingServer.texture_2d_layer_get(texture, eye)
		picture.convert(Image.FORMAT_RGBAF)
		pictures.append(picture)
	return pictures


## The same eye's picture, drawn by a camera that is where the eye is and has its frustum. To be
## awaited.
func capture_single(eye: int) -> Image:
	var projection := get_projection(eye)
	var scale := Vector2(projection.x.x, projection.y.y)
	single.camera.set_frustum(
		2.0 * camera.near / scale.y,
		camera.near * Vector2(projection.z.x, projection.z.y) / scale,
		camera.near,
		camera.far
	)
	single.camera.global_transform = get_eye(eye)
	return await single.capture()


## Where an eye is, in the world.
func get_eye(eye: int) -> Transform3D:
	return interface.get_transform_for_view(eye, origin.global_transform)


func get_projection(eye: int) -> Projection:
	return interface.get_projection_for_view(eye, 1.0, camera.near, camera.far)
