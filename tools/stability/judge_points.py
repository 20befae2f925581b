"""Judges functions at points: spherical Gaussians and reflectances."""

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
