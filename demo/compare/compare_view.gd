extends CanvasLayer
## Two methods side by side: the left one is drawn by the camera of the scene, the right one by a
## second camera into a viewport of its own, which is laid over the picture from the divider on.
##
## Both see the same world; layers tell their objects apart. Each half covers what the other shows
## before anything is shaded, and a half of no width is not drawn at all.

const CoverShader := preload("cover.gdshader")
const Layers := preload("../layers.gd")

## Whether there is a second method.
var is_comparing := false:
	set(value):
		is_comparing = value
		_update()
## Where the right half begins, in widths of the picture.
var divider := 0.5:
	set(value):
		divider = clampf(value, 0.0, 1.0)
		_update()

var _camera: Camera3D
var _view: SubViewport
var _right_camera: Camera3D
var _left_cover: MeshInstance3D
var _right_cover: MeshInstance3D
var _picture := Control.new()


## [param camera] is that of the scene.
func set_up(camera: Camera3D) -> void:
	_camera = camera
	layer = 0
	_picture.texture_filter = CanvasItem.TEXTURE_FILTER_NEAREST
	_picture.mouse_filter = Control.MOUSE_FILTER_IGNORE
	_picture.draw.connect(_draw_right)
	add_child(_picture)
	_left_cover = _make_cover(Layers.LEFT_COVER)
	camera.add_child(_left_cover)
	get_viewport().size_changed.connect(_update)
	_update()


## Where the right half begins, in pixels: the picture's width if nothing is compared.
func get_divider_pixel() -> int:
	var width := _size().x
	return roundi(divider * width) if is_comparing else width


## The viewports that are drawn, as resources of the rendering server: the left half's and the right
## half's, or the empty one.
func get_viewports() -> Array[RID]:
	var at := get_divider_pixel()
	var main := get_viewport().get_viewport_rid()
	var halves: Array[RID] = [main, RID()]
	if is_comparing and at <= 0:
		halves = [RID(), main]
	elif is_comparing and at < _size().x:
		halves[1] = _view.get_viewport_rid()
	return halves


func _process(_delta: float) -> void:
	if _view != null and _view.render_target_update_mode == SubViewport.UPDATE_ALWAYS:
		_follow_camera()


func _size() -> Vector2i:
	return Vector2i(get_viewport().get_visible_rect().size)


func _update() -> void:
	if _camera == null or not is_inside_tree():
		return
	var size := _size()
	var at := get_divider_pixel()
	var is_split := is_comparing and at > 0 and at < size.x
	var is_right_only := is_comparing and at <= 0
	var common := Layers.COMMON | Layers.STUDIO
	_camera.cull_mask = common | (Layers.RIGHT if is_right_only else Layers.LEFT)
	if is_split:
		_camera.cull_mask |= Layers.LEFT_COVER
		if _view == null:
			_make_view()
		_view.size = size
		_set_span(_left_cover, Vector2(at, size.x) / size.x)
		_set_span(_right_cover, Vector2(0, at) / size.x)
		_follow_camera()
	if _view != null:
		_view.render_target_update_mode = (
			SubViewport.UPDATE_ALWAYS if is_split else SubViewport.UPDATE_DISABLED
		)
	_picture.visible = is_split
	_picture.queue_redraw()


func _make_view() -> void:
	var main := get_viewport()
	_view = SubViewport.new()
	_view.use_hdr_2d = main.use_hdr_2d
	_view.msaa_3d = main.msaa_3d
	_view.handle_input_locally = false
	add_child(_view)
	_right_camera = Camera3D.new()
	_right_camera.cull_mask = (Layers.COMMON | Layers.STUDIO | Layers.RIGHT | Layers.RIGHT_COVER)
	_right_cover = _make_cover(Layers.RIGHT_COVER)
	_right_camera.add_child(_right_cover)
	_view.add_child(_right_camera)


func _make_cover(visual_layer: int) -> MeshInstance3D:
	var corners := PackedVector3Array(
		[Vector3.ZERO, Vector3.RIGHT, Vector3(1.0, 1.0, 0.0), Vector3.UP]
	)
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = corners
	arrays[Mesh.ARRAY_INDEX] = PackedInt32Array([0, 1, 2, 0, 2, 3])
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	# It is placed on the screen by its shader, so nothing of it may be culled.
	mesh.custom_aabb = AABB(-100.0 * Vector3.ONE, 200.0 * Vector3.ONE)
	var cover := MeshInstance3D.new()
	cover.mesh = mesh
	cover.layers = visual_layer
	cover.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	var black := ShaderMaterial.new()
	black.shader = CoverShader
	# Before everything else.
	black.render_priority = -128
	cover.material_override = black
	return cover


func _set_span(cover: MeshInstance3D, span: Vector2) -> void:
	(cover.material_override as ShaderMaterial).set_shader_parameter(&"span", span)


func _follow_camera() -> void:
	_right_camera.global_transform = _camera.global_transform
	_right_camera.fov = _camera.fov
	_right_camera.near = _camera.near
	_right_camera.far = _camera.far
	_right_camera.h_offset = _camera.h_offset
	_right_camera.v_offset = _camera.v_offset


func _draw_right() -> void:
	if _view == null:
		return
	var size := Vector2(_size())
	var at := get_divider_pixel()
	var right := Rect2(at, 0.0, size.x - at, size.y)
	_picture.draw_texture_rect_region(_view.get_texture(), right, right)
