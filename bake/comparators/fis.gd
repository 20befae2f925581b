extends ComparisonMethod
## `fis<N>`: filtered importance sampling, Colbert and Křivánek 2007, "GPU-Based Importance
## Sampling", GPU Gems 3, chapter 20, with what has made it better since; see fis.gdshaderinc. On
## 2 × 2 means as published, `fis<N>g` on the project's own pyramid.
##
## [member ComparisonStage.fis_form] chooses: "best" has kernels of the density's integral for
## Ward's slopes (Tokuyoshi 2016: up to 1.8 dB more with 8 and 16 samples, up to 0.8 with 40) and
## the bounded cap for GGX (Tokuyoshi and Eto 2024: up to 0.7 dB more with 40). "published" is
## the chapter of 2007 with all of GGX's visible normals. "integral" has those kernels for GGX
## too, where they are worse more often than better (by 1.1 to -0.5 dB): in its long tails they
## leave light out.

const ComparisonSphere := preload("comparison_sphere.gd")
const Microfacet := preload("microfacet.gd")
# Of the kernels' search, and of the sum that it judges by.
const _BISECTIONS := 50
const _TERMS := 64

var samples: int
## Whether on the project's own pyramid.
var on_own_pyramid := false

var _form := ""
var _light: LobeLight
var _filter := ""
# Added to the level.
var _bias := 0.0


static func make(count: int, own_pyramid: bool) -> ComparisonMethod:
	var method := new()
	method.samples = count
	method.on_own_pyramid = own_pyramid
	return method


func prepare(stage: ComparisonStage) -> String:
	var problem := Microfacet.find_problem(name, brdf)
	if not problem.is_empty():
		return problem
	_form = stage.fis_form
	_filter = stage.filter if on_own_pyramid else "box"
	_light = await stage.light(_filter)
	if _light == null:
		return "the renderer did not draw the pyramid."
	_bias = stage.fis_bias + matching_bias(_light.level_variance)
	return ""


func make_sphere() -> MeshInstance3D:
	return make_part(0, samples)


## The mean over [param count] of the samples, from the one with the index [param first]. Parts make
## up pictures of more samples than one shader can have: see [method constants].
func make_part(first: int, count: int) -> MeshInstance3D:
	var defines := Microfacet.get_defines(brdf, alpha)
	defines.append("FIS_SAMPLES %d" % count)
	defines.append("FIS_SAMPLES_OF_ALL %d" % samples)
	if _form != "published":
		defines.append("FIS_BOUNDED")
	if _form == "integral":
		defines.append("FIS_KERNEL_OF_INTEGRAL")
	if _light.is_even:
		defines.append("FIS_ROUND_LEVELS")
	return (
		ComparisonSphere
		. make(
			"fis.gdshaderinc",
			"fis_specular",
			defines,
			{
				&"lobelight_environment": _light.cubemap,
				&"fis_samples": constants(first, count),
				&"fis_alpha": _widths(),
				&"fis_level_scale": TAU * alpha[0] * alpha[1] * _level_scale(),
			},
			null,
			room
		)
	)


## The shader parameter fis_samples of a part.
func constants(first: int, count: int) -> PackedVector4Array:
	var values := PackedVector4Array()
	for k in range(first, first + count):
		values.append(_ggx_constants(k) if brdf == "ggx" else _ward_constants(k))
	return values


## One environment fetch a sample; their directions come from uniforms.
func cost() -> Dictionary:
	return {"fetches": samples, "probes": samples, "table_fetches": 0}


func settings() -> Dictionary:
	return {
		"pyramid": _filter,
		"face_size": _light.size,
		"level_bias": _bias,
		"form": _form,
	}


## Of a pyramid whose levels blur by [param level_variance], see [LobeLight]: what makes the
## published rule, which is for 2 × 2 means, blur as much as it does on those. Level l blurs by
## (c + 1/6) 4^l of a texel's solid angle, 1/6 being the sampler's share.
static func matching_bias(level_variance: float) -> float:
	var box: float = ComparisonStage.Pyramid.LEVEL_VARIANCES[ComparisonStage.FILTERS["box"]]
	return -0.5 * log((level_variance + 1.0 / 6.0) / (box + 1.0 / 6.0)) / log(2.0)


## Point [param index] of [param count] of Hammersley's set, in the middle of its cell: the bits of
## the index after the binary point, in reverse, and the fraction of the index. Taken in this order
## for (radius, angle), 40 samples come about 1 dB closer than in the other; powers of two give the
## same set in both.
static func hammersley(index: int, count: int) -> Vector2:
	var reversed := 0.0
	var digit := 0.5
	var bits := index
	while bits > 0:
		reversed += digit * (bits & 1)
		digit *= 0.5
		bits >>= 1
	return Vector2(reversed + 0.5 / count, (index + 0.5) / count)


## The square of the radius of the disc over which the integral of e^-|t|² / π, the density of
## Ward's slopes over alpha, is [param share]; |t|² of the disc's middle is [param square].
static func kernel_square(square: float, share: float) -> float:
	var low := 0.0
	var high := 1.0
	while disc_integral(square, high) < share:
		high *= 2.0
	for step in _BISECTIONS:
		var middle := 0.5 * (low + high)
		if disc_integral(square, middle) < share:
			low = middle
		else:
			high = middle
	return 0.5 * (low + high)


## That integral, over a disc of the squared radius [param radius_square]: twice |t|² has a
## noncentral χ² distribution, a Poisson mixture of central ones.
static func disc_integral(square: float, radius_square: float) -> float:
	var share := exp(-square)
	var left := exp(-radius_square)
	var within := 1.0 - left
	var sum := 0.0
	for k in _TERMS:
		sum += share * within
		share *= square / (k + 1)
		left *= radius_square / (k + 1)
		within -= left
	return sum


func _widths() -> Vector2:
	return Vector2(alpha[0], alpha[1])


# 4^_bias / N over omega_p in the middle of a face.
func _level_scale() -> float:
	return pow(4.0, _bias) / samples * 0.25 * _light.size * _light.size


func _ward_constants(index: int) -> Vector4:
	var u := hammersley(index, samples)
	var slope := sqrt(-log(1.0 - u.x)) * Vector2.from_angle(TAU * u.y) * _widths()
	var h := Vector3(slope.x, slope.y, 1.0).normalized()
	# e^(slope / alpha)² = 1 / (1 - u).
	var kernel := PI / (1.0 - u.x) / samples
	if _form != "published":
		kernel = PI * kernel_square(-log(1.0 - u.x), 1.0 / samples)
	var solid_angle := 4.0 * alpha[0] * alpha[1] * pow(h.z, 3.0) * kernel * samples
	return Vector4(h.x, h.y, h.z, 0.5 * log(solid_angle * _level_scale()) / log(2.0))


func _ggx_constants(index: int) -> Vector4:
	var u := hammersley(index, samples)
	return Vector4(cos(TAU * u.y), sin(TAU * u.y), 1.0 - u.x, 0.0)
