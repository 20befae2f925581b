@tool
extends Object
## Files of the run time that are loaded when they are first needed: exports leave them out where
## nothing in the project reaches what they are for (editor/export/features.gd).

## What they are for.
const SKIES := "light of skies and captures"
const LIVE := "light that is drawn while the game runs"
const FILTERS := "the filters Box and Binomial"
const PLACES := "probes and lights of several worlds"
const ANTIALIASING := "antialiasing of reflections"
const CONVERSION := "conversion between materials"
const RENDERING_DEVICE := "the renderers Forward+ and Mobile"
const MIXING := "widths of anisotropic materials that change"
const LINES := "long widths without tables"
const ENGINE_LIGHT := "diffuse light of the engine"
const OWN_SHADERS := "shaders of one's own"
const SOURCES := "suns and lamps that are taken out of lights"
const COMPATIBILITY := "the renderer Compatibility"

# Kept, as what is preloaded is.
static var _loaded: Dictionary[String, Resource] = {}
# Materials may be made on threads.
static var _mutex := Mutex.new()


## The file; null, and an error, if the export has left it out.
static func fetch(path: String, feature: String) -> Resource:
	var found := find(path)
	if found == null:
		push_error("Lobelight: " + _describe_loss(feature))
	return found


## Why a file is not there, in a sentence or two; empty if it is.
static func find_loss(path: String, feature: String) -> String:
	return "" if find(path) != null else _describe_loss(feature)


## The file, the same for all who ask, on whatever thread; null if the export has left it out.
static func find(path: String) -> Resource:
	_mutex.lock()
	var found: Resource = _loaded.get(path)
	_mutex.unlock()
	# Not under the lock: loading may wait for other threads, and these for the lock. The loader gives
	# all of them the same resource.
	if found == null and ResourceLoader.exists(path):
		found = load(path)
		_mutex.lock()
		_loaded[path] = found
		_mutex.unlock()
	return found


static func _describe_loss(feature: String) -> String:
	return (
		(
			"This export leaves out %s, which no file of the project asks for. Name it in the metadata"
			+ " of a scene's root, lobelight_features = [\"%s\"], or turn the preset's option"
			+ " Lobelight > Cut Tables off."
		)
		% [feature, feature]
	)
