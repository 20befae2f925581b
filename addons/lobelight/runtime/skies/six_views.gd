@tool
extends "../pyramid/face_views.gd"
## Six cameras that see everything around a point, for level 0 of a pyramid.
##
## They draw linear light up to 65504, and in Compatibility the engine's encoding of it. The views
## stay, and drawing again allocates nothing. Everything on the rendering server is freed with the
## object.

const NeutralLight := preload("../light/neutral_light.gd")

## Of the shadows of omni and spot lights, as a [Viewport] has them.
const _SHADOW_ATLAS := 2048
const _SHADOW_SUBDIVISIONS: PackedInt32Array = [4, 4, 16, 64]

## Pixels along the side of a view.
var size: int

var _cameras: Array[RID] = []
# What the views need on the rendering server: kept until they have gone.
var _owner: RefCounted
var _environment: Environment


## Views of a scenario, which lives as long as [param owner], and with shadows of omni and spot
## lights if they are wanted. They show nothing before [method show] and [method place].
func _init(side: int, scenario: RID, owner: RefCounted, shadows: bool) -> void:
	size = side
	_owner = owner
	var server := RenderingServer
	for face in 6:
		var camera := server.camera_create()
		_cameras.append(camera)
		var viewport := server.viewport_create()
		server.viewport_set_use_hdr_2d(viewport, true)
		server.viewport_set_size(viewport, side, side)
		server.viewport_set_scenario(viewport, scenario)
		server.viewport_attach_camera(viewport, camera)
		if shadows:
			server.viewport_set_positional_shadow_atlas_size(viewport, _SHADOW_ATLAS, true)
			for quadrant in 4:
				server.viewport_set_positional_shadow_atlas_quadrant_subdivision(
					viewport, quadrant, _SHADOW_SUBDIVISIONS[quadrant]
				)
		server.viewport_set_update_mode(viewport, RenderingServer.VIEWPORT_UPDATE_DISABLED)
		server.viewport_set_active(viewport, true)
		viewports.append(viewport)


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		for rid in viewports + _cameras:
			RenderingServer.free_rid(rid)


## What there is behind the scene, and its ambient light.
func show(environment: Environment) -> void:
	if environment == _environment:
		return
	_environment = environment
	for camera in _cameras:
		RenderingServer.camera_set_environment(camera, environment.get_rid())


## What the views see, from where, by the axes of the cube in the world.
func place(origin: Vector3, axes: Basis, near: float, far: float, cull_mask: int) -> void:
	var server := RenderingServer
	for face in 6:
		# A view's rows are the rows of its face.
		var forward := NeutralLight.face_direction(face, Vector2.ZERO)
		var up := forward - NeutralLight.face_direction(face, Vector2.DOWN)
		var basis := axes * Basis.looking_at(forward, up)
		server.camera_set_transform(_cameras[face], Transform3D(basis, origin))
		server.camera_set_perspective(_cameras[face], 90.0, near, far)
		server.camera_set_cull_mask(_cameras[face], cull_mask)
