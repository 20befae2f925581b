"""Judges the native cases: what lobelight_stability printed against 50 digits and against independent quadrature.

Each case becomes a dictionary with at least
    name, group, finite, within_energy_bound, energy_error, error, error_bound, iterations, passed, reason
`error` is the largest deviation from the reference in the unit that `unit` names; energy errors are relative to the
albedo and null where there is no energy. The bounds below are the suite's contract: each says why it is what it is.
"""

import math
import sys
from functools import lru_cache

import mpmath as mp
import numpy as np

import albedo as quadrature
import exact
from exact import mpf

# Rounding. Sums of up to 4096 terms, 32 lobes.
SUM_ROUNDING = 1e-12
# Log-likelihood, relative: EM may not lower it by more than its own rounding.
LIKELIHOOD_FALL = 1e-9

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

    A unit vector of doubles is off by 2^-53, the half-vector's slope by that over 2 cos θ, and what counts is the slope
    over alpha.
    """
    return 1e-14 + 64 * 2.0**-53 / (min(alpha) * cosine)


# One step of EM on 256 nodes: weights absolute, means in standard deviations, sharpnesses and log-likelihood relative.
STEP_BOUND = 1e-9

# A slice's albedo against the quadrature: 0.5 % for the 64² nodes that tables are fitted with. Fewer nodes are less.
ENERGY_BOUNDS = {64: 5e-3, 32: 1e-2, 24: 2e-2}

# The shader's formulas in single precision: means in radians, the rest relative to what it is computed from.
FLOAT_BOUNDS = {"decode": 1e-6, "level": 1e-4, "position": 1e-4}

# Tables as they are stored, read by the shader's formulas. Means in standard deviations of their lobe; only lobes with
# at least this share of the energy count.
COUNTED_SHARE = 1e-3


def is_finite(value):
    if isinstance(value, (list, tuple)):
        return all(map(is_finite, value))
    return not isinstance(value, float) or math.isfinite(value)


def rows(values, width):
    return [values[n : n + width] for n in range(0, len(values), width)]


def relative(own, reference):
    if reference == 0:
        return 0.0 if own == 0 else math.inf
    return float(abs(mpf(own) - reference) / abs(reference))


class Verdict:
    """Collects what is wrong with a case."""

    def __init__(self, record, group):
        self.reasons = []
        self.result = {
            "name": record["name"],
            "group": group,
            "finite": True,
            "within_energy_bound": True,
            "energy_error": None,
            "energy_bound": None,
            "error": 0.0,
            "error_bound": 0.0,
            "unit": "",
            "iterations": record.get("iterations", 0),
        }
        for key in ("brdf", "alpha", "elevation", "azimuth", "lobes", "nodes_per_axis", "fit_error", "kappa", "method"):
            if key in record:
                self.result[key] = record[key]

    def require(self, condition, reason):
        if not condition:
            self.reasons.append(reason)

    def finite(self, values, what):
        if not is_finite(values):
            self.result["finite"] = False
            self.reasons.append(f"{what} is not finite")

    def energy(self, error, bound):
        """The worst of several calls is kept."""
        before = self.result["energy_error"]
        if before is None or not error / bound <= before / self.result["energy_bound"]:
            self.result["energy_error"], self.result["energy_bound"] = float(error), float(bound)
        if not error <= bound:
            self.result["within_energy_bound"] = False
            self.reasons.append(f"energy is off by {float(error):.2g}, more than {bound:.2g}")

    def error(self, error, bound, unit):
        if not error / bound <= self.result["error"] / (self.result["error_bound"] or math.inf):
            self.result.update(error=float(error), error_bound=float(bound), unit=unit)
        elif not self.result["unit"]:
            self.result.update(error_bound=float(bound), unit=unit)
        if not error <= bound:
            self.reasons.append(f"error {float(error):.2g} ({unit}), more than {bound:.2g}")

    def done(self):
        self.result["passed"] = not self.reasons
        self.result["reason"] = "; ".join(dict.fromkeys(self.reasons))
        return self.result


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


# Mixtures


def check_mixture(verdict, record, total, kappa_max=1e8):
    """What holds for every mixture that EM returns."""
    lobes = rows(record["mixture"], 5)
    verdict.finite(record["mixture"], "a lobe")
    verdict.require(record["log_likelihood_finite"], "a log-likelihood is not finite")
    if record["log_likelihood_finite"]:
        verdict.require(record["largest_fall"] <= LIKELIHOOD_FALL, f"the likelihood falls by {record['largest_fall']:.2g}")
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


@lru_cache(maxsize=None)
def reference_albedo(brdf, alpha, elevation, azimuth):
    value, error = quadrature.directional_albedo(brdf, alpha, elevation, azimuth)
    if not error <= 1e-6 * value:
        raise ArithmeticError(f"the quadrature of {brdf} {alpha} at {elevation}, {azimuth} does not converge")
    return value


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
        sums = [sum((mpf(n[3]) * exact.normalised(exact.vector(n[:3]))[axis] for n in nodes), mpf(0)) for axis in range(3)]
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
            wanted = mp.atan2(sine, o[2]) / mp.radians(mpf("89.4")) * (columns - 1)
            verdict.error(float(abs(column - wanted)) / max(columns - 1, 1), bound, "of the grid")
            if azimuths > 1 and sine > 1e-3:
                turn = mp.atan2(abs(o[1]), abs(o[0])) / (mp.pi / 2) * (azimuths - 1)
                verdict.error(float(abs(row - turn)) / (azimuths - 1), bound, "of the grid")
    return verdict.done()


# Tables and their storage



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


JUDGES = {
    "gaussian": judge_gaussian,
    "brdf": judge_brdf,
    "step": judge_step,
    "slice": judge_slice,
    "data": judge_data,
    "shader": judge_shader,
    "table": judge_table,
}


def judge(group, record):
    """The verdicts of one record."""
    if "exception" in record and group != "data":
        verdict = Verdict(record, group)
        verdict.require(False, f"threw: {record['exception']}")
        return [verdict.done()]
    result = JUDGES[group](record)
    return result if isinstance(result, list) else [result]
