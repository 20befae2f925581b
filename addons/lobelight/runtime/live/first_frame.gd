@tool
extends Object
## A frame that nobody sees, drawn before the next one: what has been drawn in it can light the
## first frame that is seen.

# The setting for a rendering thread of its own.
const _THREADS := "rendering/driver/threads/thread_model"
const _SEPARATE := 2


## To be called while a frame begins, on [signal RenderingServer.frame_pre_draw]: draws what
## viewports of the rendering server have been asked for, but no viewport of the scene tree, and
## tells nobody. False if that cannot be done.
static func draw() -> bool:
	var tree := Engine.get_main_loop() as SceneTree
	# The editor has windows of its own; another thread draws when it likes.
	if (
		tree == null
		or Engine.is_editor_hint()
		or ProjectSettings.get_setting(_THREADS, 0) == _SEPARATE
	):
		return false
	var viewports: Array[Node] = tree.root.find_children("*", "Viewport", true, false)
	viewports.append(tree.root)
	# The headset asks for its frames itself.
	if viewports.any(func(node: Node) -> bool: return node.get(&"use_xr") == true):
		return false
	var server := RenderingServer
	var modes: Dictionary[RID, RenderingServer.ViewportUpdateMode] = {}
	for viewport: Viewport in viewports:
		var rid := viewport.get_viewport_rid()
		modes[rid] = server.viewport_get_update_mode(rid)
		server.viewport_set_update_mode(rid, RenderingServer.VIEWPORT_UPDATE_DISABLED)
	# Nobody is told: who waits for a frame waits for one that is shown.
	server.set_block_signals(true)
	server.force_draw(false)
	server.set_block_signals(false)
	for rid in modes:
		server.viewport_set_update_mode(rid, modes[rid])
	return true
