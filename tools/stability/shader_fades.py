"""Probes of opacities that depend on the place, and of what lamps show besides."""

from exact import mpf
from probes import DIVISION, Near, Probe, U

LIMITS = (2.5, 7.0)
RIM, SCATTERED = (0.7, 0.2), 0.35


def distance_fade(distance):
    """Hermite's step from the one limit to the other."""
    t = (mpf(distance) - mpf(LIMITS[0])) / (mpf(LIMITS[1]) - mpf(LIMITS[0]))
    t = min(max(t, mpf(0)), mpf(1))
    return t * t * (3 - 2 * t)


def expect_fades(row):
    distance, opacity = row[:2]
    return [
        Near((0,), (distance_fade(distance),), 12 * DIVISION, "fade"),
        # At the first pixel the noise is 0.
        Near((1,), (1.0 if opacity < 0.001 else 0.0,), 0.0, "left out"),
        Near((2, 3), RIM, U, "rim"),
        Near((4,), (SCATTERED,), U, "scattering"),
    ]


def probes():
    probe = Probe("fades", "shader fades", "fades", 5, expect_fades)
    probe.uniforms = {
        "lobelight_fade_limits": LIMITS,
        "lobelight_rim_amount": RIM,
        "lobelight_scattering": [SCATTERED],
    }
    for n in range(33):
        probe.add(f"fades {n}", [(9 * n / 32, 0.01 * n / 32, 0.0, 0.0)])
    return [probe]
