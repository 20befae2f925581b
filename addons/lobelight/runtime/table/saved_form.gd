@tool
extends RefCounted
## What the file of a [LobeTable] or a [LobeTableSet] says of itself: its format, and the checksum
## of what it holds. Files of format 1 have neither.

## The newest format that can be read, and the one that is written.
const NEWEST := 2
# Checking this many bytes takes well under a millisecond. Games do not check larger images, so that
# their first frame does not wait for it.
const _QUICKLY_CHECKED := 1 << 17

## Whether images of any size are checked.
static var checks_all := Engine.is_editor_hint()

## The format that the table is written in: the newest, or that of its file if this is newer still,
## so that it stays refused.
var format := NEWEST:
	set(value):
		format = maxi(value, NEWEST)
## A checksum that what has been loaded does not have, or not yet; 0 if nothing is wrong.
var expected := 0


## The checksum of numbers and texels, of which the first 8 bytes of the MD5 are taken; 0 if there
## are no texels.
static func find_checksum(numbers: Array, image: Image) -> int:
	if image == null or image.is_empty():
		return 0
	var hashing := HashingContext.new()
	hashing.start(HashingContext.HASH_MD5)
	hashing.update(var_to_bytes(numbers))
	hashing.update(image.get_data())
	return hashing.finish().decode_s64(0)


## Looks whether what has been loaded has the checksum by now; [param find] gives that. Properties
## are loaded one after another in any order, and it fits when the last one is there. What is
## changed later is not compared any more.
func settle(find: Callable, image: Image) -> void:
	if expected == 0 or format > NEWEST:
		return
	var is_long := image != null and image.get_data_size() > _QUICKLY_CHECKED
	if (is_long and not checks_all) or find.call() == expected:
		expected = 0


## Why a file cannot be used, in a sentence; empty if it can. [param what] is "table" or "set".
func get_problem(what: String) -> String:
	if format > NEWEST:
		return (
			(
				"The %s is in format %d, and this version of Lobelight reads up to %d: "
				+ "update the addon, or bake the %s again."
			)
			% [what, format, NEWEST, what]
		)
	if expected != 0:
		return (
			"The %s is not as it was saved, its checksum differs: bake the %s again." % [what, what]
		)
	return ""
