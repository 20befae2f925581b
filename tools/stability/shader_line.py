"""Probes of lobes that need no table: runtime/line/line.gdshaderinc in double precision, written from its comments."""

import math
from functools import partial

from probes import Near, Probe
from shader_points import view_at

COUNT = 16
# Of directions in radians, of variances and weights as shares: a few dozen roundings, of quotients that cancel by a hundred
# at most where the views are not grazing.
DIRECTION, SHARE = 5e-5, 3e-4
# How far GGX reaches, lobes' widths, what gaps add, and how t shrinks; of GGX and of Ward.
GGX = (2.84, 0.63, 0.343, 2.1)
WARD = (None, 0.575, 0.283, 2.0)


def long_axis(o, alpha):
    """Eigenvalues of the slopes' image in the light, the larger first, and the larger one's direction, with the shader's sign."""
    xx = alpha[0] ** 2 * (o[0] ** 2 + o[2] ** 2)
    yy = alpha[1] ** 2 * (o[1] ** 2 + o[2] ** 2)
    xy = alpha[0] * alpha[1] * o[0] * o[1]
    root = math.hypot(0.5 * (xx - yy), xy)
    turn = 0.5 * math.atan2(2 * xy, xx - yy)
    axis = (math.cos(turn), math.sin(turn))
    if xx < yy and axis[1] < 0:
        axis = (-axis[0], -axis[1])
    long = 0.5 * (xx + yy) + root
    return long, (alpha[0] * alpha[1] * o[2]) ** 2 / long, axis


def lobe(brdf, used, o, alpha, number, count=COUNT):
    """(direction, variance, weight) of a lobe of `count`."""
    is_ggx = brdf == "ggx"
    reach, across, gap, shrinking = GGX if is_ggx else WARD
    long, short, axis = long_axis(o, alpha)
    slopes = (axis[0] * alpha[0], axis[1] * alpha[1])
    square = slopes[0] ** 2 + slopes[1] ** 2
    ahead = o[0] * slopes[0] + o[1] * slopes[1]
    root = math.sqrt(ahead**2 + square * o[2] ** 2)
    ends = [(ahead - root) / (square * o[2]), (ahead + root) / (square * o[2])]
    if is_ggx:
        ends = [math.asinh(end) for end in ends]
    else:
        reach = min(max(1.94 * (used * math.sqrt(short / long)) ** 0.17, 1.2), 2.6)
    ends = [max(ends[0], -reach), min(ends[1], reach)]
    step = (ends[1] - ends[0]) / used
    u = 0.5 * (ends[0] + ends[1]) + (number - 0.5 * (count - 1)) * step
    variance = across * short / long
    variance = max(variance, gap * step * math.sqrt(variance))
    scale = math.sqrt(max(1 - shrinking * (variance - step**2 / 12), 0.02))
    t = math.sinh(u) if is_ggx else u
    spread = 1 + t * t if is_ggx else 1
    # Its cell's part between the ends, when they are equally far from the middle.
    inside = min(max(0.5 * (used - count) + min(number, count - 1 - number) + 1, 0), 1)
    share = inside * step / spread if is_ggx else inside * step * math.exp(-t * t) / math.sqrt(math.pi)
    if not is_ggx:
        share /= 1 - 0.45 * math.exp(-(reach**2)) / reach
    t *= scale
    h = (slopes[0] * t, slopes[1] * t, 1.0)
    length = math.hypot(*h)
    cosine = max(sum(a * b for a, b in zip(o, h)) / length, 1e-4)
    i = [2 * cosine * b / length - a for a, b in zip(o, h)]
    height = max(i[2], 0.0)
    if brdf == "ward":
        weight = share * math.sqrt(height / o[2]) * cosine / length**3
    elif brdf == "ward_bounded":
        weight = share * height * length / cosine
    else:
        of_light = math.hypot(alpha[0] * i[0], alpha[1] * i[1], height)
        of_view = math.hypot(alpha[0] * o[0], alpha[1] * o[1], o[2])
        weight = share * height * cosine * length / (of_light * o[2] + of_view * height)
    variance *= 4 * long * spread * (cosine / (length * o[2])) ** 2
    return i, variance, weight


def expect(brdf, used, row):
    i, variance, weight = lobe(brdf, used, row[:3], row[4:6], round(row[6]))
    return [
        Near((0, 1, 2), i, DIRECTION, "radians", scale=1 / math.sqrt(variance)),
        Near((3,), (variance,), SHARE * variance, "variance"),
        Near((4,), (weight,), SHARE * weight + 1e-6, "weight"),
    ]


def probes(quick):
    elevations, azimuths = [0.0, 20.0, 50.0, 75.0], [0.0, 30.0, 90.0, 200.0, 310.0]
    widths = [(0.2, 0.01), (0.02, 0.2), (0.005, 0.002), (0.9, 0.2)]
    if quick:
        elevations, azimuths, widths = elevations[1:], azimuths[1::2], widths[1::2]
    for brdf in ("ggx", "ward", "ward_bounded"):
        for used in (float(COUNT), COUNT - 2.5):
            name = f"line_{brdf}_{used:g}"
            probe = Probe(name, "shader line", "line", 5, partial(expect, brdf, used))
            probe.defines = (f"LOBELIGHT_LOBES {COUNT}", f"LOBELIGHT_LINE {COUNT}", f"LOBELIGHT_LINE_{brdf.upper()}")
            probe.uniforms = {"lobelight_line_count": [used]}
            for alpha in widths:
                rows = [
                    (*view_at(elevation, azimuth), 0.0, *alpha, number, 0.0)
                    for elevation in elevations
                    for azimuth in azimuths
                    for number in range(COUNT)
                ]
                probe.add(f"line {brdf} {used:g} of {alpha[0]:g},{alpha[1]:g}", rows, alpha=list(alpha))
            yield probe
