extends Object
## The ways in which the demo lights its objects.

enum Method { OURS, THESIS, SAMPLES, STOCK }
## No second method.
const NONE := -1

const TITLES: PackedStringArray = ["Lobelight", "Thesis 2015", "Importance sampling", "Godot"]


## Whether a method shows the light of rooms; the others have one map for everything.
static func has_rooms(method: int) -> bool:
	return method not in [Method.THESIS, Method.SAMPLES]


## What a number of lobes draws; with the ready sets', materials take more for long widths.
static func describe_lobes(lobes: int) -> String:
	return "8 to 40 lobes" if lobes == 8 else "%d lobes" % lobes


## A method's name for people; [param lobes] are those of this project's.
static func title_of(method: int, lobes: int) -> String:
	match method:
		Method.OURS:
			return "%s, %s" % [TITLES[method], describe_lobes(lobes)]
		Method.THESIS:
			return "%s, 8 lobes" % TITLES[method]
		Method.SAMPLES:
			return "%s, 40 samples" % TITLES[method]
	return "Godot's own material"
