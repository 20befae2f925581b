extends GdUnitTestSuite
## The level of a lobe as LobeLight has the shader compute it, against the exact formula.

# Texels along a face, c and b of shaders/environment.gdshaderinc, whether levels blur alike in all
# directions, and how much of a level the shader may be off.
const CASES := [
	[256, 5.0 / 6.0, 0.0, true, 0.003],
	[512, 5.0 / 6.0, 2.5 / 6.0, true, 0.003],
	[128, 1.0 / 12.0, 0.0, false, 0.06],
	[64, 1.0 / 4.0, 0.0, false, 0.06],
]
const COMPONENTS := 41
const VARIANCES := 120
const LEAST_VARIANCE := 1e-8


func test_levels(
	size: int, c: float, b: float, even: bool, allowed: float, _test_parameters := CASES
) -> void:
	var light := LobeLight.new()
	light.size = size
	light.level_variance = c
	light.base_variance = b
	light.is_even = even
	var worst := 0.0
	for i in COMPONENTS:
		var component := lerpf(1.0 / sqrt(3.0), 1.0, i / (COMPONENTS - 1.0))
		for j in VARIANCES:
			var variance := pow(LEAST_VARIANCE, 1.0 - j / (VARIANCES - 1.0))
			var found := _shader_level(light, variance, component)
			worst = maxf(worst, absf(found - _level(light, variance, component)))
	assert_float(worst).is_less(allowed)


# lobelight_level, with LOBELIGHT_STRETCHED_LEVELS, and the sampler's clamp.
func _shader_level(light: LobeLight, variance: float, m: float) -> float:
	var s := light.get_sharpest()
	var k := light.get_level()
	var level := 0.5 * _log2(variance + s.x + s.y * m) + k.x + (k.y + k.z * m) * m
	var f := level - floorf(level)
	return maxf(level - (f - f * f) * (0.3056252 * f + 0.5175971), 0.0)


# V_l = t² (b + a (c (4^l − 1) + 4^l / 6)) for l, which whole levels mix linearly; a = m³ or 1.
func _level(light: LobeLight, variance: float, m: float) -> float:
	var a := 1.0 if light.is_even else m * m * m
	var texels := 0.25 * light.size * light.size * variance
	var ladder := light.level_variance * a
	var four := maxf((texels - light.base_variance + ladder) / (ladder + a / 6.0), 1.0)
	var whole := floorf(0.5 * _log2(four))
	return whole + (four / pow(4.0, whole) - 1.0) / 3.0


func _log2(value: float) -> float:
	return log(value) / log(2.0)
