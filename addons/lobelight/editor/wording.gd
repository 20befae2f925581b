@tool
extends Object
## Numbers in sentences.


## "1 node", "2 nodes"; for nouns whose plural is otherwise, [param plural] has it.
static func count(number: int, noun: String, plural := "") -> String:
	if number == 1:
		return "1 " + noun
	return "%d %s" % [number, plural if plural else noun + "s"]
