"""Probes without textures: levels of the pyramid, decoding of texels, places in tables."""

import math
from functools import partial

import numpy as np

import exact_shader as shader
from exact import clamp_view, mpf, norm, normalised, vector
from probes import DIVISION, INVERSE_SQRT, SQRT, U, Holds, Near, Probe, exp2_error, log2_error, single

IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def view_at(elevation, azimuth):
    """Degrees; a unit vector, exactly in the planes of symmetry where the angles say so."""
    t, p = math.radians(elevation), math.radians(azimuth)
    sine, cosine = math.sin(t), 0.0 if elevation == 90 else math.cos(t)
    across = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}.get(azimuth, (math.cos(p), math.sin(p)))
    return (sine * across[0], sine * across[1], cosine)


def turn(seed):
    """Columns of a rotation."""
    q = np.random.default_rng(seed).normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return [
        (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
        (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
        (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)),
    ]


# Levels: c by filter, and whether levels blur alike everywhere.
FILTERS = {"box": (1 / 12, False), "binomial": (1 / 4, False), "gaussian": (5 / 6, True), "disc": (5 / 6, True)}
# By the comments of environment.gdshaderinc: the cubic between two levels, the parabola for stretched levels.
CUBIC = 0.0013
STRETCHED = 0.06


def light(size, name, base, cube, rotation=IDENTITY, energy=1.0):
    """As stability.gd takes it; `base` is the share of the filter's variance that level 0 is blurred by."""
    c, even = FILTERS[name]
    return {
        "size": size,
        "level_variance": c,
        "base_variance": base * c,
        "is_even": even,
        "cube": cube,
        "rotation": [x for column in rotation for x in column],
        "energy": energy,
    }


def level_bound(variance, values):
    """Of the level: the sum and s to 2U of V + s, half the logarithm, k and the last sums to U of their size."""
    texel = 4.0 / values["size"] ** 2
    total = variance + texel * (values["level_variance"] - values["base_variance"])
    size = abs(math.log2(max(total, 1e-30))) + abs(math.log2(texel)) + 4
    stretched = 0.0 if values["is_even"] else STRETCHED
    return CUBIC + stretched + 0.5 * log2_error(max(total, 1e-30)) + 2 * U / math.log(2) + 4 * U * size


def exact_level(variance, d, values):
    texel = mpf(4) / mpf(values["size"]) ** 2
    component = max(abs(mpf(x)) for x in d) / norm(vector(d))
    return shader.level(
        mpf(variance), component, texel, mpf(values["base_variance"]), mpf(values["level_variance"]), values["is_even"]
    )


def expect_level(values, row):
    wanted, bound = float(exact_level(row[3], row[:3], values)), level_bound(row[3], values)
    # The sampler clamps at 0: what is below need only be so.
    return [Holds(lambda results: (abs(max(results[0], 0.0) - max(wanted, 0.0)), bound, "levels"))]


def level_probes(quick):
    for name, (_c, even) in FILTERS.items():
        for base in (0.0, 0.5) if even else (0.0,):
            for size in (16, 512) if quick else (4, 16, 64, 128, 512, 2048):
                values = light(size, name, base, "levels")
                title = f"level {name} size {size}" + (" base blurred" if base else "")
                probe = Probe(
                    title.replace(" ", "_"), "shader level", "level", 1, partial(expect_level, values), light=values
                )
                probe.defines = () if even else ("LOBELIGHT_STRETCHED_LEVELS",)
                directions = [(0, 0, 1), (0.6, 0, -0.8), (0.5773503, 0.5773503, 0.5773503), (-0.1, -0.7, 0.7071)]
                powers = range(-40, 41, 4 if quick else 1)
                rows = [(*normalised(vector(d)), 10.0 ** (p / 4)) for p in powers for d in directions]
                probe.add(title, rows)
                yield probe


# Decoding


def lobe_bounds(x, y, half_vectors, o):
    """(mean in radians, cosine), absolute. r: the roundings of each component of the half-vector before it is unit: three, and
    three of what stands in for alpha."""
    parts = [abs(n) + abs(x * t) + abs(y * b) for t, b, n in zip(*half_vectors)]
    whole = [n + x * t + y * b for t, b, n in zip(*half_vectors)]
    r = 6 * U * math.hypot(*parts) / math.hypot(*whole)
    length = math.hypot(*o)
    # 1 / length: half of the dot product's 2 r + 3U, and its own; o.h, in tangent space: r, 3U for the view's components in
    # it, 3U for the sum and U for the product, where parts may cancel.
    inverse = r + 2 * U + INVERSE_SQRT
    cosine = length * (r + 12 * U) + inverse
    return 2 * (cosine + inverse + r + 4 * U) + U, cosine


def expect_decode(row):
    texel, o = row[:4], row[16:19]
    half_vectors = scaled_columns((row[4:7], row[8:11], row[12:15]), (row[7], row[11]), (1, row[15]))
    mean, variance, cosine = shader.lobe(texel, tuple(map(vector, half_vectors)), vector(o))
    mean_bound, cosine_bound = lobe_bounds(texel[0], texel[1], half_vectors, o)
    relative = cosine_bound / float(cosine) + exp2_error(texel[2]) + 2 * U
    grazing = shader.schlick(cosine)
    grazing_bound = float(shader.schlick(float(cosine) - cosine_bound)) - float(grazing) + 10 * U * float(grazing)
    return [
        Near((0, 1, 2), mean, mean_bound, "radians", scale=1 / math.sqrt(float(variance))),
        Near((3,), (variance,), float(variance) * relative, "variance"),
        Near((4,), (texel[3] * grazing,), texel[3] * grazing_bound + U, "weight"),
        Near((5,), (texel[3],), U, "weight"),
    ]


def scaled_columns(frame, alpha, side):
    return [
        tuple(x * alpha[0] * side[0] for x in frame[0]),
        tuple(x * alpha[1] * side[1] for x in frame[1]),
        frame[2],
    ]


def decode_probe(quick):
    probe = Probe("decode", "shader decode", "decode", 6, expect_decode)
    widths, elevations = [1e-4, 0.01, 0.2, 2.0], [0.0, 60.0, 89.4, 89.99]
    if not quick:
        widths = [1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 2.0]
        elevations = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 88.0, 89.0, 89.4, 89.99, 90.0, 100.0, 180.0]
    slopes_x, slopes_y = [-4, -1, -0.25, 0, 0.5, 2, 4], [-4, -0.5, 0, 1, 4]
    logarithms = [-10.0, 0.0, 8.0, 16.0, 27.0]
    if quick:
        slopes_x, slopes_y, logarithms = [-4, -0.25, 0, 2], [-0.5, 0, 4], [-10.0, 8.0, 27.0]
    seed = 0
    for width in widths:
        for ratio in (1.0, 1000.0):
            if ratio > 1 and width < 0.1:
                continue
            alpha = (width, max(width / ratio, 1e-4))
            for elevation in elevations:
                azimuth = 30.0 if ratio > 1 else 0.0
                seed += 1
                frame = IDENTITY if seed % 2 else turn(seed)
                o = [float(x) for x in clamp_view(vector(view_at(elevation, azimuth)))]
                o = [sum(frame[n][axis] * o[n] for n in range(3)) for axis in range(3)]
                padded = [x for column, w in zip(frame, (*alpha, 1 if seed % 3 else -1)) for x in (*column, w)]
                rows = [
                    (x, y, z, 0.125, *padded, *o, 0.0) for x in slopes_x for y in slopes_y for z in logarithms
                ]
                title = f"decode {alpha[0]:g},{alpha[1]:g} view {elevation:g},{azimuth:g}"
                probe.add(title, rows, alpha=list(alpha), elevation=elevation)
    return probe


# Places in tables

# By the comments of lobe_table.gdshaderinc: in [0, 1], and in radians.
COLUMN, ANGLE = 2.2e-4, 8.2e-5


def column_bound(cosine):
    """Of the column in [0, 1]. The root's argument (S - s) q is off by e, and near the last column the root is steep."""
    rest = float(1 - shader.column(cosine)) ** 2
    e = (SQRT + 12 * U) * 1.2 + DIVISION * rest
    return COLUMN + math.sqrt(rest + e) - math.sqrt(max(rest - e, 0.0)) + (SQRT + 2 * U)


ANGLE_BOUND = ANGLE + 2 * (DIVISION + 8 * U)


def expect_position(lookup, isotropic, row):
    wanted = clamp_view(vector(row[:3]))
    # Off by what is left of 1 after the root; LEAST_COSINE has eight digits.
    unit = INVERSE_SQRT + 5 * U + 1e-9
    bound = column_bound(wanted[2]) + unit * abs(
        float(shader.column(wanted[2] + mpf(2) ** -22) - shader.column(wanted[2] - mpf(2) ** -22)) * 2**21
    )
    columns = lookup[0]
    checks = [Near((0, 1, 2), wanted, unit, "radians")]
    checks.append(
        Near((3,), (shader.column(wanted[2]) * columns + mpf(lookup[1]),), bound * columns + 2 * U, "of the table")
    )
    if isotropic:
        height = row[3] * lookup[2] + lookup[3]
        checks.append(Near((4,), (height,), 4 * U, "of the table"))
    elif max(abs(wanted[0]), abs(wanted[1])) > 1e-6:
        angle = shader.quadrant_angle(wanted[0], wanted[1])
        height = angle * mpf(lookup[2]) + mpf(lookup[3])
        checks.append(Near((4,), (height,), ANGLE_BOUND * lookup[2] + 3 * U, "of the table"))
    else:
        # Any azimuth will do for a view along the normal.
        last = lookup[3] + 0.5 * math.pi * lookup[2] + 3 * U
        checks.append(Holds(lambda results: (max(lookup[3] - results[4], results[4] - last, 0.0), 3 * U, "beyond")))
    return checks


def position_probes(quick):
    elevations = [0.0, 1e-6, 1e-3, 0.5, 5.0, 30.0, 60.0, 85.0, 89.0, 89.39, 89.4, 89.99, 90.0, 120.0, 180.0]
    azimuths = [0.0, 1e-6, 0.1, 30.0, 45.0, 89.9, 90.0, 170.0, 180.0, 200.0, 270.0, 359.0]
    if quick:
        elevations, azimuths = elevations[::2], azimuths[::3]
    for columns, rows in ((2, 1), (16, 8)) if quick else ((2, 1), (16, 1), (16, 8), (256, 256)):
        for lobes in (1, 32):
            height = rows * lobes
            lookup = single(
                [(columns - 1) / columns, 0.5 / columns, (rows - 1) / (0.5 * math.pi * height), 0.5 / height]
            )
            isotropic = rows == 1
            title = f"position {columns}x{rows} lobes {lobes}"
            probe = Probe(
                title.replace(" ", "_"), "shader position", "position", 5, partial(expect_position, lookup, isotropic)
            )
            probe.defines = (f"LOBELIGHT_LOBES {lobes}",)
            if isotropic:
                # The rows of a lobe are widths then.
                probe.defines += ("LOBELIGHT_ISOTROPIC", "LOBELIGHT_WIDTHS_PER_PIXEL")
            probe.uniforms = {"lobelight_table_lookup": lookup}
            views = [view_at(e, a) for e in elevations for a in azimuths]
            probe.add(title, [(*view, 1.5 * isotropic) for view in views])
            yield probe


def probes(quick):
    return [*level_probes(quick), decode_probe(quick), *position_probes(quick)]
