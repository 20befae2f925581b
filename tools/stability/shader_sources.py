"""Probes of what surfaces reflect of sources: densities of half-vectors against their means over the source."""

import math

import numpy as np
from probes import U, Near, Probe
from shader_points import view_at

REACH = 1.5957691
# The bell's nodes over log t.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(400)


def half_vector(direction, deviation, o):
    """(cosine above the horizon, h, its two steps by a deviation of the source)."""
    i = np.array(direction)
    reach = REACH * deviation
    within = min(max(i[2] + reach, 0.0), 2 * reach)
    i[2] = within * within / (4 * reach) + max(i[2] - reach, 0.0)
    total = i + o
    cosine = 0.5 * np.linalg.norm(total)
    h = 0.5 * total / cosine
    aside = np.cross(o, i)
    aside /= np.linalg.norm(aside)
    return i[2], h, np.array([0.5 * deviation * np.cross(h, aside), 0.5 * deviation / cosine * aside])


def ggx(h, steps, squares):
    """The mean of 1 / (pi ax ay Q^2), from its integral over t, and how wide the source is for the highlight."""
    inverse = np.array([1 / squares[0], 1 / squares[1], 1.0])
    q, b = h @ (inverse * h), steps @ (inverse * h)
    values, axes = np.linalg.eigh(steps @ (inverse[:, None] * steps.T))
    b = axes.T @ b
    half = 14.0
    t = np.exp(half * NODES - math.log(q) - 2)[:, None]
    r = 1 / (1 + 2 * t * values)
    exponent = t[:, 0] * q - (2 * t * t * b * b * r).sum(axis=1)
    bell = t[:, 0] ** 2 * np.sqrt(r.prod(axis=1)) * np.exp(-exponent)
    return half * (WEIGHTS @ bell) / (math.pi * math.sqrt(squares[0] * squares[1])), max(values)


def flat_top(h, steps, squares):
    """What a source that is as flat as a lamp has more there, of it what the highlight leaves."""
    lengths = np.linalg.norm(steps, axis=1)
    square = float(np.sum((steps[:, 2] / lengths**2) ** 2))
    spread = steps @ np.diag([1 / squares[0], 1 / squares[1], 1.0]) @ steps.T
    narrow = 0.5 * np.trace(np.linalg.inv(spread))
    more = math.exp(-square * square / (4 * math.pi)) / math.pi**2 - math.exp(-0.5 * square) / (2 * math.pi)
    return 0.85 / (1 + 3.3 * narrow) * more / (lengths[0] * lengths[1])


def ward(h, steps, squares):
    m = h[:2] / h[2]
    moved = (steps[:, :2] - np.outer(steps[:, 2], m)) / h[2]
    covariance = np.diag(squares) / 2 + moved.T @ moved
    square = m @ np.linalg.solve(covariance, m)
    return math.exp(-0.5 * square) / (2 * math.pi * math.sqrt(np.linalg.det(covariance))), square


def expect_source(row):
    direction, deviation, o, squares = row[:3], row[3], np.array(row[4:7]), row[8:10]
    z, h, steps = half_vector(direction, deviation, o)
    wanted, wide = ggx(h, steps, squares)
    top = flat_top(h, steps, squares)
    # The formula comes so close: 0.2 % for narrow sources, 10 % where source and highlight are of about the same width, and 30 %
    # where it is much wider, between the source's image and GGX's tail.
    close = 2e-3 + min(wide / 2, 0.1) if wide < 0.3 else 0.3
    of_ward, square = ward(h, steps, squares)
    variance = 0.04 + deviation * deviation
    apart = float(np.sum((o - np.array(direction)) ** 2))
    gaussian = math.exp(-0.5 * apart / variance) / (2 * math.pi * variance * (1 - math.exp(-2 / variance)))
    above = min(max(0.5 + 0.31332853 * direction[2] / deviation, 0.0), 1.0)
    return [
        Near((0,), (z,), 16 * U + 8 * U * deviation, "share"),
        Near((1,), (max(wanted + top, 0.0),), close * wanted + 1e-2 * abs(top), "weight"),
        # Half-vectors are 8 U off, of slopes that are as small as the widths.
        Near((2,), (of_ward,), (1e-4 + 64 * U * square / math.sqrt(min(squares))) * of_ward + 1e-37, "weight"),
        Near((3,), (gaussian,), 1e-5 * (1 + apart / variance) * gaussian, "weight"),
        Near((4,), (above,), 8 * U / deviation, "share"),
    ]


def probes(quick):
    probe = Probe("sources", "shader sources", "sources", 5, expect_source)
    for deviation in (0.003, 0.03) if quick else (0.001, 0.003, 0.01, 0.03, 0.1):
        rows = []
        for widths in ((0.02, 0.02), (0.1, 0.1), (0.6, 0.6), (0.05, 0.3), (0.3, 0.03)):
            for elevation in (5.0, 45.0, 80.0):
                o = view_at(elevation, 20.0)
                for beside in (0.0, 2.0, 10.0, 40.0):
                    direction = view_at(elevation + beside - 1.0, 200.0 + 2 * beside)
                    rows.append((*direction, deviation, *o, 0, widths[0] ** 2, widths[1] ** 2, 0, 0))
        probe.add(f"sources, {math.degrees(deviation):.2f} degrees", rows)
    yield probe
