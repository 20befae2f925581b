extends Object
## What bake/comparators/fis.gdshaderinc takes for 40 samples of GGX.

const RivalLight := preload("rival_light.gd")
const COUNT := 40

static var _constants := PackedVector4Array()


## (cos φ, sin φ, 1 − u) of Hammersley's points, the bits of the index in reverse giving u.
static func constants() -> PackedVector4Array:
	if _constants.is_empty():
		for index in COUNT:
			var u := _reversed(index) + 0.5 / COUNT
			var turn := Vector2.from_angle(TAU * (index + 0.5) / COUNT)
			_constants.append(Vector4(turn.x, turn.y, 1.0 - u, 0.0))
	return _constants


## (2π αx αy / N / (4 / S²)) 4^bias, the bias being what [method RivalLight.box_share] stands for.
static func level_scale(widths: Vector2, light: RivalLight) -> float:
	return TAU * widths.x * widths.y * light.box_share() / COUNT * 0.25 * light.size * light.size


static func _reversed(index: int) -> float:
	var value := 0.0
	var digit := 0.5
	while index > 0:
		value += digit * (index & 1)
		digit *= 0.5
		index >>= 1
	return value
