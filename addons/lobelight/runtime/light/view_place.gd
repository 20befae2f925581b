@tool
extends RefCounted
## Where a scene is captured from, and what of it.

## In the world, in metres.
var origin := Vector3.ZERO
## From the axes of the cube map to the world; orthonormal.
var basis := Basis.IDENTITY
## Along the axes, in metres: what is nearer or farther is not captured.
var near := 0.05
var far := 1000.0
var cull_mask := 0xFFFFF
## Whether rooms whose light has not been captured yet are dark, rather than lit by the environment.
var is_probe := false
## Whether there is a background: the sky, or a colour. Without, it is black.
var sees_background := true
