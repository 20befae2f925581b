@tool
extends Object
## Shaders by their code: materials whose code is the same share one.

# Shaders in use.
static var _variants: Dictionary[String, WeakRef] = {}
static var _mutex := Mutex.new()


## The shader of this code, which the caller keeps.
static func fetch(code: String) -> Shader:
	var shader := _find(code)
	if shader != null:
		return shader
	# Not under the lock: includes may have to be loaded, and loading may wait for threads that wait
	# for the lock.
	var made := Shader.new()
	made.code = code
	_mutex.lock()
	shader = _find(code)
	if shader == null:
		for other: String in _variants.keys():
			if _variants[other].get_ref() == null:
				_variants.erase(other)
		shader = made
		_variants[code] = weakref(shader)
	_mutex.unlock()
	return shader


static func _find(code: String) -> Shader:
	_mutex.lock()
	var shader: Shader
	if _variants.has(code):
		shader = _variants[code].get_ref()
	_mutex.unlock()
	return shader
