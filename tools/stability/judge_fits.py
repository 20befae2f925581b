"""Judges EM: single steps against 50 digits, fits of slices, and data that are hardly data."""

import math
import sys

import mpmath as mp

import exact
from exact import mpf
from verdict import ENERGY_BOUNDS, Verdict, reference_albedo, relative, rows

# Rounding. Sums of up to 4096 terms, 32 lobes.
SUM_ROUNDING = 1e-12
# Log-likelihood, relative: EM may not lower it by more than its own rounding.
LIKELIHOOD_FALL = 1e-9

# One step of EM on 256 nodes: weights absolute, means in standard deviations, sharpnesses and log-likelihood relative.
STEP_BOUND = 1e-9


# Mixtures


def check_mixture(verdict, record, total, kappa_max=1e8):
    """What holds for every mixture that EM returns."""
    lobes = rows(record["mixture"], 5)
    verdict.finite(record["mixture"], "a lobe")
    verdict.require(record["log_likelihood_finite"], "a log-likelihood is not finite")
    if record["log_likelihood_finite"]:
        verdict.require(
            record["largest_fall"] <= LIKELIHOOD_FALL, f"the likelihood falls by {record['largest_fall']:.2g}"
        )
    verdict.require(record["iterations"] <= record["iteration_limit"], "EM passed its limit of iterations")
    if not verdict.result["finite"]:
        return
    for weight, x, y, z, kappa in lobes:
        verdict.require(weight >= 0.0, "a weight is negative")
        verdict.require(0.0 <= kappa <= kappa_max, "a sharpness is out of range")
        verdict.require(abs(math.sqrt(x * x + y * y + z * z) - 1.0) < 1e-12, "a mean is not of unit length")
    own = math.fsum(lobe[0] for lobe in lobes)
    # Denormal numbers have no relative precision: each weight may be off by their spacing.
    slack = len(lobes) * 5e-324
    verdict.energy(max(0.0, abs(own - total) - slack) / total if total > 0.0 else abs(own), SUM_ROUNDING)


def as_mixture(values, total):
    return [(mpf(w) / mpf(total), m, k) for w, *m, k in rows(values, 5)]


def judge_step(record):
    verdict = Verdict(record, "step")
    nodes = rows(record["slice"], 4)
    total = sum((mpf(n[3]) for n in nodes), mpf(0))
    check_mixture(verdict, record, record["albedo"], record["kappa_max"])
    if not verdict.result["finite"]:
        return verdict.done()
    start = as_mixture(record["start"], sum(mpf(v) for v in record["start"][::5]))
    likelihood = exact.log_likelihood(nodes, start)
    verdict.error(relative(record["log_likelihood"][0], likelihood), STEP_BOUND, "relative")
    wanted = exact.em_step(nodes, start, record["weight_floor"], record["kappa_max"])
    for (weight, mean, kappa), row in zip(wanted, rows(record["mixture"], 5)):
        verdict.error(float(abs(row[0] / total - weight)), STEP_BOUND, "share")
        if weight < 1e-10:
            continue
        verdict.error(relative(row[4], kappa), STEP_BOUND, "relative kappa")
        off = exact.distance(exact.normalised(exact.vector(row[1:4])), mean) * mp.sqrt(max(kappa, mpf(1)))
        verdict.error(float(off), STEP_BOUND, "standard deviations")
    return verdict.done()


# Slices


def judge_slice(record):
    verdict = Verdict(record, "slice")
    verdict.require(record["nodes"] > 0, "the slice has no node")
    numbers = [record[key] for key in ("albedo", "least_node", "largest_node", "fit_error") if key in record]
    verdict.finite(numbers, "the slice")
    verdict.require(record.get("least_node", 0.0) > 0.0, "a node's weight is not positive")
    check_mixture(verdict, record, record["albedo"])
    # So few nodes that lobes outnumber them are no quadrature: only the mixture's own energy counts.
    if record["nodes_per_axis"] in ENERGY_BOUNDS:
        wanted = reference_albedo(record["brdf"], tuple(record["alpha"]), record["elevation"], record["azimuth"])
        bound = ENERGY_BOUNDS[record["nodes_per_axis"]]
        error = abs(record["albedo"] / wanted - 1.0)
        verdict.energy(error, bound)
        verdict.error(error, bound, "albedo")
        verdict.result["albedo"] = wanted
    return verdict.done()


# Awkward data


def counts(node):
    """The library's rule: finite positive weight, finite direction of unit length within 1e-6."""
    x, y, z, weight = node
    return (
        math.isfinite(weight)
        and weight > 0.0
        and all(map(math.isfinite, (x, y, z)))
        and abs(x * x + y * y + z * z - 1.0) <= 1e-6
    )


def judge_data(record):
    verdict = Verdict(record, "data")
    nodes = [node for node in rows(record["slice"], 4) if counts(node)] if "slice" in record else []
    total = sum((mpf(node[3]) for node in nodes), mpf(0))
    # Refused with a sentence: means that are no directions, sums that are no numbers. Nothing else is.
    to_be_refused = record.get("start_name") == "NaN mean" or total > sys.float_info.max
    if "exception" in record or to_be_refused:
        verdict.require("exception" in record, "was to be refused")
        verdict.require(to_be_refused, f"was refused: {record.get('exception')}")
        verdict.result["refused"] = record.get("exception")
        return verdict.done()
    check_mixture(verdict, record, float(total))
    if "expected_albedo" in record:
        verdict.energy(relative(record["albedo"], mpf(record["expected_albedo"])), SUM_ROUNDING)
    if total == 0 or not verdict.result["finite"]:
        return verdict.done()
    if record["lobes"] == 1:
        # The closed form: the direction of the mean vector, and κ of its length. Where the vectors cancel the direction
        # is free.
        sums = [
            sum((mpf(n[3]) * exact.normalised(exact.vector(n[:3]))[axis] for n in nodes), mpf(0)) for axis in range(3)
        ]
        length = exact.norm(sums) / total
        kappa = mpf(1e8)
        if length < 1 - mpf(10) ** -30:
            kappa = min(kappa, exact.kappa_from_one_minus_mean_resultant(1 - length))
        row = record["mixture"]
        verdict.error(float(abs(row[4] - kappa) / max(kappa, mpf(1))), STEP_BOUND, "relative kappa")
        if length > 1e-6:
            off = exact.distance(exact.normalised(exact.vector(row[1:4])), exact.normalised(sums))
            verdict.error(float(off * mp.sqrt(max(kappa, mpf(1)))), STEP_BOUND, "standard deviations")
    return verdict.done()
