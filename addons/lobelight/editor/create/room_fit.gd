@tool
extends Object
## Fits the box of a [LobeProbe3D] to the walls that are selected.


## A probe around what is visible of some nodes and below them, to be added to a scene's root;
## [code]null[/code] if nothing is. Around a single node it is turned as that is.
static func make_probe(nodes: Array[Node], root: Node) -> LobeProbe3D:
	var turn := Basis.IDENTITY
	if nodes.size() == 1 and nodes[0] is Node3D:
		turn = (nodes[0] as Node3D).global_basis.orthonormalized()
	var box := _find_box(nodes, Transform3D(turn, Vector3.ZERO))
	if box.get_longest_axis_size() == 0.0:
		return null
	var probe := LobeProbe3D.new()
	probe.name = "LobeProbe3D"
	probe.size = box.size
	var place := Transform3D(turn, turn * box.get_center())
	if root is Node3D:
		place = (root as Node3D).global_transform.affine_inverse() * place
	probe.transform = place.orthonormalized()
	return probe


## Whether there is anything to be fitted to.
static func has_walls(nodes: Array[Node]) -> bool:
	return _find_box(nodes, Transform3D.IDENTITY).get_longest_axis_size() > 0.0


# Of all meshes, in some axes; empty if there are none.
static func _find_box(nodes: Array[Node], frame: Transform3D) -> AABB:
	var box := AABB()
	var is_empty := true
	for node in nodes:
		for part: Node in [node] + node.find_children("*", "GeometryInstance3D", true, false):
			if not _is_wall(part):
				continue
			var shape := part as GeometryInstance3D
			var place := frame.affine_inverse() * shape.global_transform
			var part_box := place * shape.get_aabb()
			box = part_box if is_empty else box.merge(part_box)
			is_empty = false
	return box


# Particles have boxes that are mostly empty.
static func _is_wall(node: Node) -> bool:
	if not node is GeometryInstance3D or node is GPUParticles3D or node is CPUParticles3D:
		return false
	return (node as GeometryInstance3D).is_visible_in_tree()
