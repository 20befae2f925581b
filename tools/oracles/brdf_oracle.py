"""Directional albedos by SciPy's adaptive quadrature, written to gdextension/tests/brdf_oracle.h.

The BRDFs are written here a second time, in the half-vector's slopes, and nothing is sampled:
albedo(o) = integral of f(i, o) i_z over the incoming hemisphere. Needs scipy.

    python tools/oracles/brdf_oracle.py
"""

from math import atan, cos, exp, pi, radians, sin, sqrt, tan
from pathlib import Path

from scipy.integrate import dblquad

# name, alpha, elevation of the view from the normal and its azimuth, in degrees
CASES = [
    (name, alpha, view)
    for name in ("ward", "ward_bounded", "ggx")
    for alpha in ((0.1, 0.1), (0.05, 0.2), (0.5, 0.2))
    for view in ((0.0, 0.0), (40.0, 25.0), (75.0, 90.0))
] + [
    ("charlie", (alpha, alpha), view)
    for alpha in (0.1, 0.5)
    for view in ((0.0, 0.0), (40.0, 25.0), (75.0, 90.0))
]


def smith_lambda(v, alpha):
    slope2 = ((alpha[0] * v[0]) ** 2 + (alpha[1] * v[1]) ** 2) / v[2] ** 2
    return 0.5 * (sqrt(1.0 + slope2) - 1.0)


def charlie_lambda(cosine, alpha):
    """Estevez and Kulla 2017, eq. 3 and table 1."""

    def curve(x):
        rows = ((25.3245, 21.5473), (3.32435, 3.82987), (0.16801, 0.19823), (-1.27393, -1.97760), (-4.85967, -4.32054))
        way = (1.0 - alpha) ** 2
        a, b, c, d, e = (way * first + (1.0 - way) * last for first, last in rows)
        return a / (1.0 + b * x**c) + d * x + e

    return exp(curve(cosine)) if cosine < 0.5 else exp(2.0 * curve(0.5) - curve(1.0 - cosine))


def brdf(name, i, o, h, alpha):
    """f(i, o); h is the unit half-vector."""
    if name == "charlie":
        sine = sqrt(max(1.0 - h[2] ** 2, 0.0))
        d = (2.0 + 1.0 / alpha[0]) * sine ** (1.0 / alpha[0]) / (2.0 * pi)
        g = 1.0 / (1.0 + charlie_lambda(min(i[2], 1.0), alpha[0]) + charlie_lambda(min(o[2], 1.0), alpha[0]))
        return d * g / (4.0 * i[2] * o[2])
    area = alpha[0] * alpha[1]
    e = ((h[0] / alpha[0]) ** 2 + (h[1] / alpha[1]) ** 2) / h[2] ** 2
    if name == "ward":
        return exp(-e) / (4.0 * pi * area * sqrt(i[2] * o[2]))
    o_dot_h = sum(a * b for a, b in zip(o, h))
    if name == "ward_bounded":
        return exp(-e) / (4.0 * pi * area * o_dot_h**2 * h[2] ** 4)
    d = 1.0 / (pi * area * h[2] ** 4 * (1.0 + e) ** 2)
    g2 = 1.0 / (1.0 + smith_lambda(i, alpha) + smith_lambda(o, alpha))
    return d * g2 / (4.0 * i[2] * o[2])


def albedo(name, alpha, view):
    elevation, azimuth = map(radians, view)
    o = (sin(elevation) * cos(azimuth), sin(elevation) * sin(azimuth), cos(elevation))

    def integrand(t, phi):
        """Polar coordinates of slope / alpha, the radius as tan t."""
        radius = tan(t)
        slope = (alpha[0] * radius * cos(phi), alpha[1] * radius * sin(phi))
        hz = 1.0 / sqrt(1.0 + slope[0] ** 2 + slope[1] ** 2)
        h = (slope[0] * hz, slope[1] * hz, hz)
        o_dot_h = sum(a * b for a, b in zip(o, h))
        i = tuple(2.0 * o_dot_h * b - a for a, b in zip(o, h))
        if o_dot_h <= 0.0 or i[2] <= 0.0:
            return 0.0
        # di = 4 (o.h) dh, dh = hz^3 d(slope), d(slope) = ax ay r dr dphi, dr = dt / cos^2 t
        jacobian = 4.0 * o_dot_h * hz**3 * alpha[0] * alpha[1] * radius / cos(t) ** 2
        return brdf(name, i, o, h, alpha) * i[2] * jacobian

    # Beyond a radius of 6 the exponential is below 1e-15; GGX needs all of it.
    limit = atan(6.0) if name.startswith("ward") else pi / 2 - 1e-9
    value, _ = dblquad(integrand, 0.0, 2.0 * pi, 0.0, limit, epsabs=1e-7, epsrel=1e-7)
    return value


def main():
    lines = [
        "// Written by tools/oracles/brdf_oracle.py (scipy.integrate.dblquad). Do not edit.",
        "#pragma once",
        "",
        "// clang-format off",
        "namespace lobelight::oracle {",
        "",
        "// Directional albedo; the view's elevation from the normal and its azimuth in degrees.",
        "struct Albedo {",
        "  const char* brdf;",
        "  double alpha_x, alpha_y, elevation, azimuth, albedo;",
        "};",
        "constexpr Albedo kAlbedos[] = {",
    ]
    for name, alpha, view in CASES:
        value = albedo(name, alpha, view)
        print(name, alpha, view, value, flush=True)
        row = ", ".join(str(x) for x in (*alpha, *view))
        lines.append(f'    {{"{name}", {row}, {value:.7f}}},')
    lines += ["};", "", "}  // namespace lobelight::oracle", ""]
    target = Path(__file__).resolve().parents[2] / "gdextension" / "tests" / "brdf_oracle.h"
    target.write_text("\n".join(lines))


if __name__ == "__main__":
    main()
