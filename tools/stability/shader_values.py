"""Probes of numbers as such: the way there and back, colours, half floats, faces of cube maps, panoramas."""

import math
from functools import partial

import mpmath as mp
import numpy as np

import exact_shader as shader
from exact import mpf, norm, vector
from probes import ATAN, DIVISION, INVERSE_SQRT, SQRT, U, Holds, Near, Probe, Texture, pow_error
from shader_points import view_at

NAN, INFINITY = math.nan, math.inf
LARGEST = 65504.0


# Bits

PATTERNS = """00000000 80000000 00000001 007fffff 80000001 00800000 3f800000 7f7fffff 7f800000 ff800000 7fc00000 7f800001
ffc12345 3eaaaaab 12345678 deadbeef"""


def bits_probe():
    """Bit patterns, among them denormals, infinities and numbers that are none, come back as they went."""
    probe = Probe("bits", "shader bits", "bits", 4, lambda row: [], any_bits=True)
    patterns = np.array([int(p, 16) for p in PATTERNS.split()], dtype=np.uint32)
    random = np.random.default_rng(1).integers(0, 2**32, 1024 - patterns.size, dtype=np.uint32)
    probe.patterns = np.concatenate([patterns, random]).reshape(-1, 4)
    # Of which only the number counts.
    probe.rows = [(0.0,) * 4] * len(probe.patterns)
    probe.cases = [("bits there and back", 0, len(probe.rows), {})]
    return probe


# Colours

COLOURS = [0.0, -0.0, 1e-30, 1e-7, 1e-6, 1e-4, 0.002, 0.0404, 0.0405, 0.041, 0.1, 0.18, 0.5, 0.73, 1.0, 1.5, 4.0, 100.0]
COLOURS += [6e4, 65504.0]
AWKWARD = [NAN, INFINITY, -INFINITY, -1.0, -1e-40, 1e-40, 65505.0, 1e10, 3e38]


def encode_error(x):
    """Relative: by the comment of lobelight_encode, and roundings of a polynomial up to 10 and of a power."""
    root = shader.encoded(x)
    if x < 5e-6:
        # f is taken for its last term: what is left out is 0.682171111 (x / 0.012522878)^2.
        off = 4350.0 * x**2
    elif x < 0.001:
        off = 5e-6
    else:
        off = (0.00023 if 0.002 <= x <= 4.0 else 0.0014) * x
    most = max(shader.encoded(x + off) - root, root - shader.encoded(max(x - off, 0.0)))
    return float(most / root) + pow_error(x, 0.5) + 40 * U


def expect_colour(row, renderer):
    checks = []
    compatible = renderer == "gl_compatibility"
    for n, x in enumerate(row[:3]):
        if 1e-37 < x < (LARGEST if compatible else 1e30) or x == 0:
            wanted = shader.encoded(x) if compatible else mpf(x)
            small = x < 1e-7
            bound = float(wanted) * (encode_error(x) if compatible and x > 0 else U) * (10 if small else 1) + 1e-37
            checks.append(Near((n,), (wanted,), bound, "encoded"))
        light = min(x, LARGEST) if x > 0 else 0.0
        if light > 1e-37 or light == 0.0:
            wanted = shader.encoded(light) if compatible else mpf(light)
            bound = float(wanted) * (encode_error(light) if compatible and light > 0 else U)
            bound = bound * (10 if light < 1e-7 else 1) + 1e-37
            checks.append(Near((3 + n,), (wanted,), bound, "emission"))
        checks.append(Holds(partial(sound, 3 + n)))
        if 1e-30 < x < 1e6 or x == 0:
            wanted = float(shader.srgb_to_linear(x))
            # (x + 0.055) / 1.055 and its power; the two branches meet within 1e-7.
            bound = wanted * (2.4 * (DIVISION + 2 * U) + pow_error((x + 0.055) / 1.055, 2.4) + DIVISION) + 1e-37
            bound += 1e-7 if abs(x - 0.04045) < 1e-6 else 0.0
            checks.append(Near((6 + n,), (wanted,), bound, "linear"))
            decoded = (wanted, bound) if compatible else (x, U * x)
            checks.append(Near((9 + n,), (decoded[0],), decoded[1] + 1e-37, "texel"))
    return checks


def sound(at, results):
    """Emission is finite and not negative, whatever comes in."""
    x = results[at]
    return (0.0 if math.isfinite(x) and x >= 0 else 1.0), 0.5, "finite and not negative"


def colour_probe(quick):
    probe = Probe("colour", "shader colour", "colour", 12, expect_colour, by_renderer=True, any_bits=True)
    values = [*COLOURS, *(10.0 ** (n / (4 if quick else 16)) for n in range(-32 if quick else -128, 20 if quick else 77))]
    for x in values:
        probe.add(f"colour {x:.4g}", [(x, 0.5 * x, 1.0, 0.0)])
    for x in AWKWARD:
        probe.add(f"colour {x:.4g}", [(x, 1.0, x, 0.0), (0.25, x, 65504.0, 0.0)])
    return probe


# Half floats


def expect_half(row):
    return [Holds(partial(nearest_half, n, x)) for n, x in enumerate(row[:3])]


def nearest_half(at, x, results):
    """Exactly, in the range where halves have all their bits."""
    return (0.0 if results[at] == float(np.float16(x)) else abs(results[at] - x) + 1e-30), 1e-38, "half floats"


def half_probe(quick):
    probe = Probe("half", "shader half", "half", 3, expect_half)
    rng = np.random.default_rng(5)
    exact = rng.integers(0x0400, 0x7BFF, 300).astype(np.uint16).view(np.float16).astype(float)
    between = (exact[:-1] + np.nextafter(exact[:-1].astype(np.float16), np.float16(np.inf)).astype(float)) / 2
    near = np.concatenate([np.nextafter(between.astype(np.float32), np.float32(s)) for s in (0, 1e9)]).astype(float)
    spread = np.exp(rng.uniform(math.log(6.2e-5), math.log(65000), 64 if quick else 4096))
    for title, values in (("halves", exact), ("ties", between), ("next to ties", near), ("any", spread)):
        values = values[: len(values) // 3 * 3].reshape(-1, 3)
        probe.add(f"half floats, {title}", [(*v, 0.0) for v in values])
    return probe


# Faces


def face_of(d):
    """(face, x, y) by OpenGL 4.6, table 8.19; of components alike, x before y before z."""
    axis = max(range(3), key=lambda n: (abs(d[n]), -n))
    positive = d[axis] > 0
    sc, tc = {
        (0, True): (-d[2], -d[1]),
        (0, False): (d[2], -d[1]),
        (1, True): (d[0], d[2]),
        (1, False): (d[0], -d[2]),
        (2, True): (d[0], -d[1]),
        (2, False): (-d[0], -d[1]),
    }[axis, positive]
    return 2 * axis + (0 if positive else 1), mpf(sc) / abs(mpf(d[axis])), mpf(tc) / abs(mpf(d[axis]))


def expect_face(row):
    d, size = row[:3], int(row[3])
    face, x, y = face_of(d)
    largest = max(map(abs, d))
    back = [mpf(c) / mpf(largest) for c in d]
    checks = [
        Near((0,), (face,), U, "face"),
        Near((1, 2), (x, y), 2 * DIVISION, "of the face"),
        Near((3, 4, 5), back, 2 * DIVISION + U, "of the face"),
    ]
    # The pixel of the atlas whose middle the second texel says.
    column, line = (int(v) for v in (row[4] * 3 * size, row[5] * 2 * size))
    tile = (column // size, line // size)
    wanted = (tile[1] * 3 + tile[0], column % size, line % size, column, line)
    return [*checks, Near((6, 7, 8, 9, 10), wanted, U, "texels")]


def faces_probe(quick):
    probe = Probe("faces", "shader faces", "faces", 11, expect_face)
    rng = np.random.default_rng(6)
    special = [(1, 1, 1), (-1, 1, -1), (0, 1, 1), (1, -1, 0), (1, 0, 0), (0, -1, 0), (0, 0, -1), (1e-20, 0, 1), (-1, -1, -1)]
    for size in (1, 16, 128) if quick else (1, 2, 4, 16, 64, 128, 512, 2048):
        rows = []
        directions = [*special, *rng.normal(size=(23 if quick else 119, 3))]
        for d in directions:
            pixel = rng.integers(0, (3 * size, 2 * size))
            # The middle of a pixel, as the engine's rectangles have it.
            rows.append((*d, size, (pixel[0] + 0.5) / (3 * size), (pixel[1] + 0.5) / (2 * size), 0, 0))
        probe.add(f"faces of {size} texels", rows)
    return probe


# Panoramas

PANORAMA = (16, 8)


def panorama_texels():
    rng = np.random.default_rng(7)
    texels = rng.uniform(0.1, 2.0, size=(PANORAMA[1], PANORAMA[0], 4)).astype(np.float32)
    texels[2, 3, 0], texels[2, 4, 1], texels[5, 9, 2], texels[0, 0, 0] = NAN, INFINITY, -3.0, -INFINITY
    return texels


def expect_panorama(texels, as_sky, row):
    d = vector(row[:3])
    across, d_length = mp.hypot(d[0], d[2]), norm(d)
    if as_sky:
        u = shader.sky_atan(d[0], -d[2]) / (2 * mp.pi)
        v = shader.sky_acos(d[1] / d_length) / mp.pi
        # acos of the sky is as steep as a root where the argument is 1.
        y = abs(float(d[1] / d_length))
        e = INVERSE_SQRT + 6 * U
        v_bound = 0.5 * (math.sqrt(1 - y + 2 * e) - math.sqrt(max(1 - y - 2 * e, 0))) + SQRT + 10 * U
        u_bound = 2 * DIVISION + 12 * U
    else:
        u = mp.atan2(d[0], -d[2]) / (2 * mp.pi) if across > 0 else mpf(0)
        v = mp.atan2(across, d[1]) / mp.pi
        u_bound = v_bound = ATAN / 2 + 12 * U
    u -= mp.floor(u)
    width, height = PANORAMA
    x, y = u * width - mpf("0.5"), v * height - mpf("0.5")
    x0, y0 = int(mp.floor(x)), int(mp.floor(y))
    f, g = x - x0, y - y0
    rows = [min(max(r, 0), height - 1) for r in (y0, y0 + 1)]
    columns = [c % width for c in (x0, x0 + 1)]
    if across < mpf("1e-9") * d_length:
        # All azimuths are one there: anything between the texels next to the pole.
        row = texels[0 if d[1] > 0 else -1]
        ends = [[float(sound_texel(t[n])) for t in row] for n in range(3)]
        return [Holds(partial(between, n, min(end), max(end))) for n, end in enumerate(ends)]
    checks = []
    for n in range(3):
        four = [[sound_texel(texels[r, c, n]) for c in columns] for r in rows]
        above = four[0][0] * (1 - f) + four[0][1] * f
        below = four[1][0] * (1 - f) + four[1][1] * f
        # Texels are between 0 and 2, and so are their differences, also those of the next ones.
        bound = 2 * (u_bound * width + v_bound * height) + 2 * U * (width + height) + 8 * U
        checks.append(Near((n,), (above * (1 - g) + below * g,), bound, "radiance"))
    return checks


def between(at, low, high, results):
    return max(low - results[at], results[at] - high, 0.0), 4 * U, "radiance"


def sound_texel(x):
    """What is negative or no number counts as no light."""
    return mpf(float(x)) if math.isfinite(x) and x > 0 else mpf(0)


def panorama_probes(quick):
    texels = panorama_texels()
    for as_sky in (False, True):
        name = "as the sky" if as_sky else "exact"
        probe = Probe(
            f"panorama_{int(as_sky)}", "shader panorama", "panorama", 3, partial(expect_panorama, texels, as_sky)
        )
        probe.textures = {"panorama": "panorama"}
        probe.uniforms = {"panorama_is_srgb": [0.0], "panorama_as_sky": [float(as_sky)]}
        for elevation in (0.0, 0.01, 20.0, 67.5, 90.0, 130.0, 179.0, 180.0)[:: 2 if quick else 1]:
            rows = []
            for azimuth in (0.0, 13.0, 77.0, 90.0, 123.0, 180.0, 211.0, 270.0, 301.0, 359.99):
                x, z, y = view_at(elevation, azimuth)
                for length in (1.0, 1.7):
                    rows.append((length * x, length * y, length * z, 0.0))
            probe.add(f"panorama {name}, {elevation:g} degrees from the pole", rows)
        yield probe


def panorama_texture():
    return Texture(panorama_texels().tobytes(), *PANORAMA, is_float=True)


def probes(quick):
    return [bits_probe(), colour_probe(quick), half_probe(quick), faces_probe(quick), *panorama_probes(quick)]

