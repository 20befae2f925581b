"""Probes of the variance of normals within a pixel, and of lamps' roughness and anisotropy with it."""

from itertools import product

from exact import mp, mpf
from probes import DIVISION, SQRT, U, Near, Probe

# Whether widths may be told by roughness and anisotropy at all: both at most 1, the larger first.
ROUGHNESSES = (0.0, 0.02, 0.3, 0.7, 1.0)
ANISOTROPIES = (0.0, 0.5, 1.0, 1.1, -1.0)


def expect_antialiasing(row):
    differences, texels, deviation, scale, roughness, anisotropy, variance, _ = (mpf(x) for x in row[:8])
    share = min(max(texels / 16, mpf(1) / 12), mpf(1) / 2)
    between = min(share * differences, mpf(1) / 4)
    seen = min(max((texels - 1) / 3, mpf(0)), mpf(1))
    within = min((deviation * scale) ** 2 / 2, mpf(1) / 2) * seen
    ratio = max(1 - mpf(9) / 10 * anisotropy, mpf(1) / 100)
    square = roughness**4
    alphas = [min(square / ratio + 2 * variance, mpf(1)), min(square * ratio + 2 * variance, mpf(1))]
    widened = mp.sqrt(mp.sqrt(mp.sqrt(alphas[0] * alphas[1])))
    quotient = alphas[1] / max(alphas[0], mpf(10) ** -9)
    shown = (1 - mp.sqrt(quotient)) / mpf("0.9")
    # The ratio loses digits where 0.9 of the anisotropy is nearly 1.
    off = 8 * U + 2 * U / float(ratio) + DIVISION
    return [
        Near((0,), (between,), DIVISION * float(between) + 1e-12, "radians squared"),
        Near((1,), (within,), (DIVISION + 6 * U) * float(within) + 4 * U * float((deviation * scale) ** 2), "radians squared"),
        Near((2,), (widened,), (off + SQRT) * float(widened) + 1e-9, "roughness"),
        Near((3,), (shown,), 1.2 * (off + SQRT + DIVISION) * max(1.0, float(mp.sqrt(quotient))) + 1e-9, "anisotropy"),
    ]


def probes():
    probe = Probe("antialiasing", "shader antialiasing", "antialiasing", 4, expect_antialiasing)
    pixels = []
    for differences, texels in product((0.0, 1e-6, 0.01, 0.7, 8.0), (0.0, 1.0, 2.5, 100.0, 1e6)):
        for deviation, scale in ((0.0, 1.0), (0.3, 0.5), (1.0, 16.0)):
            pixels.append((differences, texels, deviation, scale))
    surfaces = list(product(ROUGHNESSES, ANISOTROPIES, (0.0, 1e-4, 0.02, 0.75)))
    count = max(len(pixels), len(surfaces))
    rows = [(*pixels[n % len(pixels)], *surfaces[n % len(surfaces)], 0.0) for n in range(count)]
    probe.add("antialiasing", rows)
    return [probe]
