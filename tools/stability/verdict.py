"""What a judged case is, and what all judges need.

Each case becomes a dictionary with at least
    name, group, finite, within_energy_bound, energy_error, error, error_bound, iterations, passed, reason
and those of the shaders renderer and precision ("single", or "half" where mediump was rounded).
`error` is the largest deviation from the reference in the unit that `unit` names; energy errors are relative to the
albedo and null where there is no energy. Bounds stand beside the judges that use them, with the reason for their size.
"""

import math
from functools import cache

import albedo as quadrature
from exact import mpf

# A slice's albedo against the quadrature: 0.5 % for the 64² nodes that tables are fitted with. Fewer nodes are less.
ENERGY_BOUNDS = {64: 5e-3, 32: 1e-2, 24: 2e-2}


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
        error = float(error)
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


@cache
def reference_albedo(brdf, alpha, elevation, azimuth):
    value, error = quadrature.directional_albedo(brdf, alpha, elevation, azimuth)
    if not error <= 1e-6 * value:
        raise ArithmeticError(f"the quadrature of {brdf} {alpha} at {elevation}, {azimuth} does not converge")
    return value


def broken(group, reason):
    """A case for a group that did not run to its end."""
    verdict = Verdict({"name": f"{group}, the whole group"}, group)
    verdict.require(False, reason)
    return verdict.done()
