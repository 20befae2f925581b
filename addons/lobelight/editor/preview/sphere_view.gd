@tool
extends TextureRect
## A sphere with a [LobeMaterial3D] in a world of its own, seen as the reference renders it: a unit
## sphere from +z, orthographically, with the tangent along the equator.

## Pixels along the side of the picture.
const SIZE := 128

const LightRegistry := preload("../../runtime/light/light_registry.gd")

## What the sphere is made of.
var material_3d: LobeMaterial3D:
	set(value):
		material_3d = value
		_sphere.material_override = value

## The least width and height at the editor's scale 1.
var least_size := Vector2(SIZE, SIZE)

var _viewport := SubViewport.new()
var _sphere := MeshInstance3D.new()


func _init() -> void:
	expand_mode = TextureRect.EXPAND_IGNORE_SIZE
	stretch_mode = TextureRect.STRETCH_KEEP_ASPECT_CENTERED
	size_flags_horizontal = SIZE_EXPAND_FILL
	_viewport.own_world_3d = true
	_viewport.transparent_bg = true
	_viewport.size = Vector2i(SIZE, SIZE)
	_viewport.msaa_3d = Viewport.MSAA_4X
	var mesh := SphereMesh.new()
	mesh.radial_segments = 96
	mesh.rings = 48
	mesh.radius = 1.0
	mesh.height = 2.0
	_sphere.mesh = mesh
	var camera := Camera3D.new()
	camera.set_orthogonal(2.0, 0.1, 10.0)
	camera.position = Vector3(0.0, 0.0, 3.0)
	_viewport.add_child(_sphere)
	_viewport.add_child(camera)
	add_child(_viewport)
	texture = _viewport.get_texture()


func _enter_tree() -> void:
	custom_minimum_size = least_size * EditorInterface.get_editor_scale()
	# The engine draws what is visible from the frame after it has been shown on: until then the
	# memory of the texture, whatever is in it, would be seen.
	_viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	if not RenderingServer.frame_post_draw.is_connected(_draw_when_visible):
		RenderingServer.frame_post_draw.connect(_draw_when_visible, CONNECT_ONE_SHOT)


## Lights the sphere by a light of its own, rather than by that of the edited scene.
func set_light(light: LobeLight) -> void:
	LightRegistry.remove_material(material_3d.get_rid())
	light.apply(material_3d.get_rid())


## Waits until what was set last has been drawn.
func draw_picture() -> void:
	for frame in 2:
		# The editor draws a frame only where something has changed.
		queue_redraw()
		await RenderingServer.frame_post_draw


## The picture as it is shown, once it has been drawn.
func get_picture() -> Image:
	return _viewport.get_texture().get_image()


func _draw_when_visible() -> void:
	_viewport.render_target_update_mode = SubViewport.UPDATE_WHEN_VISIBLE
