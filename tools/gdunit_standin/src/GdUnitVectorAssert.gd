class_name GdUnitVectorAssert
extends GdUnitAssert
## Assertions on a vector. Approximate equality is per component, the ends included.

## Vector types and their numbers of components.
const SIZES: Dictionary[int, int] = {
	TYPE_VECTOR2: 2,
	TYPE_VECTOR2I: 2,
	TYPE_VECTOR3: 3,
	TYPE_VECTOR3I: 3,
	TYPE_VECTOR4: 4,
	TYPE_VECTOR4I: 4,
}


func _init(record: Record, current: Variant) -> void:
	super(record, current)
	_require_type(SIZES.keys())


## Each component within that of [param approx] of that of [param expected].
func is_equal_approx(expected: Variant, approx: Variant) -> GdUnitVectorAssert:
	return _check(_is_near(expected, approx), "expected %s ± %s" % [expected, approx])


func _is_near(expected: Variant, approx: Variant) -> bool:
	if typeof(expected) != typeof(_current) or typeof(approx) != typeof(_current):
		return false
	if not SIZES.has(typeof(_current)):
		return false
	for axis in SIZES[typeof(_current)]:
		# Written so that NaN fails.
		if not absf(_current[axis] - expected[axis]) <= approx[axis]:
			return false
	return true
