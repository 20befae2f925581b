class_name CompareMethods
extends RefCounted
## The methods that `./dev compare` knows by name.

## Named in the contract, built later.
const PLANNED: PackedStringArray = [
	"toral8",
	"toral16",
	"fis8",
	"fis16",
	"fis40",
	"fis40g",
	"allfreq1",
	"allfreq8",
	"asg",
	"majoraxis8",
	"closed8",
	"stock",
]
const REFERENCE := "reference"


## One sentence where a name cannot be drawn, otherwise empty.
static func error(method: String) -> String:
	if method in PLANNED:
		return "method %s: not available yet." % method
	if method != REFERENCE and lobes(method) == 0:
		return (
			"method %s is unknown; the methods are gmm<lobes> (gmm4, gmm8, gmm16 …) and reference."
			% method
		)
	return ""


## The number of lobes of a gmm method, 0 for any other name.
static func lobes(method: String) -> int:
	var count := method.trim_prefix("gmm")
	return count.to_int() if method.begins_with("gmm") and count.is_valid_int() else 0


## What one pixel costs: one environment fetch and one table fetch a lobe; the fetches are
## isotropic, so the sampler probes once for each.
static func cost(method: String) -> Dictionary:
	var count := lobes(method)
	return {"fetches": count, "probes": count, "table_fetches": count}
