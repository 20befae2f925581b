@tool
extends Object
## Mixes tables of [LobeTableSet]s on the GPU, for materials whose widths change time and again.

const MixedTable := preload("mixed_table.gd")
const MixingPage := preload("mixing_page.gd")

# Of the first page of a set; each further one has twice as many, as far as it can.
const _FIRST_PLACES := 4

# By the instance ids of sets' textures: weak references to pages.
static var _pages: Dictionary[int, Array] = {}
# Materials may ask on threads.
static var _mutex := Mutex.new()


## A table of the set; [param before] if it is one, otherwise a new one.
static func take(tables: LobeTableSet, before: MixedTable) -> MixedTable:
	var source := tables.get_widths_texture(false)
	if before != null and before.page.source == source:
		return before
	_mutex.lock()
	var page := _find_page(source.get_instance_id())
	if page == null:
		page = _make_page(tables, source)
	var table := MixedTable.new(page)
	_mutex.unlock()
	return table


static func _find_page(key: int) -> MixingPage:
	for reference: WeakRef in _pages.get(key, []):
		var page: MixingPage = reference.get_ref()
		if page != null and page.has_place():
			return page
	return null


static func _make_page(tables: LobeTableSet, source: MixingPage.WidthsTexture) -> MixingPage:
	for key: int in _pages.keys():
		_pages[key] = _pages[key].filter(_is_alive)
		if _pages[key].is_empty():
			_pages.erase(key)
	var key := source.get_instance_id()
	if not _pages.has(key):
		_pages[key] = []
	var page := MixingPage.new(source, tables, _FIRST_PLACES << _pages[key].size())
	_pages[key].append(weakref(page))
	return page


static func _is_alive(reference: WeakRef) -> bool:
	return reference.get_ref() != null
