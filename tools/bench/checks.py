"""What the comparison takes for granted, checked at the beginning of each run of it."""

import numpy as np
from scipy.optimize import approx_fprime

import lbfgs
import numpy_em
from slice_error import FineSlice


class CheckError(Exception):
    """Says in one sentence which of them does not hold."""


def same_em(fitter, of, start):
    """Both NumPy versions and the C++ EM without acceleration make the same iterations."""
    expected, _ = fitter.em(of, start, 20, -1.0, accelerate=False)
    for method in (numpy_em.textbook, numpy_em.tuned):
        found, _ = method(of.directions, of.weights, start, 20, -1.0)
        difference = float(np.max(np.abs(found / expected - 1.0)))
        # The dot products of the textbook lose digits where lobes are narrow.
        if not difference < 1e-5:
            raise CheckError(f"{method.__name__} differs from the C++ EM by {difference:.1e}.")


def right_gradient(fitter, of, start):
    problem = lbfgs.Problem(of.directions, of.weights, fitter.evaluate(of, of.directions), start)
    place = problem.start + 0.1 * np.sin(np.arange(len(problem.start)))
    place[0::4] = np.maximum(place[0::4], 0.01)
    _, gradient = problem(place)
    numeric = approx_fprime(place, lambda x: problem(x)[0], 1e-7)
    difference = float(np.max(np.abs(gradient - numeric)) / np.max(np.abs(numeric)))
    if not difference < 1e-4:
        raise CheckError(f"the gradient of the squared error is wrong by {difference:.1e}.")


def fine_enough(fitter, of, lobes):
    """The quadrature of errors: what it says of the slice and of the lobes stays when it is made finer, and it
    integrates the lobes to their weights."""
    coarse, fine = FineSlice(fitter, of), FineSlice(fitter, of, resolution=448)
    first, second = coarse.errors(lobes), fine.errors(lobes)
    mass = fine.solid_angles @ fine.mixture(lobes) / lobes[:, 0].sum()
    for name, difference in {
        "L1": first.l1 / second.l1 - 1.0,
        "L2": first.l2 / second.l2 - 1.0,
        "albedo": coarse.albedo / of.weights.sum() - 1.0,
        "mass": mass - 1.0,
    }.items():
        if not abs(difference) < 5e-3:
            raise CheckError(f"the quadrature of errors is not fine enough: {name} changes by {difference:.1e}.")


def check(fitter, of, lobes):
    start = fitter.start(of, lobes)
    same_em(fitter, of, start)
    right_gradient(fitter, of, start)
    fine_enough(fitter, of, fitter.em(of, start, 200, 1e-6)[0])
