extends RefCounted
## Scenes that the engine lights with all that it has: white spheres, matte and half glossy, before
## a white wall, whose materials are to be compared.

enum Kind { SCREEN_OCCLUSION, LIGHTMAP, VOXELS, SDFGI, PROBE }

const LightmapByHand := preload("lightmap_by_hand.gd")
const TITLES: PackedStringArray = [
	"Ambient light and SSAO", "LightmapGI", "VoxelGI", "SDFGI", "ReflectionProbe and SSR"
]
## Frames until what the engine gathers over them is there.
const SETTLING := [12, 12, 16, 60, 12]

## Whose materials are compared.
var subjects: Array[MeshInstance3D] = []
var surroundings := Environment.new()
var lobe_environment := LobeEnvironment3D.new()


## Which of them a renderer has. SSAO is in Compatibility, too, on the whole picture.
static func of_renderer(method: String) -> Array[Kind]:
	if method == "forward_plus":
		return [Kind.SCREEN_OCCLUSION, Kind.LIGHTMAP, Kind.VOXELS, Kind.SDFGI, Kind.PROBE]
	return [Kind.SCREEN_OCCLUSION, Kind.LIGHTMAP]


## Godot's materials of the subjects: matte, half glossy, and the wall's.
static func make_materials(with_specular: bool) -> Array[StandardMaterial3D]:
	var materials: Array[StandardMaterial3D] = []
	for roughness: float in [1.0, 0.5, 0.9]:
		var material := StandardMaterial3D.new()
		material.albedo_color = Color(0.9, 0.9, 0.9)
		material.roughness = roughness
		material.metallic_specular = 0.5 if with_specular else 0.0
		materials.append(material)
	return materials


## Fills a viewport with a world of its own, and the subjects with Godot's materials.
func _init(view: SubViewport, kind: Kind) -> void:
	view.own_world_3d = true
	_add_surroundings(view)
	_add_box(view, Vector3(6.0, 0.2, 6.0), Vector3(0.0, -0.1, 0.0), Color(0.35, 0.3, 0.25))
	_add_box(view, Vector3(0.2, 2.0, 2.6), Vector3(-2.0, 1.0, 0.2), Color(0.8, 0.15, 0.1))
	var materials := make_materials(true)
	for index in 2:
		var ball := MeshInstance3D.new()
		var sphere := SphereMesh.new()
		sphere.radius = 0.5
		sphere.height = 1.0
		ball.mesh = sphere
		ball.position = Vector3(1.2 * index - 0.6, 0.5, 0.2)
		# Lightmaps are for what stands still, what they capture for what moves.
		var is_captured := kind == Kind.LIGHTMAP
		ball.gi_mode = (
			GeometryInstance3D.GI_MODE_DYNAMIC if is_captured else GeometryInstance3D.GI_MODE_STATIC
		)
		ball.material_override = materials[index]
		subjects.append(ball)
		view.add_child(ball)
	var wall := _add_box(view, Vector3(3.6, 2.0, 0.2), Vector3(0.0, 1.0, -1.0), Color.WHITE)
	wall.material_override = materials[2]
	subjects.append(wall)
	match kind:
		Kind.SCREEN_OCCLUSION:
			if RenderingServer.get_current_rendering_method() != "mobile":
				surroundings.ssao_enabled = true
				surroundings.ssao_intensity = 4.0
		Kind.LIGHTMAP:
			view.add_child(LightmapByHand.make(view, [wall]))
		Kind.VOXELS:
			_add_lamp(view)
			_add_voxels(view)
		Kind.SDFGI:
			_add_lamp(view)
			surroundings.sdfgi_enabled = true
			surroundings.sdfgi_min_cell_size = 0.1
			surroundings.sdfgi_cascades = 2
			surroundings.sdfgi_use_occlusion = true
		Kind.PROBE:
			surroundings.ssr_enabled = true


## Adds a probe, which captures the scene once, so that all else has to be there before.
func add_probe(view: SubViewport) -> void:
	var probe := ReflectionProbe.new()
	probe.size = Vector3(8.0, 6.0, 8.0)
	probe.position.y = 2.0
	view.add_child(probe)


## Gives the subjects these materials, in the order of [method make_materials].
func dress(materials: Array) -> void:
	for index in subjects.size():
		subjects[index].material_override = materials[index]


func _add_surroundings(view: SubViewport) -> void:
	surroundings.background_mode = Environment.BG_SKY
	surroundings.sky = Sky.new()
	# The engine multiplies a sky's ambient light by the background's energy twice: it is left at 1.
	surroundings.sky.sky_material = ProceduralSkyMaterial.new()
	surroundings.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	var camera := Camera3D.new()
	camera.environment = surroundings
	camera.fov = 40.0
	camera.position = Vector3(0.3, 1.4, 4.0)
	camera.basis = Basis.looking_at(Vector3(-0.1, 0.7, 0.0) - camera.position)
	view.add_child(camera)
	lobe_environment.update_mode = LobeEnvironment3D.UpdateMode.ONCE
	view.add_child(lobe_environment)


func _add_box(view: SubViewport, size: Vector3, at: Vector3, colour: Color) -> MeshInstance3D:
	var box := MeshInstance3D.new()
	var mesh := BoxMesh.new()
	mesh.size = size
	mesh.add_uv2 = true
	box.mesh = mesh
	box.position = at
	var material := StandardMaterial3D.new()
	material.albedo_color = colour
	box.material_override = material
	box.gi_mode = GeometryInstance3D.GI_MODE_STATIC
	view.add_child(box)
	return box


func _add_lamp(view: SubViewport) -> void:
	var lamp := DirectionalLight3D.new()
	lamp.light_energy = 0.8
	lamp.shadow_enabled = true
	lamp.rotation_degrees = Vector3(-50.0, 60.0, 0.0)
	view.add_child(lamp)


# Baked from Godot's materials, as a VoxelGI takes any shader for white.
func _add_voxels(view: SubViewport) -> void:
	var voxels := VoxelGI.new()
	voxels.size = Vector3(7.0, 4.0, 7.0)
	voxels.position.y = 1.5
	voxels.subdiv = VoxelGI.SUBDIV_64
	view.add_child(voxels)
	voxels.bake(view)
