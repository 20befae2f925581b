## Equality as gdUnit4 understands it: types must agree, contents are compared.

const _DEEPEST := 32


## True if both have the same type and the same contents.
static func equal(left: Variant, right: Variant, depth: int = 0) -> bool:
	if not _same_type(left, right) or depth > _DEEPEST:
		return false
	if left is Object and right is Object:
		return _equal_objects(left as Object, right as Object, depth)
	if left is Array:
		return _equal_arrays(left as Array, right as Array, depth)
	if left is Dictionary:
		return _equal_dictionaries(left as Dictionary, right as Dictionary, depth)
	return left == right


static func _same_type(left: Variant, right: Variant) -> bool:
	const TEXT: Array[Variant.Type] = [TYPE_STRING, TYPE_STRING_NAME]
	return typeof(left) == typeof(right) or (typeof(left) in TEXT and typeof(right) in TEXT)


static func _equal_objects(left: Object, right: Object, depth: int) -> bool:
	if left == right:
		return true
	if left.get_class() != right.get_class() or left.get_script() != right.get_script():
		return false
	for property: Dictionary in left.get_property_list():
		if not property.usage & (PROPERTY_USAGE_STORAGE | PROPERTY_USAGE_SCRIPT_VARIABLE):
			continue
		var name: String = property.name
		if not equal(left.get(name), right.get(name), depth + 1):
			return false
	return true


static func _equal_arrays(left: Array, right: Array, depth: int) -> bool:
	if left.size() != right.size():
		return false
	for i in left.size():
		if not equal(left[i], right[i], depth + 1):
			return false
	return true


static func _equal_dictionaries(left: Dictionary, right: Dictionary, depth: int) -> bool:
	if left.size() != right.size():
		return false
	for key: Variant in left:
		if not right.has(key) or not equal(left[key], right[key], depth + 1):
			return false
	return true
