extends GdUnitTestSuite
## What several loader threads share: each has the same object, and none keeps the others waiting.

const ShaderVariants := preload("res://addons/lobelight/runtime/light/shader_variants.gd")
const TableChoice := preload("res://addons/lobelight/runtime/material/table_choice.gd")
const THREADS := 4
const TABLES := 2000

# How often a thread has come to a table.
var _arrivals := 0
var _mutex := Mutex.new()


# Looks, when a file is loaded, whether others could enter a lock meanwhile.
class Watch:
	extends ResourceFormatLoader
	var loads := 0
	var could_enter := false
	var _path: String
	var _loaded: Resource
	var _watched: Mutex

	func _init(path: String, loaded: Resource, watched: Mutex) -> void:
		_path = path
		_loaded = loaded
		_watched = watched

	func _recognize_path(path: String, _type: StringName) -> bool:
		return path == _path

	func _exists(path: String) -> bool:
		return path == _path

	func _handles_type(_type: StringName) -> bool:
		return true

	func _get_resource_type(_path: String) -> String:
		return "Resource"

	func _load(_path: String, _original: String, _threads: bool, _mode: int) -> Variant:
		loads += 1
		var thread := Thread.new()
		thread.start(_try_to_enter)
		could_enter = thread.wait_to_finish()
		return _loaded

	func _try_to_enter() -> bool:
		if not _watched.try_lock():
			return false
		_watched.unlock()
		return true


# Draws what an include says that nothing else has loaded.
class Included:
	extends LobeMaterial3D
	const PATH := "res://not_loaded_yet.gdshaderinc"

	func _get_fragment_path() -> String:
		return PATH


func test_a_table_has_one_texture_for_all_threads() -> void:
	var tables: Array[LobeTable] = []
	for i in TABLES:
		tables.append(LobeTable.make_single_lobe(0.1 + 1e-4 * i))
	var textures: Array[Array] = []
	var task := func(index: int) -> void: _ask_all(tables, textures[index])
	for i in THREADS:
		textures.append([])
	var threads: Array[Thread] = []
	for i in THREADS:
		threads.append(Thread.new())
		threads[i].start(task.bind(i))
	for thread in threads:
		thread.wait_to_finish()
	var differing := 0
	for i in TABLES:
		for other in range(1, THREADS):
			differing += int(textures[other][i] != textures[0][i])
	assert_int(differing).is_equal(0)


func test_nobody_waits_while_the_ready_set_is_loaded() -> void:
	var loaded := TableChoice.OnDemand._loaded
	var before: Resource = loaded.get(TableChoice.DEFAULT_SET)
	var cached: Resource = null
	if ResourceLoader.has_cached(TableChoice.DEFAULT_SET):
		cached = load(TableChoice.DEFAULT_SET)
		cached.resource_path = ""
	loaded.erase(TableChoice.DEFAULT_SET)
	var watch := Watch.new(TableChoice.DEFAULT_SET, LobeTableSet.new(), TableChoice.OnDemand._mutex)
	ResourceLoader.add_resource_format_loader(watch, true)
	var found := TableChoice.get_set(LobeMaterial3D.new())
	ResourceLoader.remove_resource_format_loader(watch)
	loaded.erase(TableChoice.DEFAULT_SET)
	if before != null:
		loaded[TableChoice.DEFAULT_SET] = before
	if cached != null:
		found.resource_path = ""
		cached.take_over_path(TableChoice.DEFAULT_SET)
	assert_int(watch.loads).is_equal(1)
	assert_bool(watch.could_enter).is_true()


func test_nobody_waits_while_an_include_is_loaded() -> void:
	var include := ShaderInclude.new()
	include.code = "void fragment() {}\n"
	var watch := Watch.new(Included.PATH, include, ShaderVariants._mutex)
	ResourceLoader.add_resource_format_loader(watch, true)
	var material := Included.new()
	await await_idle_frame()
	ResourceLoader.remove_resource_format_loader(watch)
	assert_object(material._shader).is_not_null()
	assert_int(watch.loads).is_equal(1)
	assert_bool(watch.could_enter).is_true()


# All threads at the same time, and one table after the other: the renderer of an engine that runs
# headless cannot make textures on several threads.
func _ask_all(tables: Array[LobeTable], textures: Array) -> void:
	for i in tables.size():
		_mutex.lock()
		_arrivals += 1
		_mutex.unlock()
		while _arrivals < THREADS * (i + 1):
			OS.delay_usec(1)
		textures.append(tables[i].get_texture())
