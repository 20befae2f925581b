"""Probes of tangent frames and of views in them."""

import math
from functools import partial

import exact_shader as shader
import numpy as np
from exact import LEAST_COSINE, clamp_view, dot, mpf, norm, normalised, vector
from probes import DIVISION, INVERSE_SQRT, SQRT, U, Holds, Near, Probe, single
from shader_points import IDENTITY, turn, view_at

NAN, INFINITY = math.nan, math.inf

NORMALS = [
    (0, 0, 1),
    (0, 0, -1),
    (1, 0, 0),
    (0, -1, 0),
    (0.6, 0.48, 0.64),
    (-0.6, 0.48, -0.64),
    (1e-4, 0, -1),
    (0.57735, -0.57735, 0.57735),
]
BAD_TANGENTS = {
    "zero": (0.0, 0.0, 0.0),
    "NaN": (NAN, NAN, NAN),
    "half NaN": (1.0, NAN, 0.0),
    "infinite": (INFINITY, 0.0, 0.0),
    "minus infinite": (0.0, -INFINITY, 1.0),
    "tiny": (1e-30, 1e-30, 0.0),
    "denormal": (1e-40, 0.0, 0.0),
    "huge": (1e30, -1e30, 1e30),
}


def orthonormality(results):
    """The largest entry of the product with the transposed less that of 1."""
    m = np.array(results[:9], dtype=float).reshape(3, 3)
    return float(np.abs(m @ m.T - np.eye(3)).max())


def expect_frame(row):
    normal, tangent, bitangent = row[0:3], row[4:7], row[8:11]
    checks = [Near((6, 7, 8), normal, U, "radians")]
    n = vector(normal)
    slack, falls_back = 40 * U, True
    if all(map(math.isfinite, tangent)):
        across = shader.minus(vector(tangent), shader.scaled(n, dot(n, vector(tangent))))
        length = float(norm(across))
        # What is left of the tangent is a difference of vectors of its length.
        lost = 4 * U * math.hypot(*tangent)
        low, high = max(length - lost, 0.0) ** 2, (length + lost) ** 2
        falls_back = high < 0.9e-8 or low > 1.1e8
        if not falls_back:
            slack = 2 * lost / max(length - lost, 0.9e-4) + 8 * U + INVERSE_SQRT
            if low > 1.1e-8 and high < 0.9e8:
                checks.append(Near((0, 1, 2), normalised(across), slack, "radians"))
    if falls_back:
        # 1 / (1 + |z|) and sums of products.
        checks.append(Near((0, 1, 2), shader.any_tangent(n), DIVISION + 8 * U, "radians"))
    unit = abs(float(norm(n)) - 1.0)
    checks.append(Holds(lambda results: (orthonormality(results), 4 * slack + 8 * U + 4 * unit, "orthonormal")))
    if all(map(math.isfinite, bitangent)):

        def handedness(results):
            side = sum(a * b for a, b in zip(results[3:6], bitangent))
            return max(-side, 0.0), 8 * slack * (1 + math.hypot(*bitangent)), "wrong hand"

        checks.append(Holds(handedness))
    return checks


def orthonormal_frame(normal, tangent, bitangent):
    """(tangent, bitangent, normal) of sound vectors, with the hand that they have."""
    t = normalised(shader.minus(tangent, shader.scaled(normal, dot(normal, tangent))))
    b = shader.cross(normal, t)
    return t, shader.scaled(b, -1 if dot(b, bitangent) < 0 else 1), normal


def frame_probe(quick):
    probe = Probe("frame", "shader frame", "frame", 9, expect_frame)
    normals = [tuple(single(normalised(vector(n)))) for n in NORMALS]
    for normal in normals[:: 2 if quick else 1]:
        shown = ",".join(f"{x:.2g}" for x in normal)
        good = single(shader.any_tangent(vector(normal)))
        cases = dict(BAD_TANGENTS)
        cases["parallel to the normal"] = normal
        cases["against the normal"] = tuple(-3 * x for x in normal)
        rows = [(*normal, 0, *bad, 0, *second, 0) for bad in cases.values() for second in (*cases.values(), good)]
        probe.add(f"frame about {shown}, bad tangents", rows)
        rows = []
        # Also those on either side of what is too short and too long to be one.
        lengths = (1e-3, 1e3, 2e-4, 5e-5, 5e3, 2e4)
        for tangent in (good, -good, *np.eye(3), *(length * np.eye(3)[1] for length in lengths)):
            for lean in (0.0, 0.3, -30.0, 3e3):
                skewed = [a + lean * b for a, b in zip(tangent, normal)]
                for hand in (1.0, -1.0):
                    bitangent = hand * np.cross(normal, tangent)
                    rows.append((*normal, 0, *skewed, 0, *bitangent, 0))
        probe.add(f"frame about {shown}, skewed tangents", rows)
    return probe


# Columns of projections: perspective, orthographic, upside down, and those of lightmaps.
def projection(parallel, flipped, depth=1.0):
    y = -1.5 if flipped else 1.5
    last = (0, 0, 0.05, 1) if parallel else (0, 0, 0.05, 0)
    return (1.2, 0, 0, 0, 0, y, 0, 0, 0, 0, depth, 0 if parallel else -1, *last)


def expect_seen(row, renderer):
    parallel = row[4 + 15] > 0.5
    view = (0, 0, 1) if parallel else row[:3]
    if renderer == "gl_compatibility":
        seen = row[4 + 10] > 0
    else:
        seen = not parallel or row[4 + 5] < 0
    return [Near((0, 1, 2), view, U, "radians"), Near((3,), (1.0 if seen else 0.0,), U, "yes or no")]


def seen_probe():
    probe = Probe("seen", "shader frame", "seen", 4, expect_seen, by_renderer=True)
    rows = [
        (0.6, 0.0, 0.8, 0.0, *projection(parallel, flipped, depth))
        for parallel in (False, True)
        for flipped in (False, True)
        for depth in (1.0, -1.0, 0.0)
    ]
    probe.add("frame, views and projections", rows)
    return probe


# Views


def expect_isotropic_view(row):
    normal, view = vector(row[:3]), vector(row[4:7])
    o, toward, tangent = shader.view_of(normal, view)
    cosine = dot(normal, view)
    sine = float(norm(shader.minus(view, shader.scaled(normal, cosine))))
    # The difference across the normal has three roundings of numbers up to 1, however short it is.
    across = 8 * U
    length = float(norm((mpf(sine), mpf(0), max(cosine, LEAST_COSINE))))
    unit = (across + 8 * U) / length + INVERSE_SQRT + 4 * U + 1e-9
    checks = [
        Near((6, 7, 8), normal, U, "radians"),
        Near((9, 10, 11), o, unit, "radians"),
        Near((15, 16), (1, 1), U, "signs"),
    ]
    slack = across / max(sine, 1e-5) + SQRT + DIVISION + 6 * U
    if sine > 1.02e-5:
        checks.append(Near((0, 1, 2), tangent, slack, "radians"))
    if sine > 1.02e-5 or sine < 0.98e-5:
        # Whatever the tangent, it is multiplied by the sine.
        lost = 2e-5 / length if sine < 1e-5 else 0.0
        checks.append(Near((12, 13, 14), toward, unit + slack * float(o[0]) + 4 * U + lost, "radians"))
    near_unit = 4 * abs(float(norm(normal)) - 1) + 4 * slack + 8 * U
    checks.append(Holds(lambda results: (orthonormality(results), near_unit, "orthonormal")))
    checks.append(Holds(plane_error))
    return checks


def plane_error(results):
    """The plane's two directions, by what the shader itself has of frame and view."""
    sine, up = results[9], results[11]
    off = 0.0
    for i in range(3):
        tangent, normal = results[i], results[6 + i]
        off = max(off, abs(results[17 + i] - (normal * up - tangent * sine)), abs(results[20 + i] - (tangent * up + normal * sine)))
    return off, 4 * U, "directions"


def half_vector_error(alpha, results):
    """The columns of the frame times alpha and signs, by what the shader itself has of these."""
    off = 0.0
    for n in range(3):
        scale = alpha[n] * results[15 + n] if n < 2 else 1.0
        off = max(off, *(abs(results[17 + 3 * n + i] - scale * results[3 * n + i]) for i in range(3)))
    # Through 1 / alpha and back.
    return off, 8 * U * max(1.0, *alpha), "half-vectors"


def expect_anisotropic_view(row):
    frame = tuple(vector(row[4 * n : 4 * n + 3]) for n in range(3))
    view = vector(row[12:15])
    to_environment = tuple(vector(row[4 * n : 4 * n + 3]) for n in range(4, 7))
    alpha = (row[3], row[7])
    raw = tuple(dot(view, axis) for axis in frame)
    o = clamp_view(raw)
    length = float(norm((raw[0], raw[1], max(raw[2], LEAST_COSINE))))
    unit = 6 * U / length + INVERSE_SQRT + 6 * U + 1e-9
    turned = [shader.columns_times(to_environment, axis) for axis in frame]
    checks = [Near((3 * n, 3 * n + 1, 3 * n + 2), turned[n], 8 * U, "radians") for n in range(3)]
    checks.append(Near((9, 10, 11), o, unit, "radians"))
    checks.append(Near((12, 13, 14), shader.columns_times(turned, o), unit + 16 * U, "radians"))

    def folded(results):
        """The signs take the view into the quadrant, whatever its last bit."""
        return max(0.0, -results[9] * results[15], -results[10] * results[16]), 4 * U, "signs"

    checks += [Holds(folded), Holds(lambda r: (abs(abs(r[15] * r[16]) - 1), U, "signs"))]
    checks.append(Holds(partial(half_vector_error, alpha)))
    return checks


def expect_view_along(row):
    """The same from an axis; which way the frame's first two columns point is told by the view, or by `side`."""
    frame = tuple(vector(row[4 * n : 4 * n + 3]) for n in range(3))
    view = vector(row[12:15])
    to_environment = tuple(vector(row[4 * n : 4 * n + 3]) for n in range(4, 7))
    raw = tuple(dot(view, axis) for axis in frame)
    o = clamp_view(raw)
    length = float(norm((raw[0], raw[1], max(raw[2], LEAST_COSINE))))
    # The view's length in the table's range is the root of a difference.
    unit = (24 * U / length + 12 * U / length**2) + INVERSE_SQRT + 24 * U + 1e-9
    turned = [shader.columns_times(to_environment, axis) for axis in frame]

    def off_frame(results):
        first, second = (tuple(results[3 * n : 3 * n + 3]) for n in range(2))
        aligned = [abs(sum(float(x) * y for x, y in zip(turned[n], column))) for n, column in enumerate((first, second))]
        return max(abs(x - 1) for x in aligned), 40 * U, "frame"

    def off_view(results):
        wanted = (abs(float(o[0])), abs(float(o[1])), float(o[2]))
        got = (results[9], results[10] * results[16], results[11])
        return max(abs(x - y) for x, y in zip(wanted, got)), unit, "radians"

    def off_components(results):
        """What the view is by the frame is what it says."""
        toward = results[12:15]
        parts = [sum(results[3 * n + i] * toward[i] for i in range(3)) for n in range(3)]
        return max(abs(x - y) for x, y in zip(parts, results[9:12])), 2 * unit + 16 * U, "view"

    checks = [Near((6, 7, 8), turned[2], 8 * U, "radians"), Holds(off_frame), Holds(off_view), Holds(off_components)]
    checks.append(Near((12, 13, 14), shader.columns_times(turned, o), unit + 16 * U, "radians"))
    checks.append(Holds(partial(half_vector_error, (row[3], row[7]))))
    return checks


ANGLES = [0.0, 1e-6, 1e-4, 5.6e-4, 6e-4, 1e-3, 0.1, 10, 45, 80, 89, 89.4, 89.9, 89.99, 90, 90.01, 91, 120, 150, 179, 180]
TURNS = [0, 30, 90, 135, 180, 225, 270, 300]


def view_probes(quick):
    angles, turns = (ANGLES[::2], TURNS[::2]) if quick else (ANGLES, TURNS)
    round_one = Probe("view_isotropic", "shader view", "view", 26, expect_isotropic_view)
    round_one.defines = ("LOBELIGHT_ISOTROPIC",)
    other = Probe("view_anisotropic", "shader view", "view", 26, expect_anisotropic_view)
    along = Probe("view_along", "shader view", "view", 26, expect_view_along)
    along.defines = ("LOBELIGHT_AXIS",)
    for seed in (0, 1) if quick else (0, 1, 2, 3):
        frame = IDENTITY if seed == 0 else turn(seed)
        second = turn(seed + 10)
        for elevation in angles:
            views = [view_at(elevation, azimuth) for azimuth in turns]
            turned = [[sum(frame[n][axis] * v[n] for n in range(3)) for axis in range(3)] for v in views]
            name = f"elevation {elevation:g}, turned {seed} times"
            round_one.add(f"view isotropic {name}", [(*frame[2], 0.2, *view, 0.0) for view in turned])
            padded = [x for column in second for x in (*column, 0.0)]
            rows = [(*frame[0], 0.5, *frame[1], 0.01, *frame[2], 0.0, *view, 0.0, *padded) for view in turned]
            other.add(f"view anisotropic {name}", rows)
            along.add(f"view along an axis {name}", rows)
    return [round_one, other, along]


def probes(quick):
    return [frame_probe(quick), seen_probe(), *view_probes(quick)]
