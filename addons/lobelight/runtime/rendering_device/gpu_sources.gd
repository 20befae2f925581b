@tool
extends "../pyramid/handed_sources.gd"
## Sources that do not leave the GPU, but for the question whether there are any: Forward+ and
## Mobile. Nothing waits for the answer.

const CanvasPass := preload("../pyramid/canvas_pass.gd")
const HandedSources := preload("../pyramid/handed_sources.gd")
const OwnedTexture := preload("owned_texture.gd")


# What the render thread writes.
class Outcome:
	var asked := 0
	var answered := 0
	var answer := HandedSources.Answer.UNKNOWN

	func take(data: PackedByteArray) -> void:
		answer = HandedSources.find_answer(data)
		answered += 1


var _take: Callable
var _outcome := Outcome.new()


func _init(found: CanvasPass, old: Texture2D = null) -> void:
	texture = old as OwnedTexture if old != null else _make_texture()
	var from := RenderingServer.texture_get_rd_texture(found.get_texture())
	# Of a static function, so that it may run after the object has gone.
	_take = _copy.bind(from, (texture as OwnedTexture).texture_rd_rid, _outcome)


func receive() -> void:
	_outcome.asked += 1
	RenderingServer.call_on_render_thread(_take)


func awaits_answer() -> bool:
	return _outcome.answered < _outcome.asked


func take_answer() -> Answer:
	var answer := _outcome.answer
	_outcome.answer = Answer.UNKNOWN
	return answer


static func _make_texture() -> OwnedTexture:
	var format := RDTextureFormat.new()
	format.format = RenderingDevice.DATA_FORMAT_R16G16B16A16_SFLOAT
	format.width = EXTENT.x
	format.height = EXTENT.y
	format.usage_bits = (
		RenderingDevice.TEXTURE_USAGE_SAMPLING_BIT
		| RenderingDevice.TEXTURE_USAGE_CAN_COPY_TO_BIT
		| RenderingDevice.TEXTURE_USAGE_CAN_COPY_FROM_BIT
	)
	var device := RenderingServer.get_rendering_device()
	return OwnedTexture.new(device.texture_create(format, RDTextureView.new()))


static func _copy(from: RID, to: RID, outcome: Outcome) -> void:
	var device := RenderingServer.get_rendering_device()
	if not to.is_valid() or not device.texture_is_valid(from):
		outcome.answered += 1
		return
	var extent := Vector3(EXTENT.x, EXTENT.y, 1.0)
	var error := device.texture_copy(from, to, Vector3.ZERO, Vector3.ZERO, extent, 0, 0, 0, 0)
	if error == OK:
		error = device.texture_get_data_async(to, 0, outcome.take)
	if error != OK:
		outcome.answered += 1
