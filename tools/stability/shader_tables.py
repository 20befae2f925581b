"""Probes that look lobes up in tables: any view, one width or widths from pixel to pixel, with colours or without."""

import math
from dataclasses import dataclass
from functools import cache, partial

import mpmath as mp
import numpy as np

import exact_shader as shader
from exact import clamp_view, mpf, vector
from probes import FILTER, HALF, U, Near, Probe, Texture, exp2_error, single
from shader_points import ANGLE_BOUND, column_bound, lobe_bounds, view_at
from shader_widths import ROUGHNESSES, exact_levels, set_levels, width_errors


@dataclass(eq=False)
class Table:
    """Texels as half floats hold them: (layers, rows, columns, 4), both as lobe_table.gdshaderinc has them.

    `places` is the number of rows of a lobe: azimuths or, of isotropic tables of all widths, widths."""

    name: str
    texels: np.ndarray
    lobes: int
    alpha: tuple = (0.1, 0.1)
    isotropic: bool = False
    second: bool = False
    levels: tuple | None = None

    def __post_init__(self):
        self.texels = self.texels.astype(np.float16)
        self.alpha = tuple(single(self.alpha))

    @property
    def rows(self):
        return self.texels.shape[1]

    @property
    def columns(self):
        return self.texels.shape[2]

    @property
    def places(self):
        return self.rows // self.lobes // (2 if self.second else 1)

    def lookup(self):
        """lobelight_table_lookup."""
        scale = (self.columns - 1) / self.columns
        if self.levels and self.isotropic:
            return single([scale, 0.5 / self.columns, 1 / self.rows, 0.5 / self.rows])
        angle = (self.places - 1) / (0.5 * math.pi * self.rows)
        return single([scale, 0.5 / self.columns, angle, 0.5 / self.rows])

    def texture(self):
        layers = self.texels.shape[0]
        kind = "3d" if layers > 1 else "2d"
        return Texture(self.texels.tobytes(), self.columns, self.rows, layers, False, kind)

    def defines(self):
        names = [f"LOBELIGHT_LOBES {self.lobes}"]
        names += ["LOBELIGHT_ISOTROPIC"] * self.isotropic
        names += ["LOBELIGHT_SECOND_TEXELS"] * self.second
        names += ["LOBELIGHT_WIDTHS_PER_PIXEL"] * (self.levels is not None)
        return tuple(names)

    def uniforms(self):
        values = {"lobelight_table_lookup": self.lookup()}
        if self.levels:
            return values | {"lobelight_widths": self.levels}
        return values | {"lobelight_table_alpha": self.alpha}

    def layer(self, apart, narrow):
        """Of the tables of widths that lie `apart` levels apart: sorted by that, then by the narrower one."""
        count = int(self.levels[2]) + 1
        return sum(count - n for n in range(apart)) + narrow

    def fetch(self, number, row, column):
        """Bilinear, exactly; rows and columns count from the middle of the first texel."""
        texels = self.texels[number]
        r0, c0 = int(mp.floor(row)), int(mp.floor(column))
        f, g = row - r0, column - c0
        r0, r1 = (min(max(r, 0), self.rows - 1) for r in (r0, r0 + 1))
        c0, c1 = (min(max(c, 0), self.columns - 1) for c in (c0, c0 + 1))
        corners = (
            (texels[r0, c0], (1 - f) * (1 - g)),
            (texels[r0, c1], (1 - f) * g),
            (texels[r1, c0], f * (1 - g)),
            (texels[r1, c1], f * g),
        )
        return [sum((mpf(float(t[n])) * w for t, w in corners if w != 0), mpf(0)) for n in range(4)]

    def spread(self, number, rows, column, column_bound):
        """How far the texel can be off where filters have eight bits, the row lies in `rows`, and the column is off by
        column_bound."""
        texels = self.texels[number].astype(float)

        def corners(r, c):
            r0, c0 = math.floor(r), math.floor(c)
            some = np.clip([r0, r0 + 1], 0, self.rows - 1), np.clip([c0, c0 + 1], 0, self.columns - 1)
            return texels[np.ix_(*some)], r - r0, c - c0

        def between(r, c):
            four, f, g = corners(r, c)
            return (1 - f) * ((1 - g) * four[0, 0] + g * four[0, 1]) + f * ((1 - g) * four[1, 0] + g * four[1, 1])

        c = float(column)
        middle = between(float(rows.middle), c)
        off, span, size = np.zeros(4), np.zeros(4), np.zeros(4)
        # Between texels the filter is linear along either axis, so that it is farthest off at a texel or at an end.
        for at_row in knots(rows.low - rows.bound, rows.high + rows.bound):
            for at_column in knots(c - column_bound, c + column_bound):
                off = np.maximum(off, np.abs(between(at_row, at_column) - middle))
        for at_row in range(math.floor(rows.low), max(math.ceil(rows.high), math.floor(rows.low) + 1)):
            four = corners(at_row, c)[0]
            span = np.maximum(span, four.max(axis=(0, 1)) - four.min(axis=(0, 1)))
            size = np.maximum(size, np.abs(four).max(axis=(0, 1)))
        return off + FILTER * span + 4 * U * size


def knots(low, high):
    """Both ends, and the whole numbers between them."""
    return [low, *range(math.floor(low) + 1, math.ceil(high)), high]


@dataclass
class Rows:
    """Where a lobe's row lies: anywhere from `low` to `high` for what the view's azimuth may be, and off by `bound`."""

    middle: mpf
    low: float
    high: float
    bound: float

    def __add__(self, step):
        return Rows(self.middle + step, self.low + step, self.high + step, self.bound)


@dataclass
class Lobe:
    """What is expected of one lobe, and how far it may be off in single precision and, beyond that, with halves."""

    mean: tuple
    variance: mpf
    weight: mpf
    grazing: mpf  # the weight times what Schlick's Fresnel has of f90 - f0
    tint: tuple
    tint_bound: float
    mean_bound: tuple
    variance_bound: tuple  # relative
    weight_bound: tuple
    grazing_bound: tuple


def places(table, o, roughness, anisotropy):
    """[(share, layer)], the row within a lobe, how far that may be off, the widths."""
    if not table.levels:
        if table.isotropic:
            return [(mpf(1), 0)], mpf(0), 0.0, vector(table.alpha), False
        row = shader.quadrant_angle(o[0], o[1]) / (mp.pi / 2) * (table.places - 1)
        return [(mpf(1), 0)], row, ANGLE_BOUND * (table.places - 1), vector(table.alpha), False
    level_bound, _logarithm = width_errors(table.levels, roughness, anisotropy)
    if table.isotropic:
        place, alpha = exact_levels(table.levels, roughness, 0.0)
        return [(mpf(1), 0)], place[0], level_bound, (alpha[0], alpha[0]), False
    place, alpha = exact_levels(table.levels, roughness, anisotropy)
    exchanged = anisotropy < 0
    if exchanged:
        place, alpha, o = place[::-1], alpha[::-1], (o[1], o[0], o[2])
    last = int(table.levels[2])
    distance, middle = place[0] - place[1], (place[0] + place[1]) / 2
    first = min(int(mp.floor(distance)), last - 1)
    shares = []
    for apart, share in ((first, 1 - (distance - first)), (first + 1, distance - first)):
        narrow = min(max(middle - mpf(apart) / 2, mpf(0)), mpf(last - apart))
        low = min(int(mp.floor(narrow)), max(last - apart - 1, 0))
        shares.append((share * (1 - (narrow - low)), table.layer(apart, low)))
        if narrow > low:
            shares.append((share * (narrow - low), table.layer(apart, low + 1)))
    row = shader.quadrant_angle(o[0], o[1]) / (mp.pi / 2) * (table.places - 1)
    return shares, row, ANGLE_BOUND * (table.places - 1), alpha, exchanged


@cache
def expect_lobes(table, view, roughness=0.0, anisotropy=0.0, only=None):
    """(the view within the table's range, the lobes)."""
    raw = vector(view)
    if table.isotropic:
        o, toward, tangent = shader.view_of((mpf(0), mpf(0), mpf(1)), raw)
        axes = (tangent, shader.cross((mpf(0), mpf(0), mpf(1)), tangent))
    else:
        o = toward = clamp_view(raw)
    shares, place, place_bound, alpha, exchanged = places(table, o, roughness, anisotropy)
    sides = [mpf(-1) if x < 0 else mpf(1) for x in o[:2]]
    if not table.isotropic:
        axes = ((sides[0], mpf(0), mpf(0)), (mpf(0), sides[1], mpf(0)))
        if exchanged:
            axes = axes[::-1]
    half_vectors = (shader.scaled(axes[0], alpha[0]), shader.scaled(axes[1], alpha[1]), (mpf(0), mpf(0), mpf(1)))
    # What the view is off by, in radians; near the normal the azimuth is off by that over the sine.
    view_bound = 40 * U / max(float(abs(o[2])), 0.5) if raw[2] > 0.1 else 40 * U * 100 ** (raw[2] <= 0)
    sine = float(mp.hypot(o[0], o[1]))
    # The tangent of isotropic tables is a difference of numbers up to 1 over the sine.
    skew = 8 * U / sine if table.isotropic and sine > 0.99e-5 else 0.0
    # Along the normal, any azimuth of the quadrant will do, as the shader says.
    wander = 0.0 if table.isotropic else min(view_bound / max(sine, 1e-9), 1.0) * (table.places - 1)
    low, high = max(float(place) - wander, 0.0), min(float(place) + wander, table.places - 1.0)
    column = shader.column(o[2]) * (table.columns - 1)
    steep = column_bound(o[2]) + view_bound * slope_of_column(o[2])
    column_off = steep * (table.columns - 1) + 4 * U * table.columns
    width_error = width_errors(table.levels, roughness, anisotropy) if table.levels else (0.0, 0.0)
    alpha_error = math.log(2) * width_error[1] + 40 * U if table.levels else U
    lobes = []
    for k in range(table.lobes) if only is None else (only,):
        at = Rows(place, low, high, place_bound + (k + 4) * U * table.rows) + k * table.places
        row = at.middle
        texel = [mpf(0)] * 4
        off = np.zeros(4)
        for share, number in shares:
            part = table.fetch(number, row, column)
            texel = [t + share * p for t, p in zip(texel, part)]
            off += abs(float(share)) * table.spread(number, at, column, column_off)
        if len(shares) > 1:
            # Shares off by the level's error or by the filter's bits, between tables that differ.
            apart = np.zeros(4)
            for r in map(mpf, knots(at.low, at.high)):
                parts = np.array([[float(x) for x in table.fetch(number, r, column)] for _share, number in shares])
                apart = np.maximum(apart, parts.max(axis=0) - parts.min(axis=0))
            off += (4 * width_error[0] + 2 * FILTER) * apart
        # Where halves have fewer bits, they are 2^-24 apart.
        half = np.array([HALF * abs(float(t)) + 2.0**-24 for t in texel])
        tint = tint_of(table, at, column, column_off)
        if table.isotropic:
            lobes.append(plane_lobe_of(texel, o, tangent, off, half, view_bound, skew, tint))
            continue
        lobes.append(lobe_of(texel, half_vectors, toward, off, half, alpha, alpha_error, view_bound, skew, tint))
    return o, lobes


def slope_of_column(cosine):
    """d column / d angle, finite at the last column."""
    step = mpf(2) ** -20
    angle = mp.acos(cosine)
    before, after = shader.column(mp.cos(max(angle - step, 0))), shader.column(mp.cos(angle + step))
    return float((after - before) / step)


def tint_of(table, rows, column, column_off):
    """The lobe's colour, and what each channel may be off by."""
    if not table.second:
        return (mpf(1), mpf(1), mpf(1)), U
    rows += table.rows // 2
    red, blue = table.fetch(0, rows.middle, column)[2:]
    off = table.spread(0, rows, column, column_off)[2:].sum()
    return (red, max(3 - red - blue, mpf(0)), blue), float(off) + 6 * U


def lobe_of(texel, half_vectors, toward, off, half, alpha, alpha_error, view_bound, skew, tint):
    mean, variance, cosine = shader.lobe(texel, half_vectors, toward)
    a = [float(x) for x in alpha]
    x, y = float(texel[0]), float(texel[1])
    length = math.sqrt(1 + (a[0] * x) ** 2 + (a[1] * y) ** 2)

    def turned(error):
        """How far the half-vector turns."""
        return (a[0] * (error[0] + alpha_error * abs(x)) + a[1] * (error[1] + alpha_error * abs(y))) / length

    floats = [tuple(map(float, v)) for v in half_vectors]
    rounding, cosine_rounding = lobe_bounds(x, y, floats, [float(v) for v in toward])
    bounds = []
    weight, grazing = texel[3], shader.schlick(cosine)
    for error in (off, half):
        first = not bounds
        angle = turned(error) if first else (a[0] * error[0] + a[1] * error[1]) / length
        extra = view_bound + 2 * skew * math.hypot(a[0] * x, a[1] * y) / length if first else 0.0
        cosine_bound = angle + extra + (cosine_rounding if first else 0.0)
        exponent = math.log(2) * error[2] + cosine_bound / float(cosine)
        weight_bound = error[3] + (2 * U * abs(float(weight)) if first else 0.0)
        x = float(grazing)
        x_off = float(shader.schlick(float(cosine) - cosine_bound)) - x + (10 * U * x if first else 0.0)
        bounds.append(
            (
                min(2 * angle + 2 * extra + (rounding if first else 0.0), 2.0),
                math.expm1(min(exponent, 50.0)) + (exp2_error(float(texel[2])) + 2 * U if first else 0.0),
                weight_bound,
                x * weight_bound + x_off * (float(weight) + weight_bound),
            )
        )
    return Lobe(mean, variance, weight, grazing * weight, *tint, *zip(*bounds))


def plane_lobe_of(texel, o, tangent, off, half, view_bound, skew, tint):
    """A lobe of an isotropic table, whose texels lie in the plane of incidence."""
    mean, variance, weight, grazing = shader.plane_lobe(texel, o, tangent)
    size = 256 * math.sqrt(float(variance))
    bounds = []
    for error in (off, half):
        first = not bounds
        angle = math.hypot(error[0], error[1]) / size
        relative = 2 * angle + angle**2 + (6 * U if first else 0.0)
        extra = 2 * view_bound + 2 * skew + 24 * U if first else 0.0
        rounding = [2 * U * abs(float(x)) if first else 0.0 for x in texel[2:]]
        bounds.append((min(angle + extra, 2.0), relative, error[2] + rounding[0], error[3] + rounding[1]))
    return Lobe(mean, variance, weight, grazing, *tint, *zip(*bounds))


def expect_lobe(table, row):
    roughness, anisotropy = row[4:6]
    number = int(row[3])
    lobe = expect_lobes(table, row[:3], roughness, anisotropy, number)[1][0]
    variance = float(lobe.variance)
    scale = 1 / math.sqrt(variance) if lobe.weight > mpf("1e-4") else 0.0
    checks = [
        Near((0, 1, 2), lobe.mean, lobe.mean_bound[0], "radians", lobe.mean_bound[1], scale),
        Near((3,), (1,), lobe.variance_bound[0], "variance", lobe.variance_bound[1]),
        Near((4,), (lobe.grazing,), lobe.grazing_bound[0] + 1e-12, "weight", lobe.grazing_bound[1]),
        Near((5,), (lobe.weight,), lobe.weight_bound[0] + 1e-12, "weight", lobe.weight_bound[1]),
    ]
    checks[1] = RelativeVariance(3, variance, *lobe.variance_bound)
    medium = 12 * HALF if table.second else 0.0
    checks.append(Near((6, 7, 8), lobe.tint, 2 * lobe.tint_bound, "tint", medium))
    return checks


@dataclass
class RelativeVariance:
    at: int
    exact: float
    bound: float
    medium: float

    def judge(self, verdict, results, medium):
        verdict.error(abs(results[self.at] / self.exact - 1.0), self.bound + medium * self.medium, "variance")


# Tables


def plane_texels(texels, alpha):
    """Of an isotropic table, as runtime/table/plane_lobes.gd makes them, for the same views."""
    rest = 1 - np.arange(texels.shape[2]) / (texels.shape[2] - 1)
    elevation = float(shader.LAST_ELEVATION) * (1 - rest**2)
    sine, up = np.sin(elevation), np.cos(elevation)
    x = alpha * texels[..., 0]
    length = np.sqrt(1 + x * x)
    cosine = np.maximum((up + sine * x) / length, 1e-4)
    size = 256 * np.sqrt(cosine * 2.0 ** -texels[..., 2]) / length**2
    grazing = texels[..., 3] * np.maximum(1 - cosine, 0) ** 5
    return np.stack([(1 - x * x) * size, 2 * x * size, texels[..., 3], grazing], axis=-1)


def odd_texels(rng, layers, rows, columns, lobes, second, is_plane):
    """Lobes that differ in every component and change with the view, a little from texel to texel."""
    per_lobe = rows // lobes
    texels = np.zeros((layers, rows, columns, 4))
    for layer in range(layers):
        for k in range(lobes):
            start = rng.uniform((-3, -3, 2, 0.02), (3, 3, 14, 1.0 / lobes))
            drift = rng.uniform(-0.3, 0.3, size=(2, 4)) * (1, 1, 1, 0.02)
            for p in range(per_lobe):
                for t in range(columns):
                    texel = start + drift[0] * p / per_lobe * 2 + drift[1] * t / columns * 2
                    texels[layer, k * per_lobe + p, t] = texel
    texels[..., 3] = np.abs(texels[..., 3])
    if is_plane:
        texels = plane_texels(texels, 0.1)
    if not second:
        return texels
    tints = np.zeros_like(texels)
    tints[..., 2] = rng.uniform(0, 2, size=texels.shape[:3])
    tints[..., 3] = rng.uniform(0, 1, size=texels.shape[:3]) * (3 - tints[..., 2])
    return np.concatenate([texels, tints], axis=1)


def odd_table(name, lobes, columns, azimuths, alpha=(0.1, 0.1), second=False, levels=None, seed=1):
    """`azimuths` 0 stands for an isotropic table."""
    rng = np.random.default_rng(seed)
    isotropic = azimuths == 0
    layers, per_lobe = 1, max(azimuths, 1)
    if levels:
        count = int(levels[2]) + 1
        if isotropic:
            per_lobe = count
        else:
            layers = count * (count + 1) // 2
    texels = odd_texels(rng, layers, lobes * per_lobe, columns, lobes, second, isotropic)
    return Table(name, texels, lobes, alpha, isotropic, second, levels)


def tables(quick):
    nine = set_levels(0.01, 1.0, 9)
    made = [
        odd_table("table_round", 8, 16, 0, (0.2, 0.2)),
        odd_table("table_long", 8, 16, 8, (0.3, 0.02), seed=2),
        odd_table("table_coloured", 4, 8, 4, (0.1, 0.3), second=True, seed=3),
        odd_table("table_widths_round", 8, 16, 0, levels=nine, seed=4),
        odd_table("table_widths_long", 4, 8, 4, levels=nine, seed=5),
    ]
    if not quick:
        made += [
            odd_table("table_one", 1, 2, 0, (1e-4, 1e-4), seed=6),
            odd_table("table_fine", 32, 64, 16, (2.0, 0.002), seed=7),
            odd_table("table_coloured_round", 8, 16, 0, (0.5, 0.5), second=True, seed=8),
        ]
    return made


ELEVATIONS = [0.0, 1e-6, 1e-2, 10.0, 47.0, 80.0, 89.3, 89.4, 89.7, 90.0, 100.0, 170.0]
AZIMUTHS = [0.0, 35.0, 90.0, 160.0, 180.0, 250.0, 270.0, 359.999]


def lobe_probe(table, title, quick, few=False):
    """`few`: of the views and lobes."""
    probe = Probe(f"lobe_{table.name}", "shader look-up", "lobe", 9, partial(expect_lobe, table))
    probe.defines, probe.uniforms, probe.has_medium = table.defines(), table.uniforms(), True
    probe.textures = {"lobelight_table": table.name}
    widths = [(0.0, 0.0)]
    if table.levels:
        widths = [(r, 0.0) for r in ROUGHNESSES[::3]]
        if not table.isotropic:
            widths = [(0.0, 0.0), (0.1, 1.1), (0.3, 0.5), (0.35, -0.5), (0.6, 0.95), (0.6, -9.0), (1.0, 1.0), (2.0, 0.0)]
    step = (3 if quick else 1) * (2 if few else 1)
    elevations, azimuths = ELEVATIONS[::step], AZIMUTHS[::step]
    numbers = sorted({0, table.lobes // 2, table.lobes - 1})
    for roughness, anisotropy in widths[:: 3 if quick else 1]:
        for elevation in elevations:
            shown = f" roughness {roughness:g} anisotropy {anisotropy:g}" if table.levels else ""
            views = [view_at(elevation, azimuth) for azimuth in azimuths]
            rows = [(*view, k, roughness, anisotropy, 0, 0) for view in views for k in numbers]
            probe.add(f"look-up {title}{shown} view {elevation:g}", rows)
    return probe


def probes(quick, made):
    return [lobe_probe(table, table.name.replace("_", " "), quick) for table in made]
