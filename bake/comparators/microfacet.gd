extends RefCounted
## The BRDFs that the methods without a table know in closed form; see microfacet.gdshaderinc.

const BRDFS: PackedStringArray = ["ward", "ward_bounded", "ggx"]
# Of the mean over the slopes.
const _SLOPES := 4096


## One sentence where a method of that name cannot draw the BRDF, otherwise empty.
static func find_problem(method: String, brdf: String) -> String:
	if brdf in BRDFS:
		return ""
	return "method %s draws %s, not %s." % [method, ", ".join(BRDFS), brdf]


## What a method's shader needs to be defined for its BRDF.
static func get_defines(brdf: String, alpha: PackedFloat64Array) -> PackedStringArray:
	var defines: PackedStringArray = ["MICROFACET_" + brdf.to_upper()]
	if alpha[0] == alpha[1]:
		defines.append("MICROFACET_ISOTROPIC")
	return defines


## S of microfacet.gdshaderinc for a view along the normal and a unit half-vector.
static func share_at_normal(brdf: String, alpha: PackedFloat64Array, h: Vector3) -> float:
	var i := 2.0 * h.z * h - Vector3.BACK
	if i.z <= 0.0:
		return 0.0
	match brdf:
		"ward":
			return h.z * sqrt(i.z)
		"ward_bounded":
			return i.z / pow(h.z, 5.0)
		_:
			var stretch := Vector3(alpha[0] * i.x, alpha[1] * i.y, i.z).length()
			return 2.0 * i.z * h.z / (stretch + i.z)


## The integral of the density D of the normals over half-vectors. Slopes have the density
## D h_z⁴ (GGX) or D (Ward, whose D leaves the rest out) and dh = h_z³ ds, so it is the mean of
## 1 / h_z or of h_z³ over the slopes.
static func normals_integral(brdf: String, alpha: PackedFloat64Array) -> float:
	var sum := 0.0
	for index in _SLOPES:
		# A spiral (the golden angle) whose turns lie dense far out, where GGX's slopes go on: the
		# share of the slopes beyond a point is v², which weighs it by 2 v dv.
		var v := (index + 0.5) / _SLOPES
		var radius := sqrt(1.0 / (v * v) - 1.0) if brdf == "ggx" else sqrt(-2.0 * log(v))
		var turn := Vector2.from_angle(2.399963 * index)
		var slope := radius * Vector2(alpha[0] * turn.x, alpha[1] * turn.y)
		var h_z := 1.0 / sqrt(1.0 + slope.length_squared())
		sum += 2.0 * v * (1.0 / h_z if brdf == "ggx" else pow(h_z, 3.0))
	return sum / _SLOPES
