"""Judges whole tables: the fit, what half floats make of it, and the library's own look-up between the views."""

import math
from dataclasses import dataclass

import mpmath as mp

import exact
import exact_shader as shader
from exact import mpf
from verdict import ENERGY_BOUNDS, Verdict, reference_albedo, relative, rows

# Means in standard deviations of their lobe; only lobes with at least this share of the energy count.
COUNTED_SHARE = 1e-3

# From this width on, lobes of isotropic models are differences, and some may have weights below 0 (fit/wide_lobes.h).
LEAST_WIDE_WIDTH = 0.25
# What their weights then have in all, over their sum: of 7 views, with 24 nodes an axis, up to 5.
MOST_TAKEN = 6.0

# Half floats: (mean in radians, sharpness relative, energy relative). 2^-11 of a slope turns the half-vector by less than
# 2^-11 and the mean by twice that; log2 kappa < 32 is stored in steps of 2^-6.
HALF_BOUNDS = 2.0**-10, 2.0**-7, 1e-3


def storage_error(entries, stored, alpha, o):
    """Over the lobes that count: worst error of means (in radians, in standard deviations) and of sharpness, and the
    energy's error."""
    total = math.fsum(entry[3] for entry in entries)
    radians = widths = kappa_error = 0.0
    for entry, other in zip(entries, stored):
        if not entry[3] >= COUNTED_SHARE * total:
            continue
        mean, kappa, cosine = exact.decode(entry, alpha, o)
        if cosine < exact.LEAST_O_DOT_H:
            continue
        off = float(exact.distance(exact.decode(other, alpha, o)[0], mean))
        radians = max(radians, off)
        widths = max(widths, off * math.sqrt(max(kappa, 0.25)))
        kappa_error = max(kappa_error, abs(math.expm1((other[2] - entry[2]) * math.log(2))))
    energy = abs(math.fsum(entry[3] for entry in stored) / total - 1.0) if total > 0.0 else 0.0
    return radians, widths, kappa_error, energy


def table_albedos(record):
    """Reference albedo of every view of the grid; at the pole all azimuths are one."""
    for x, y, z in rows(record["views"], 3):
        elevation = math.degrees(math.atan2(math.hypot(x, y), z))
        azimuth = math.degrees(math.atan2(y, x)) if elevation > 0.0 else 0.0
        yield reference_albedo(record["brdf"], tuple(record["alpha"]), round(elevation, 9), round(azimuth, 9))


def judge_table(record):
    """One case for the fit, one for half floats, one for looking up between the views."""
    fit = Verdict(record, "table")
    lobes = record["lobes"]
    entries = [rows(view, 4) for view in rows(record["entries"], 4 * lobes)]
    fit.finite(record["entries"], "an entry")
    fit.finite(record["log_likelihood"], "a log-likelihood")
    fit.require(record["iterations"] <= record["iteration_limit"], "EM passed its limit of iterations")
    fit.result["seconds"] = record["seconds"]
    if not fit.result["finite"]:
        return [fit.done()]
    bound = ENERGY_BOUNDS[record["nodes_per_axis"]]
    widths = [float(width) for width in exact.vector(record["alpha"])]
    takes_away = widths[0] == widths[1] >= LEAST_WIDE_WIDTH
    for view, wanted in zip(entries, table_albedos(record)):
        if takes_away:
            weights = [entry[3] for entry in view]
            fit.require(math.fsum(map(abs, weights)) < MOST_TAKEN * math.fsum(weights), "lobes take too much away")
        else:
            fit.require(min(entry[3] for entry in view) >= 0.0, "a weight is negative")
        error = abs(math.fsum(entry[3] for entry in view) / wanted - 1.0)
        fit.energy(error, bound)
        fit.error(error, bound, "albedo")
    results = [fit.done()]

    alpha = exact.vector(record["alpha"])
    views = [exact.normalised(exact.vector(o)) for o in rows(record["views"], 3)]
    stored = Verdict({**record, "name": f"{record['name']} as half"}, "storage half")
    stored.finite(record["half"], "an entry")
    if stored.result["finite"]:
        worst_widths = 0.0
        for view, other, o in zip(entries, rows(record["half"], 4 * lobes), views):
            radians, widths, kappa, energy = storage_error(view, rows(other, 4), alpha, o)
            stored.error(radians, HALF_BOUNDS[0], "radians")
            stored.error(kappa, HALF_BOUNDS[1], "relative kappa")
            stored.energy(energy, HALF_BOUNDS[2])
            worst_widths = max(worst_widths, widths)
        stored.result["standard_deviations"] = worst_widths
    results.append(stored.done())

    between = Verdict({**record, "name": f"{record['name']} looked up"}, "look-up")
    between.finite(record["interpolated"], "an interpolated lobe")
    if between.result["finite"]:
        judge_look_up(between, record, lobes, alpha)
    results.append(between.done())
    return results


# The library's look-up, in double precision: views and what is between two entries are off by a few times 2^-52, but next to
# the last view the column, in [0, 1], is the root of such a difference.
ROUNDING = 1e-12
COLUMN_ROUNDING = 4e-8
# Of the lobes that are looked up, every so many directions and lobes are compared.
LOOK_UP_STEPS = {True: (9, 7), False: (1, 3)}


def judge_look_up(verdict, record, lobes, alpha):
    direction_step, lobe_step = LOOK_UP_STEPS[record["nodes_per_axis"] < 64]
    table = Entries(record)
    directions = rows(record["directions"], 3)
    found = rows(record["interpolated"], 5 * lobes)
    for direction, mixture in list(zip(directions, found))[::direction_step]:
        o = exact.normalised(exact.vector(direction))
        for k, lobe in list(enumerate(rows(mixture, 5)))[::lobe_step]:
            mean, kappa, weight, cosine, steps = table.lobe(k, o, alpha)
            if cosine <= exact.LEAST_O_DOT_H:
                continue  # no reflection
            off = [ROUNDING + COLUMN_ROUNDING * (table.columns - 1) * step for step in steps]
            angle = off[0] * float(alpha[0]) + off[1] * float(alpha[1])
            verdict.error(float(exact.distance(exact.vector(lobe[1:4]), mean)), 2 * angle + ROUNDING, "radians")
            bound = off[2] + (angle + ROUNDING) / float(cosine)
            verdict.error(relative(lobe[4], kappa), bound, "relative kappa")
            verdict.error(float(abs(lobe[0] - weight)), off[3], "weight")


@dataclass
class Entries:
    """The entries of a record, read between its views with 50 digits."""

    record: dict

    def __post_init__(self):
        self.columns, self.rows = map(int, self.record["grid"])
        lobes = self.record["lobes"]
        self.views = [rows(view, 4) for view in rows(self.record["entries"], 4 * lobes)]

    def read(self, k, column, row):
        t, p = (min(int(mp.floor(x)), last - 1) for x, last in ((column, self.columns), (row, self.rows)))
        f, g = column - t, row - p
        sums = [mpf(0)] * 4
        for dt, dp, share in ((0, 0, (1 - f) * (1 - g)), (1, 0, f * (1 - g)), (0, 1, (1 - f) * g), (1, 1, f * g)):
            if share != 0:
                entry = self.views[min(p + dp, self.rows - 1) * self.columns + min(t + dt, self.columns - 1)][k]
                sums = [s + share * mpf(e) for s, e in zip(sums, entry)]
        return sums

    def lobe(self, k, raw, alpha):
        """(mean, kappa, weight, cosine, how much each number of the entry changes from column to column)."""
        o = exact.clamp_view(raw)
        column = shader.column(o[2]) * (self.columns - 1)
        if self.rows == 1:
            sine = mp.hypot(o[0], o[1])
            x = (o[0] / sine, o[1] / sine) if sine > 0 else (mpf(1), mpf(0))
            axes = (x[0], x[1], mpf(0)), (-x[1], x[0], mpf(0))
            row = mpf(0)
        else:
            sides = [mpf(-1) if x < 0 else mpf(1) for x in o[:2]]
            axes = (sides[0], mpf(0), mpf(0)), (mpf(0), sides[1], mpf(0))
            row = shader.quadrant_angle(o[0], o[1]) / (mp.pi / 2) * (self.rows - 1)
        entry = self.read(k, column, row)
        half_vectors = (shader.scaled(axes[0], alpha[0]), shader.scaled(axes[1], alpha[1]), (mpf(0), mpf(0), mpf(1)))
        mean, variance, cosine = shader.lobe(entry, half_vectors, o)
        next_column = min(int(column) + 1, self.columns - 1)
        ends = [self.read(k, mpf(at), row) for at in (next_column - 1, next_column)]
        return mean, 1 / variance, entry[3], cosine, [float(abs(a - b)) for a, b in zip(*ends)]
