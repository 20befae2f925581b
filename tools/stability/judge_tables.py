"""Judges whole tables: the fit, what each form of storage makes of it, and looking up between the views."""

import math

import mpmath as mp
import numpy as np

import exact
from exact import mpf
from verdict import ENERGY_BOUNDS, Verdict, reference_albedo, relative, rows

# Tables as they are stored, read by the shader's formulas. Means in standard deviations of their lobe; only lobes with
# at least this share of the energy count.
COUNTED_SHARE = 1e-3


def storage_bounds(form, record):
    """(mean in radians, sharpness relative, energy relative).

    float: rounding of the shader's formulas.
    half: 2^-11 of a slope turns the half-vector by less than 2^-11 and the mean by twice that; log2 κ < 32 is stored in
    steps of 2^-6.
    byte: half a step of 8 α/255 along each axis, twice that for the mean; half a step of log2 κ over the table's range,
    which is at most 37.
    """
    if form == "float":
        return 2e-6, 2e-5, 1e-6
    if form == "half":
        return 2.0**-10 + 2e-6, 2.0**-7, 1e-3
    return 2 * math.hypot(*record["alpha"]) * 4 / 255 + 2e-6, 2 ** (37 / 510) - 1 + 2e-5, 1e-6


BYTE_SLOPE = 4.0


def sharpness(row, o):
    """κ (o·h), which is what a texel holds: the half-vector is at half the angle between mean and view."""
    half = mp.sqrt(max(mpf(0), (1 + exact.dot(exact.normalised(exact.vector(row[1:4])), o)) / 2))
    return mpf(row[4]) * half


def storage_error(form, entries, decoded, alpha, o):
    """Over the lobes that count: worst error of means (in radians, in standard deviations) and of sharpness, the
    energy's error, and the share of the energy that is in lobes beyond the range of bytes."""
    total = math.fsum(entry[3] for entry in entries)
    radians = widths = kappa_error = beyond = 0.0
    for entry, row in zip(entries, decoded):
        if not entry[3] >= COUNTED_SHARE * total:
            continue
        mean, kappa, cosine = exact.decode(entry, alpha, o)
        if cosine < exact.LEAST_O_DOT_H:
            continue
        if form == "byte" and max(abs(entry[0]), abs(entry[1])) > BYTE_SLOPE:
            beyond += entry[3] / total
            continue
        off = float(exact.distance(exact.normalised(exact.vector(row[1:4])), mean))
        radians = max(radians, off)
        widths = max(widths, off * math.sqrt(max(kappa, 0.25)))
        kappa_error = max(kappa_error, relative(sharpness(row, o), kappa * cosine))
    energy = abs(math.fsum(row[0] for row in decoded) / total - 1.0) if total > 0.0 else 0.0
    return radians, widths, kappa_error, energy, beyond


def table_albedos(record):
    """Reference albedo of every view of the grid; at the pole all azimuths are one."""
    for x, y, z in rows(record["views"], 3):
        elevation = math.degrees(math.atan2(math.hypot(x, y), z))
        azimuth = math.degrees(math.atan2(y, x)) if elevation > 0.0 else 0.0
        yield reference_albedo(record["brdf"], tuple(record["alpha"]), round(elevation, 9), round(azimuth, 9))


def judge_table(record):
    """One case for the fit, one for each storage, one for looking up between the views."""
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
    for view, wanted in zip(entries, table_albedos(record)):
        fit.require(min(entry[3] for entry in view) >= 0.0, "a weight is negative")
        error = abs(math.fsum(entry[3] for entry in view) / wanted - 1.0)
        fit.energy(error, bound)
        fit.error(error, bound, "albedo")
    results = [fit.done()]

    alpha = exact.vector(record["alpha"])
    views = [exact.normalised(exact.vector(o)) for o in rows(record["views"], 3)]
    for form in ("float", "half", "byte"):
        mean_bound, kappa_bound, energy_bound = storage_bounds(form, record)
        stored = Verdict({**record, "name": f"{record['name']} as {form}"}, f"storage {form}")
        stored.finite(record[form], "a lobe")
        worst_widths = worst_beyond = 0.0
        if stored.result["finite"]:
            for view, decoded, o in zip(entries, rows(record[form], 5 * lobes), views):
                radians, widths, kappa, energy, beyond = storage_error(form, view, rows(decoded, 5), alpha, o)
                stored.error(radians, mean_bound, "radians")
                stored.error(kappa, kappa_bound, "relative kappa")
                stored.energy(energy, energy_bound)
                worst_widths, worst_beyond = max(worst_widths, widths), max(worst_beyond, beyond)
        stored.result["standard_deviations"] = worst_widths
        if form == "byte":
            stored.result["beyond_range"] = worst_beyond
        results.append(stored.done())

    between = Verdict({**record, "name": f"{record['name']} looked up"}, "look-up")
    between.finite(record["interpolated"], "an interpolated lobe")
    between.finite(record["looked_up"], "a lobe")
    if between.result["finite"]:
        between.error(*look_up_error(record, lobes))
    results.append(between.done())
    return results


# Radians: the column is off by 1e-4 of the grid in single precision, and neighbouring entries differ by a few α.
LOOK_UP_BOUND = 2e-3


def look_up_error(record, lobes):
    wanted = np.array(record["interpolated"]).reshape(-1, lobes, 5)
    found = np.array(record["looked_up"]).reshape(-1, lobes, 5)
    off = np.linalg.norm(wanted[:, :, 1:4] - found[:, :, 1:4], axis=-1)
    return float(off.max()), LOOK_UP_BOUND, "radians"
