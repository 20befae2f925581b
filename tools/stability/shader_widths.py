"""Probes of widths that vary from pixel to pixel: which tables of a set are looked up.

A set's uniform is (x, y, z): a width's level is log2(width) x + y, the last one's z.
"""

import math
from functools import partial

import exact_shader as shader
from exact import mpf
from probes import DIVISION, U, Holds, Near, Probe, exp2_error, log2_error, single


def set_levels(narrowest, widest, count):
    scale = (count - 1) / math.log2(widest / narrowest)
    return tuple(single([scale, -scale * math.log2(narrowest), count - 1]))


def width_errors(levels, roughness, anisotropy):
    """(absolute of a level, absolute of log2 alpha): logarithms, and roundings of sums and of products."""
    x, y, _last = levels
    r, q = max(roughness, 1e-4), max(1 - 0.9 * anisotropy, 0.01)
    logarithm = 2 * log2_error(r) + 0.5 * (log2_error(q) + 4 * U / q / math.log(2))
    logarithm += 4 * U * (abs(2 * math.log2(r)) + abs(math.log2(q))) + 4 * U
    size = abs(x) * (abs(2 * math.log2(r)) + abs(math.log2(q))) + abs(y)
    level = abs(x) * logarithm + 3 * U * size
    return level, level / abs(x) + (3 * U * size + DIVISION * size) / abs(x)


def exact_levels(levels, roughness, anisotropy):
    """Of the two widths, clamped to the set, and the widths that they stand for."""
    x, y, last = map(mpf, levels)
    alpha = shader.widths(mpf(roughness), mpf(anisotropy))
    place = [min(max(log2(a) * x + y, mpf(0)), last) for a in alpha]
    return place, [mpf(2) ** ((p - y) / x) for p in place]


def log2(x):
    return mpf(shader.mp.log(x, 2))


def alpha_bound(levels, alpha, error):
    return float(alpha) * (math.log(2) * error + exp2_error(math.log2(float(alpha)))) * 1.01


def expect_isotropic_widths(levels, row):
    place, _alpha = exact_levels(levels, row[0], 0.0)
    level, _logarithm = width_errors(levels, row[0], 0.0)
    return [Near((0,), (place[0],), level, "levels")]


def expect_anisotropic_widths(levels, row):
    place, alpha = exact_levels(levels, row[0], row[1])
    level, logarithm = width_errors(levels, row[0], row[1])
    exchanged = row[1] < 0
    if exchanged:
        place, alpha = place[::-1], alpha[::-1]
    count = int(levels[2]) + 1
    layers = count * (count + 1) / 2
    checks = [Near((n,), (alpha[n],), alpha_bound(levels, alpha[n], logarithm), "width") for n in (0, 1)]
    checks.append(Near((5,), (float(exchanged),), U, "yes or no"))

    def tables(results):
        """(levels apart, the narrower one) of both layers; layers are sorted by the former, then by the latter."""
        found = []
        for n in (2, 3):
            number = results[n] * layers - 0.5
            apart = 0
            while apart < count - 1 and number > count - apart - 0.5:
                number -= count - apart
                apart += 1
            found.append((apart, number))
        return found

    rounding = 4 * U * layers + 2 * level

    def distance(results):
        (first, _), (second, _) = tables(results)
        wrong = 0.0 if second == first + 1 else 1.0
        return wrong + abs(first + results[4] - float(place[0] - place[1])), 4 * level + 4 * U * count, "levels"

    def middles(results):
        off = 0.0
        for apart, narrow in tables(results):
            wanted = float(place[0] + place[1]) / 2 - apart / 2
            wanted = min(max(wanted, 0.0), count - 1 - apart)
            off = max(off, abs(narrow - wanted))
        return off, rounding, "levels"

    return [*checks, Holds(distance), Holds(middles)]


ROUGHNESSES = [0.0, 1e-5, 1e-4, 0.01, 0.05, 0.1, 0.2, 0.3162, 0.35, 0.5, 0.7, 0.7071, 0.9, 1.0, 1.2, 2.0, -1.0]
ANISOTROPIES = [-1e3, -9.0, -2.0, -1.0, -0.5, -1e-6, 0.0, 1e-6, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.09, 1.1, 1.2, 50.0]


def widths_probes(quick):
    for narrowest, widest, count in ((0.01, 1.0, 9),) if quick else ((0.01, 1.0, 9), (1e-4, 2.0, 16), (0.05, 0.4, 2)):
        levels = set_levels(narrowest, widest, count)
        title = f"widths {narrowest:g} to {widest:g} by {count}"
        name = f"widths_{count}"
        uniforms = {"lobelight_widths": levels}
        one = Probe(f"{name}_isotropic", "shader widths", "widths", 1, partial(expect_isotropic_widths, levels))
        one.defines, one.uniforms = ("LOBELIGHT_ISOTROPIC",), uniforms
        one.add(f"{title}, isotropic", [(r, 0, 0, 0) for r in ROUGHNESSES])
        yield one
        two = Probe(f"{name}_anisotropic", "shader widths", "widths", 6, partial(expect_anisotropic_widths, levels))
        two.uniforms = uniforms
        for roughness in ROUGHNESSES:
            two.add(f"{title}, roughness {roughness:g}", [(roughness, a, 0, 0) for a in ANISOTROPIES])
        yield two


probes = widths_probes
