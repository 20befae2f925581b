@tool
extends MeshInstance3D
## One of the demo's objects: a shape, and the recipe of the table that its material uses.

enum Shape { SPHERE, TORUS, DISC, KNOT, TEAPOT, PLINTH }

const LoopSubdivision := preload("meshes/loop_subdivision.gd")
const SurfaceMesh := preload("meshes/surface_mesh.gd")
const Surfaces := preload("meshes/surfaces.gd")
const TEAPOT := preload("meshes/teapot.obj")

## What to build.
@export var shape := Shape.SPHERE:
	set(value):
		shape = value
		mesh = _build()
## The name of a file in [code]demo/recipes[/code], without the ending.
@export var recipe := ""


func _init() -> void:
	mesh = _build()


func _build() -> ArrayMesh:
	match shape:
		Shape.TORUS:
			return SurfaceMesh.build(Surfaces.torus.bind(0.42, 0.17), 128, 64)
		Shape.DISC:
			return SurfaceMesh.build(Surfaces.plate.bind(0.8, 0.06, 0.06), 160, 80)
		Shape.KNOT:
			return SurfaceMesh.build(Surfaces.knot.bind(0.2, 0.105), 384, 40)
		Shape.PLINTH:
			return SurfaceMesh.build(Surfaces.plate.bind(2.5, 0.2, 0.0), 160, 60)
		Shape.TEAPOT:
			return _build_teapot()
	return SurfaceMesh.build(Surfaces.sphere.bind(0.5), 96, 48)


static func _build_teapot() -> ArrayMesh:
	var arrays := TEAPOT.surface_get_arrays(0)
	var subdivision := LoopSubdivision.new(arrays[Mesh.ARRAY_VERTEX], arrays[Mesh.ARRAY_INDEX])
	subdivision.refine()
	subdivision.refine()
	return subdivision.to_mesh()
