@tool
@abstract
extends RefCounted
## The light of the world around a node: what environment_source.gd asks of world_views.gd, which
## exports leave out where light comes from panoramas only.

## What is drawn of the world: nothing, if its sky is a panorama; the sky; or the scene.
enum Views { NONE, SKY, SCENE }

const FaceViews := preload("../pyramid/face_views.gd")
const ViewPlace := preload("view_place.gd")
const OnDemand := preload("../on_demand.gd")
const _PATH := "res://addons/lobelight/runtime/skies/world_views.gd"


## The light of a node's world; null, and an error, if the export has left it out.
static func of(node: Node3D) -> RefCounted:
	var script := OnDemand.fetch(_PATH, OnDemand.SKIES) as GDScript
	return script.new(node) if script != null else null


## Why there is no such light in this export; empty if there is.
static func find_loss() -> String:
	return OnDemand.find_loss(_PATH, OnDemand.SKIES)


## The panorama, if it is all that there is to the sky; otherwise null.
@abstract func find_panorama() -> Texture2D

## What that panorama's light is multiplied by.
@abstract func find_panorama_energy() -> float

## Whether there is no sky, so that light comes evenly from all sides.
@abstract func is_even() -> bool

## That light, linear.
@abstract func find_even_light() -> Color

## Why that light is missing or black, and what to do, in a sentence; empty if there is light.
@abstract func find_shortage() -> String

## From the sky to the world.
@abstract func find_sky_rotation() -> Basis

## Looks at what is to be drawn; whether it shows something else than at the last look.
@abstract func look(views: Views) -> bool

## Views of what was looked at, of [param samples] times [param face_size] pixels a side.
@abstract func make_views(samples: int, face_size: int) -> FaceViews

## Has views show what was looked at last: a scene from some place, or the sky from the camera's.
## They may have been made for another node of the same world.
@abstract func place(views: FaceViews, place: ViewPlace) -> void
