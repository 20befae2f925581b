"""Judges functions at points: spherical Gaussians, reflectances, and the shader's formulas in single precision."""

import math

import mpmath as mp

import exact
from exact import mpf
from verdict import Verdict, relative, rows

# Spherical Gaussians in double precision.
GAUSSIAN_BOUNDS = {
    # Relative to the logarithm where it is above 1: the exponent's rounding.
    "log density": 1e-14,
    "density": 1e-14,
    "coverage": 1e-13,
    "mean resultant": 1e-14,
    # Of κ itself; 1 − R̄ is exact input.
    "kappa from resultant": 1e-12,
    # In standard deviations of the lobe: opposite to the mean the sine is the root of a rounded difference.
    "sample": 3e-8,
}
# ∫ g dω by the driver's 8000 nodes.
INTEGRAL_BOUND = 1e-9

# The shader's formulas in single precision: means in radians, the rest relative to what it is computed from. Columns of
# the grid are square roots: next to the last view an elevation's 1e-7 is 3e-4 of the grid.
FLOAT_BOUNDS = {"decode": 1e-6, "level": 1e-4, "position": 1e-3}


def brdf_bound(alpha, cosine):
    """Values and densities relative to their logarithm's size; weights relative to max(weight, 1).

    A unit vector of doubles is off by 2^-53; the half-vector's slope by that over 2 cos θ, and what counts is the slope
    over alpha; o·h = |i + o|/2 by that over |i + o|², which is about cos² θ where it is smallest.
    """
    return 1e-14 + 64 * 2.0**-53 / (min(alpha) * cosine) + 2.0**-53 / cosine**2


# Spherical Gaussians


def log_error(own, exact_log):
    """|log own − log exact| over the size of the logarithm."""
    return float(abs(mp.log(mpf(own)) - exact_log) / max(mpf(1), abs(exact_log)))


def gaussian_errors(record):
    function, kappa = record["function"], mpf(record["kappa"])
    values = record["values"]
    if function in ("log density", "density"):
        for row in rows(values, 7):
            wanted = exact.log_density(exact.vector(row[:3]), kappa, exact.vector(row[3:6]))
            if function == "log density":
                yield float(abs(mpf(row[6]) - wanted) / max(mpf(1), abs(wanted)))
            elif wanted < -690:
                # Below e^-690 the density underflows to denormals or zero.
                yield 0.0 if row[6] <= 1e-299 else math.inf
            else:
                yield log_error(row[6], wanted) if row[6] > 0 else math.inf
    elif function == "coverage":
        for share, own in rows(values, 2):
            yield relative(own, exact.coverage_one_minus_cosine(kappa, mpf(share)))
    elif function == "mean resultant":
        yield relative(values[0], exact.one_minus_mean_resultant(kappa))
    elif function == "kappa from resultant":
        yield relative(values[1], exact.kappa_from_one_minus_mean_resultant(mpf(values[0])))
    else:
        width = mp.sqrt(max(kappa, mpf(1)))
        for row in rows(values, 8):
            wanted = exact.sample_gaussian(row[:3], kappa, row[3], row[4])
            yield float(exact.distance(exact.vector(row[5:8]), wanted) * width)


def judge_gaussian(record):
    verdict = Verdict(record, "gaussian")
    verdict.result["function"] = record["function"]
    verdict.finite(record["values"], "a value")
    if verdict.result["finite"]:
        unit = "standard deviations" if record["function"] == "sample" else "relative"
        verdict.error(max(gaussian_errors(record)), GAUSSIAN_BOUNDS[record["function"]], unit)
    if "integral" in record:
        verdict.energy(abs(record["integral"] - 1.0), INTEGRAL_BOUND)
    return verdict.done()


# Reflectances


def judge_brdf(record):
    verdict = Verdict(record, "brdf")
    name, alpha, o = record["brdf"], exact.vector(record["alpha"]), exact.vector(record["o"])
    bound = brdf_bound(record["alpha"], record["o"][2])
    above = 0
    for row in rows(record["values"], 9):
        if not math.isfinite(row[4]):
            verdict.require(math.isnan(row[4]) and math.isnan(row[2]), "an infinite sample")
            continue
        above += 1
        weight, pdf, value, density = row[2], row[3], row[7], row[8]
        verdict.finite(row, "a value")
        verdict.require(min(weight, pdf, value, density) >= 0.0, "a negative value")
        i = exact.vector(row[4:7])
        verdict.require(abs(float(exact.norm(i)) - 1.0) < 1e-14, "a direction is not of unit length")
        wanted = exact.reflectance(name, alpha, i, o)
        wanted_density = exact.sampling_density(name, alpha, i, o)
        for own, reference in ((value, wanted), (density, wanted_density)):
            if reference > mpf(10) ** -290:
                verdict.error(log_error(own, mp.log(reference)), bound, "relative")
        wanted_weight = wanted * i[2] / wanted_density
        verdict.error(float(abs(weight - wanted_weight) / max(mpf(1), wanted_weight)), bound, "relative")
    verdict.require(above > 0, "no sample is above the horizon")
    return verdict.done()


# Single precision


def judge_shader(record):
    verdict = Verdict(record, "shader")
    function = record["function"]
    verdict.result["function"] = function
    verdict.finite(record["values"], "a value")
    if not verdict.result["finite"]:
        return verdict.done()
    bound = FLOAT_BOUNDS[function]
    worst_widths = 0.0
    if function == "decode":
        alpha, o = exact.vector(record["alpha"]), exact.clamp_view(exact.vector(record["o"]))
        for row in rows(record["values"], 9):
            mean, kappa, cosine = exact.decode(row[:3], alpha, o)
            if cosine < exact.LEAST_O_DOT_H:
                continue  # no reflection: finite is all that counts
            off = float(exact.distance(exact.vector(row[3:6]), mean))
            verdict.error(off, bound, "radians")
            # o·h is a sum of products of size 1: its error is absolute.
            verdict.error(float(abs(row[6] * kappa - 1) * min(mpf(1), cosine)), bound, "variance")
            worst_widths = max(worst_widths, off * float(mp.sqrt(kappa)))
        verdict.result["standard_deviations"] = worst_widths
    elif function == "level":
        before = -1.0
        for n, (variance, x, y, z, own) in enumerate(rows(record["values"], 5)):
            d = exact.normalised(exact.vector((x, y, z)))
            wanted = exact.level(mpf(variance), d, *exact.vector(record["level"]))
            verdict.error(float(abs(own - wanted)), bound, "levels")
            verdict.require(own >= 0.0, "a level is negative")
            if n % 3 == 0:
                verdict.require(own >= before - bound, "wider lobes are looked up at finer levels")
                before = own
    else:
        columns, azimuths = record["views"]
        for x, y, z, column, row in rows(record["values"], 5):
            o = exact.clamp_view(exact.vector((x, y, z)))
            sine = mp.hypot(o[0], o[1])
            rest = max(1 - mp.atan2(sine, o[2]) / mp.radians(mpf("89.4")), mpf(0))
            wanted = (1 - mp.sqrt(rest)) * (columns - 1)
            verdict.error(float(abs(column - wanted)) / max(columns - 1, 1), bound, "of the grid")
            if azimuths > 1 and sine > 1e-3:
                turn = mp.atan2(abs(o[1]), abs(o[0])) / (mp.pi / 2) * (azimuths - 1)
                verdict.error(float(abs(row - turn)) / (azimuths - 1), bound, "of the grid")
    return verdict.done()
