"""Probes that fetch the environment: whole reflections, the coat, the sheen, diffuse light.

In the cube map `levels` each level has one colour, so that its light says at which level it was looked up; in `directions`
the light is 1 + d/2, which says where. Between them they know what a look-up is. `flat` is white: what is reflected of it is
the energy of the lobes.
"""

import math
from functools import partial

import numpy as np

import exact_shader as shader
from exact import mpf, normalised, vector
from probe_textures import DIRECTIONS_SIZE, LEVELS_SIZE, level_colours
from probes import DIVISION, FILTER, HALF, U, Energy, Near, Probe, single
from shader_points import exact_level, level_bound, light, turn, view_at
from shader_tables import expect_lobes, odd_table

# The fixed colours of the levels, their largest step.
LEVEL_STEP = 0.25
# Where the cube's texels are mixed, a direction's light bends by h^2/4 of half its second derivative at most, the filter's
# weights have eight bits of a texel's step, and at an edge the light is that of up to a quarter of a texel beside.
TEXEL = 2.0 / DIRECTIONS_SIZE
DIRECTION_BOUND = 0.5 * (0.25 * TEXEL + TEXEL**2 / 4 + FILTER * TEXEL) + 4 * U


def level_light(variance, d, values):
    """Light of the cube map `levels` with 50 digits."""
    place = min(max(exact_level(variance, d, values), mpf(0)), mpf(len(level_colours()) - 1))
    low = min(int(place), len(level_colours()) - 2)
    way = place - low
    first, second = (vector(level_colours()[n]) for n in (low, low + 1))
    return shader.plus(shader.scaled(first, 1 - way), shader.scaled(second, way))


def direction_light(d):
    return tuple(1 + x / 2 for x in normalised(d))


def look_up(cube, d, variance, values, angle, relative):
    """(light, bound, bound of halves): `angle` and `relative` are what direction and variance may be off by."""
    if cube == "flat":
        return (mpf(1),) * 3, 0.0, HALF
    if cube == "directions":
        wanted = direction_light(d)
        return wanted, DIRECTION_BOUND + 0.5 * angle[0], 0.5 * angle[1] + 1.5 * HALF
    wanted = level_light(variance, d, values)
    off = level_bound(float(variance), values) + FILTER
    # A level is 1/2 log2 of the variance, and its place between two levels at most 4/3 ln 2 times as steep.
    steep = 0.93 / math.log(2)
    return wanted, LEVEL_STEP * (off + steep * relative[0]) + 4 * U, LEVEL_STEP * steep * relative[1] + 2.5 * HALF


def sums(table, view, cube, values, to_space, roughness=0.0, anisotropy=0.0, visible=None):
    """Light, grazing light, albedo, grazing albedo, each (exact, bound, bound of halves). `visible` gives the share of a
    lobe that gets light, with its bound and that of halves, from the lobe and its mean in the environment's space."""
    _o, lobes = expect_lobes(table, view, roughness, anisotropy)
    totals = [np.zeros(3, dtype=object) + mpf(0), np.zeros(3, dtype=object) + mpf(0), mpf(0), mpf(0)]
    off = np.zeros((4, 2))
    for lobe in lobes:
        seen = to_space(lobe.mean)
        wanted, *bounds = look_up(cube, seen, lobe.variance, values, lobe.mean_bound, lobe.variance_bound)
        share, *share_off = visible(lobe, seen) if visible else (mpf(1), 0.0, 0.0)
        lit = np.array([share * t * w for t, w in zip(lobe.tint, wanted)], dtype=object)
        totals[0] += lobe.weight * lit
        totals[1] += lobe.grazing * lit
        totals[2] += lobe.weight
        totals[3] += lobe.grazing
        w, tint, x = float(lobe.weight), float(max(lobe.tint)), float(lobe.grazing)
        brightest = float(max(wanted))
        for n in (0, 1):
            tint_off = (lobe.tint_bound, 12 * HALF * table.second)[n]
            w_off = lobe.weight_bound[n] + (3 * U * w if n == 0 else 0.0)
            x_off = lobe.grazing_bound[n] + (3 * U * x if n == 0 else 0.0)
            # Of the light itself, and with the weight's.
            lit_off = float(share) * (tint * bounds[n] + tint_off * brightest) + share_off[n] * tint * brightest
            most = float(share) * tint * brightest
            off[:, n] += (w * lit_off + w_off * most, x * lit_off + x_off * most, w_off, x_off)
    off[:, 0] += 2 * U * len(lobes) * np.array([float(max(totals[0])), float(max(totals[1])), *map(float, totals[2:])])
    return totals, off


def fresnel(first, second, f0, f90, off):
    """f0 a + (f90 - f0) b: the exact sum and its bounds."""
    wanted = f0 * first + (f90 - f0) * second
    size = abs(f0) * abs(first) + abs(f90 - f0) * abs(second)
    bounds = [abs(float(f0)) * off[0][n] + abs(float(f90 - f0)) * off[1][n] for n in (0, 1)]
    return wanted, bounds[0] + 6 * U * float(size), bounds[1]


def expect_reflection(table, cube, values, row):
    normal, view = vector(row[:3]), vector(row[12:15])
    f0, f90 = vector(row[16:19]), mpf(row[19])
    # Rows of the turn to the environment, of which the light has the inverse.
    rotation = [vector(values["rotation"][3 * n : 3 * n + 3]) for n in range(3)]

    def turned(direction):
        return tuple(shader.dot(axis, direction) for axis in rotation)

    if table.isotropic:
        # Also where any tangent will do, it is that of the normal in the environment's space.
        normal, view = turned(normal), turned(view)
        tangent = shader.any_tangent(normal)
        axes = (tangent, shader.cross(normal, tangent), normal)
    else:
        axes = (vector(row[4:7]), vector(row[8:11]), normal)
    local = tuple(shader.dot(view, axis) for axis in axes)

    def to_environment(direction):
        seen = shader.columns_times(axes, direction)
        return seen if table.isotropic else turned(seen)

    totals, off = sums(table, local, cube, values, to_environment)
    checks, energy = [], mpf(values["energy"])
    for n in range(3):
        # lobelight_specular lets f90 be 1.
        wanted, bound, medium = fresnel(totals[0][n], totals[1][n], f0[n], mpf(1), off[:2])
        e = float(energy)
        checks.append(
            Near((n,), (wanted * energy,), bound * e + 2 * U * float(abs(wanted)) * e, "radiance", medium * e)
        )
    wanted, bound, medium = fresnel(totals[2], totals[3], f0[0], f90, off[2:])
    checks.append(Near((3,), (wanted,), bound, "share", medium))
    albedo = max(totals[2], mpf("0.05"))
    slope = 1 / float(albedo) ** 2
    bound = off[2][0] * slope + DIVISION / float(albedo) + 2 * U
    checks.append(Near((4,), (1 / albedo - 1,), bound, "share", off[2][1] * slope))
    if cube == "flat":
        checks.append(energy_of(checks[0]))
    return checks


def energy_of(near):
    wanted = near.exact[0]
    return Energy(near.at[0], wanted, near.bound / wanted, near.medium / wanted)


def reflection_probes(quick):
    """Every number of lobes: the shader adds them up by the digits of their number."""
    counts = (1, 3, 8) if quick else (*range(1, 9), 12, 15, 16, 17, 24, 31, 32)
    for count in counts:
        for long in (False, True):
            name = f"table_reflect_{count}_{'long' if long else 'round'}"
            alpha = (0.3, 0.05) if long else (0.15, 0.15)
            table = odd_table(name, count, 8, 4 if long else 0, alpha, count % 4 == 3, seed=100 + 2 * count + long)
            for cube in ("levels", "directions", "flat") if count in (1, 3, 8, 32) else ("levels", "flat"):
                # Turned and scaled where directions are told apart.
                rotation = tuple(tuple(single(c)) for c in turn(count))
                values = light(
                    1 if cube == "directions" else LEVELS_SIZE,
                    "disc",
                    0.5 if count % 2 else 0.0,
                    cube,
                    rotation,
                    1.0 if count % 2 else 0.75,
                )
                title = f"reflection of {count} lobes, {'two widths' if long else 'one width'}, {cube}"
                probe = Probe(
                    f"{name}_{cube}",
                    "shader reflection",
                    "reflect",
                    5,
                    partial(expect_reflection, table, cube, values),
                    light=values,
                )
                probe.defines, probe.uniforms, probe.has_medium = table.defines(), table.uniforms(), True
                probe.textures = {"lobelight_table": name}
                frames = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), turn(7)]
                for number, frame in enumerate(frames[: 1 if quick else 2]):
                    rows = []
                    for elevation in (0.0, 40.0, 89.0, 90.0, 110.0) if quick else (0.0, 1e-3, 20, 40, 70, 89, 90, 110):
                        if elevation == 0 and long and number:
                            continue  # the quadrant of such a view is a matter of its last bit
                        for azimuth in (25.0, 200.0):
                            local = view_at(elevation, azimuth)
                            view = [sum(frame[n][axis] * local[n] for n in range(3)) for axis in range(3)]
                            f = (0.04, 0.6, 1.0, 1.0) if azimuth < 100 else (1.0, 0.2, 0.0, 0.5)
                            rows.append((*frame[0], 0, *frame[1], 0, *frame[2], 0, *view, 0, *f))
                    # The shader takes the normal first.
                    rows = [(*r[8:12], *r[0:8], *r[12:]) for r in rows]
                    probe.add(f"{title}, frame {number}", rows)
                yield table, probe


# The coat


def expect_coat(table, cube, values, row):
    below, strength = vector(row[:3]), mpf(row[3])
    normal, view = vector(row[4:7]), vector(row[8:11])
    tangent = shader.any_tangent(normal)
    axes = (tangent, shader.cross(normal, tangent), normal)
    local = tuple(shader.dot(view, axis) for axis in axes)
    totals, off = sums(table, local, cube, values, lambda d: shader.columns_times(axes, d))
    # A refractive index of 1.5.
    f0 = mpf("0.04")
    share, share_off, share_medium = fresnel(totals[2], totals[3], f0, mpf(1), off[2:])
    checks = []
    for n in range(3):
        light_n, light_off, light_medium = fresnel(totals[0][n], totals[1][n], f0, mpf(1), off[:2])
        wanted = below[n] * (1 - strength * share) + strength * light_n
        s, b = float(strength), float(abs(below[n]))
        bound = s * (share_off * b + light_off) + 4 * U * (b + s * float(abs(light_n)))
        checks.append(Near((n,), (wanted,), bound, "radiance", s * (share_medium * b + light_medium)))
    return checks


def coat_probes(quick):
    table = odd_table("table_coat", 4, 16, 0, (0.05, 0.05), seed=208)
    for cube in ("levels", "directions"):
        values = light(LEVELS_SIZE if cube == "levels" else 1, "disc", 0.0, cube)
        probe = Probe(f"coat_{cube}", "shader coat", "coat", 3, partial(expect_coat, table, cube, values), light=values)
        probe.has_medium = True
        lookup = table.lookup()
        probe.textures = {"lobelight_coat_table": table.name}
        probe.uniforms = {"lobelight_coat_lookup": (lookup[0], lookup[1], lookup[3])}
        rows = []
        for frame in (((1, 0, 0), (0, 1, 0), (0, 0, 1)), turn(9)):
            for elevation in (0.0, 30.0, 89.0, 91.0) if quick else (0.0, 10.0, 30.0, 50.0, 70.0, 89.0, 91.0):
                local = view_at(elevation, 77.0)
                view = [sum(frame[n][axis] * local[n] for n in range(3)) for axis in range(3)]
                rows += [(0.5, 2.0, 0.0, s, *frame[2], 0, *view, 0) for s in (0.0, 0.3, 1.0)]
        probe.add(f"coat, {cube}", rows)
        yield table, probe


# The sheen


def expect_sheen(table, cube, values, row):
    below, colour = vector(row[:3]), vector(row[4:7])
    normal, view = vector(row[8:11]), vector(row[12:15])
    tangent = shader.any_tangent(normal)
    axes = (tangent, shader.cross(normal, tangent), normal)
    local = tuple(shader.dot(view, axis) for axis in axes)
    totals, off = sums(table, local, cube, values, lambda d: shader.columns_times(axes, d))
    share, share_off, share_medium = fresnel(totals[2], totals[3], mpf(1), mpf(1), off[2:])
    kept = 1 - max(colour) * min(share, mpf(1))
    most = float(max(colour))
    checks = []
    for n in range(3):
        light_n, light_off, light_medium = fresnel(totals[0][n], totals[1][n], mpf(1), mpf(1), off[:2])
        reflected = colour[n] * light_n / max(share, mpf(1))
        size, tint = float(abs(below[n])), float(colour[n])
        seen = float(abs(light_n))
        bound = tint * (light_off + seen * share_off) + most * share_off * size
        bound += (6 * U + DIVISION) * (size + tint * seen)
        medium = tint * (light_medium + seen * share_medium) + most * share_medium * size
        checks.append(Near((n,), (below[n] * kept + reflected,), bound, "radiance", medium))
    return checks


def sheen_probes(quick):
    table = odd_table("table_sheen", 4, 16, 0, (0.4, 0.4), seed=300)
    for cube in ("levels", "directions"):
        values = light(LEVELS_SIZE if cube == "levels" else 1, "disc", 0.0, cube)
        probe = Probe(
            f"sheen_{cube}", "shader sheen", "sheen", 3, partial(expect_sheen, table, cube, values), light=values
        )
        probe.has_medium = True
        lookup = table.lookup()
        probe.textures = {"lobelight_sheen_table": table.name}
        probe.uniforms = {
            "lobelight_sheen_lookup": (lookup[0], lookup[1], lookup[3]),
        }
        rows = []
        for frame in (((1, 0, 0), (0, 1, 0), (0, 0, 1)), turn(9)):
            for elevation in (0.0, 30.0, 89.0, 91.0) if quick else (0.0, 10.0, 30.0, 50.0, 70.0, 89.0, 91.0):
                local = view_at(elevation, 77.0)
                view = [sum(frame[n][axis] * local[n] for n in range(3)) for axis in range(3)]
                for colour in ((1.0, 1.0, 1.0), (0.8, 0.3, 0.0)):
                    rows.append((0.5, 2.0, 0.0, 0.0, *colour, 0.0, *frame[2], 0, *view, 0))
        probe.add(f"sheen, {cube}", rows)
        yield table, probe


# Diffuse light


def expect_diffuse(cube, values, row):
    frame = [vector(row[4 * n : 4 * n + 3]) for n in range(3)]
    variance, along, aside = shader.cosine_lobes()
    wanted = np.zeros(3, dtype=object) + mpf(0)
    bound = medium = 0.0
    for n in range(6):
        angle = n * shader.mp.pi / 3
        tilt = shader.plus(
            shader.scaled(frame[0], aside * shader.mp.cos(angle)), shader.scaled(frame[1], aside * shader.mp.sin(angle))
        )
        d = shader.plus(shader.scaled(frame[2], along), tilt)
        # The constants have six digits.
        seen, off, half = look_up(cube, d, variance, values, (2e-6 + 8 * U, 0.0), (8e-6, 0.0))
        wanted += np.array(seen, dtype=object) / 6
        bound, medium = bound + off / 6, medium + half / 6
    return [Near((n,), (wanted[n],), bound + 10 * U * 3, "radiance", medium) for n in range(3)]


def diffuse_probes(quick):
    for cube in ("levels", "directions"):
        values = light(LEVELS_SIZE if cube == "levels" else 1, "disc", 0.0, cube)
        probe = Probe(
            f"diffuse_{cube}", "shader diffuse", "diffuse", 3, partial(expect_diffuse, cube, values), light=values
        )
        probe.has_medium = True
        frames = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), *map(turn, range(4 if quick else 40))]
        for number, frame in enumerate(frames):
            probe.add(f"diffuse {cube}, frame {number}", [[x for column in frame for x in (*column, 0.0)]])
        yield probe


def probes(quick):
    """(tables, probes)."""
    with_tables = [*reflection_probes(quick), *coat_probes(quick), *sheen_probes(quick)]
    tables = list({table.name: table for table, _probe in with_tables}.values())
    return tables, [*(p for _table, p in with_tables), *diffuse_probes(quick)]


