"""Probes of lobelight.gdshaderinc, by which shaders of one's own are lit: also with what nobody should ask for.

The functions are held against sums() over a set's lobes with 50 digits, as materials are, and in white light with lines
of lobes against shader_line.py. There is one truth besides that knows nothing of lobes: what reflects all light (f0 is 1)
is as bright as a white environment, whatever its widths and its tangent.
"""

import math
from dataclasses import dataclass
from functools import partial

import exact_shader as shader
import numpy as np
import shader_line
from about import About
from exact import clamp_view, dot, mpf, norm, normalised, vector
from probe_textures import LEVELS_SIZE
from probes import U, Energy, Holds, Near, Probe, single
from shader_frames import NAN, projection
from shader_light import expect_diffuse, sums
from shader_material import channels, fresnel, lost_share, rotation_to
from shader_points import light, turn, view_at
from shader_tables import odd_table
from shader_widths import log2, set_levels

# The most lobes of a line, and from which ratio and width on there is one, as runtime/material/line_choice.gd has them.
LINE = 24
RATIOS, NARROW, WIDE, NARROWEST, WIDEST = (3.0, 3.6), 0.06, 0.1, 0.001, 1.0
# Where lines are grazed, cancelling costs more digits than shader_line.SHARE has.
LINE_ELEVATION = 75.0
# Of a line's share in the light: the logarithms' errors times how steep the fades are.
FADE = 2e-5
# Above 1: tables' weights may add up to a little more.
MOST = 1.15


@dataclass(eq=False)
class Own:
    """What a shader of one's own is compiled and lit with."""

    name: str
    table: object
    cube: str
    has_line: bool = False
    # The lights of shader_placed.py that it is among; none for one light everywhere.
    rooms: int | None = None

    def defines(self):
        # What the file defines itself is not to be defined twice.
        names = [name for name in self.table.defines() if name != "LOBELIGHT_WIDTHS_PER_PIXEL"]
        names += ["LOBELIGHT_PLACED"] * (self.rooms is not None)
        return (*names, f"LOBELIGHT_QUALITY {LINE if self.has_line else 8}")

    def uniforms(self):
        values = self.table.uniforms()
        if self.has_line:
            values |= {"lobelight_line_widths": line_widths(), "lobelight_line_fade": line_fade()}
        return values


def line_widths():
    return tuple(single([math.log2(NARROWEST), math.log2(WIDEST)]))


def line_fade():
    by_ratio, by_width = 1 / math.log2(RATIOS[1] / RATIOS[0]), 1 / math.log2(NARROW / WIDE)
    return tuple(single([by_ratio, -by_ratio * math.log2(RATIOS[0]), by_width, -by_width * math.log2(WIDE)]))


def frame_about(normal, tangent):
    """(tangent, bitangent, normal); none for a tangent whose direction is a matter of its last bits."""
    across = None
    if all(map(math.isfinite, tangent)):
        across = shader.minus(vector(tangent), shader.scaled(normal, dot(normal, vector(tangent))))
        square = float(dot(across, across))
        if square < 1e-12:
            across = None
        elif square < 1e-3 * float(norm(vector(tangent))) ** 2:
            return None
    t = normalised(across) if across else shader.any_tangent(normal)
    return t, shader.cross(normal, t), normal


def about_line(own, axes, view, row):
    """(share of the line, light, grazing light) in white light, or None where it is grazed; all of them About."""
    logarithms = [log2(a) for a in shader.widths(mpf(row[3]), mpf(row[7]))]
    local = [dot(view, axis) for axis in axes]
    if row[7] < 0:
        logarithms, local[:2] = logarithms[::-1], (-local[1], local[0])
    fade = line_fade()
    by_ratio = (logarithms[0] - logarithms[1]) * mpf(fade[0]) + mpf(fade[1])
    by_width = logarithms[1] * mpf(fade[2]) + mpf(fade[3])
    share = min(max(by_ratio, mpf(0)), mpf(1)) * min(max(by_width, mpf(0)), mpf(1))
    if share == 0:
        return About(mpf(0)), About(mpf(0)), About(mpf(0))
    if row_elevation(row) > LINE_ELEVATION:
        return None
    low, high = line_widths()
    alpha = [2.0 ** min(max(float(x), low), high) for x in logarithms]
    o = [float(x) for x in clamp_view(local)]
    ratio = max(alpha) / min(alpha)
    used = min(2 * ratio + 4, 0.8 * ratio + 16, LINE)
    albedo = grazing = 0.0
    for number in range(LINE):
        i, _variance, weight = shader_line.lobe("ggx", used, o, alpha, number, LINE)
        cosine = math.sqrt(max(0.5 + 0.5 * sum(a * b for a, b in zip(i, o)), 0.0))
        albedo += weight
        grazing += weight * float(shader.schlick(cosine))
    off = shader_line.SHARE * albedo + LINE * 1e-6
    return About(share, FADE), About(mpf(albedo), off), About(mpf(grazing), shader_line.SHARE * 5 * grazing + off)


def expect_placed(row, renderer):
    """Among lights whose shares make up one at least, all of them white."""
    energy = mpf(is_seen(row, renderer))
    checks = [Holds(partial(within, MOST * float(energy) + 1e-12))]
    if energy:
        white = [at for at in range(9) if at // 3 == 1 or row[12 + at % 3] == 1.0]
        checks += [Energy(at, energy, 2e-5, 1e-3) for at in white]
    return checks


def is_seen(row, renderer):
    """Whether it is no lightmap that asks."""
    if renderer == "gl_compatibility":
        return row[28 + 10] > 0
    return row[28 + 15] <= 0.5 or row[28 + 5] < 0


def row_elevation(row):
    view = (0.0, 0.0, 1.0) if row[28 + 15] > 0.5 else row[8:11]
    return math.degrees(math.acos(min(max(sum(a * b for a, b in zip(view, row[:3])), -1.0), 1.0)))


def reflect(own, axes, camera, view, values, row):
    """The sums over the lobes, or None where they are not to be told."""
    if own.table.isotropic:
        normal = shader.columns_times(camera, axes[2])
        tangent = shader.any_tangent(normal)
        axes = tangent, shader.cross(normal, tangent), normal
        view = shader.columns_times(camera, view)
        camera = [vector(c) for c in np.eye(3)]
    local = tuple(dot(view, axis) for axis in axes)

    def to_environment(direction):
        return shader.columns_times(camera, shader.columns_times(axes, direction))

    found = channels(*sums(own.table, local, own.cube, values, to_environment, row[3], row[7]))
    if not own.has_line:
        return found
    line = about_line(own, axes, view, row)
    if line is None:
        return None
    share, albedo, grazing = line
    rest = About(mpf(1)) - share
    lines = [albedo] * 3, [grazing] * 3, albedo, grazing

    def mixed(a, b):
        return rest * a + share * b

    both = [[mixed(a, b) for a, b in zip(found[n], lines[n])] for n in (0, 1)]
    return *both, mixed(found[2], lines[2]), mixed(found[3], lines[3])


def expect_own(own, values, row, renderer):
    parallel = row[28 + 15] > 0.5
    normal = vector(row[:3])
    view = (mpf(0), mpf(0), mpf(1)) if parallel else vector(row[8:11])
    camera = [vector(row[16 + 4 * n : 19 + 4 * n]) for n in range(3)]
    metallic, specular = mpf(row[11]), mpf(row[15])
    seen = is_seen(row, renderer)
    energy = mpf(values["energy"]) if seen else mpf(0)
    most = MOST * float(energy) * brightest(own.cube) + 1e-12
    checks = [Holds(partial(within, most))]
    colour = [About(x) for x in vector(row[12:15])]
    if own.cube == "flat" and seen:
        # The furnace: also what scatters all that it does not reflect.
        checks += [Energy(at, energy, 1e-5, 1e-3) for at in range(9) if at // 3 != 1 and row[12 + at % 3] == 1.0]
    axes = frame_about(normal, row[4:7])
    if axes is None:
        return checks
    there = [x for axis in axes for x in (*shader.columns_times(camera, axis), 0)]
    arriving = [About(mpf(d.exact[0]), d.bound, d.medium) for d in expect_diffuse(own.cube, values, there)]
    reflection = reflect(own, axes, camera, view, values, row)
    f0 = About(mpf("0.16") * specular**2, 4 * U)
    f90 = About(min(50 * f0.value, mpf(1)), 200 * U)
    for c in range(3):
        checks.append(told(3 + c, arriving[c] * energy))
        if reflection is None:
            continue
        lost = lost_share(reflection[2])
        metal = fresnel(reflection[0][c], reflection[1][c], colour[c], About(mpf(1))) * (1 + colour[c] * lost)
        other = fresnel(reflection[0][c], reflection[1][c], f0, f90) * (1 + f0 * lost)
        share = fresnel(reflection[2], reflection[3], f0, f90) * (1 + f0 * lost)
        left = (About(mpf(1)) - share).clamped(0, 1e9)
        sent = other * About(1 - metallic, U) + metal * metallic
        sent = sent + left * About(1 - metallic, U) * colour[c] * arriving[c]
        checks.append(told(c, metal * energy))
        checks.append(told(6 + c, sent * energy))
    return checks


def within(most, results):
    """Neither below 0 nor above what there is."""
    return max(-min(results), max(results) - most, 0.0), 1e-5 + 1e-4 * most, "radiance"


def brightest(cube):
    return {"flat": 1.0, "directions": 1.5, "levels": 3.0}[cube]


def told(at, radiance):
    return Near((at,), (radiance.value,), radiance.off + 1e-9, "radiance", radiance.half)


ROUGHNESSES = [0.0, 0.3, 1.0, -1.0, 1.5]
# (roughness, anisotropy)
WIDTHS = [(0.0, 1.0), (0.3, 0.0), (0.3, 1.0), (0.4, -1.0), (1.0, 0.5), (-1.0, -0.3), (1.5, 1.1), (0.5, 50.0), (0.5, -9.0)]
LINES = [(0.15, 1.1), (0.25, 0.95), (0.3, 0.98), (0.2, -8.0), (0.0, 1.0), (0.35, 0.9), (1.0, 1.0), (2.0, 50.0)]


def tangents(frame):
    """Sound ones, then none: across the normal, of any length and leaning; zero, along the normal, NaN and infinite."""
    t, b, n = (np.array(column) for column in frame)
    sound = [t, 300 * (0.6 * t + 0.8 * b), -0.01 * b, t + 0.7 * n]
    return [*sound, 0 * t, n, -3 * n, 1e-9 * t, np.full(3, NAN), np.array([NAN, 1, 0]), np.array([math.inf, 0, 0])]


def fill(probe, own, quick):
    widths = [(r, 0.0) for r in ROUGHNESSES]
    if not own.table.isotropic:
        widths = LINES if own.has_line else WIDTHS
    elevations = [0.02, 40.0, 89.9, 90.0, 110.0] if quick else [0.02, 1.0, 20.0, 40.0, 60.0, 75.0, 89.0, 89.9, 90.0, 91.0, 110.0]
    if own.cube == "flat":
        elevations = [0.0, *elevations[1:], 180.0]
    colours = [(1.0, 0.5, 0.0, 0.5), (0.0, 1.0, 0.04, 1.0), (0.25, 0.75, 1.0, 0.0)]
    number, places = 0, np.random.default_rng(43)
    for roughness, anisotropy in widths:
        rows = []
        for elevation in elevations:
            for some in range(2 if quick else 4):
                number += 1
                local = view_at(elevation, 20.0 + 77.0 * number)
                parallel = number % 5 == 4
                frame = turn(60 + number % 3)
                if parallel:
                    # Parallel projections look along z.
                    frame = [tuple(column) for column in rotation_to(local)]
                view = [sum(frame[n][axis] * local[n] for n in range(3)) for axis in range(3)]
                normal = single(frame[2])
                choices = tangents([*frame[:2], normal])
                place = places.uniform(-4, 4, 3) if own.rooms is not None else (0.0, 0.0, 0.0)
                camera = [x for column, at in zip(turn(number % 4), place) for x in (*column, at)]
                rows.append(
                    (
                        *(*normal, roughness, *choices[number % len(choices)], anisotropy),
                        *(*view, (0.0, 1.0, 0.3)[number % 3], *colours[(number + some) % 3]),
                        *(*camera, *projection(parallel, number % 10 != 9)),
                    )
                )
        shown = f"roughness {roughness:g}" + ("" if own.table.isotropic else f" anisotropy {anisotropy:g}")
        where = "" if own.rooms is None else f", {('one room', 'four lights')[own.rooms]}"
        probe.add(f"own shader, {own.name}, {own.cube}{where}, {shown}", rows)


def probes(quick):
    """(tables, probes)."""
    nine = set_levels(0.01, 1.0, 9)
    round_set = odd_table("table_own_round", 4, 8, 0, levels=nine, seed=401)
    long_set = odd_table("table_own_long", 4, 8, 4, levels=nine, seed=402)
    made = []
    for own in (
        Own("round", round_set, "levels"),
        Own("round", round_set, "flat"),
        Own("long", long_set, "directions"),
        Own("long", long_set, "flat"),
        Own("lines", long_set, "flat", has_line=True),
        Own("round", round_set, "flat", rooms=0),
        Own("lines", long_set, "flat", has_line=True, rooms=1),
    ):
        is_placed = own.rooms is not None
        values = light(1 if own.cube == "directions" else LEVELS_SIZE, "disc", 0.0, own.cube, energy=0.75)
        probe = Probe(
            f"own_{own.name}_{own.cube}" + (f"_placed_{own.rooms}" if is_placed else ""),
            "shader own",
            "own",
            9,
            expect_placed if is_placed else partial(expect_own, own, values),
            light=None if is_placed else values,
            by_renderer=True,
            has_medium=True,
        )
        probe.defines, probe.uniforms = own.defines(), own.uniforms()
        probe.textures = {"lobelight_table": own.table.name}
        if is_placed:
            probe.textures |= {"lobelight_lights": f"placed_{own.rooms}_list", "lobelight_environment": own.cube}
        fill(probe, own, quick)
        made.append(probe)
    return [round_set, long_set], made
