"""The fitter beside its rivals on the same slices, nodes and starts: one process, one thread each, one clock.

Every method is timed by processor time, the best of its repetitions. Rivals that iterate are timed twice: by their own
stopping rule, and stopped at the first iteration whose slice error is no greater than the fitter's.
"""

import time
from dataclasses import dataclass

import numpy as np
from scipy.stats import vonmises_fisher

import lbfgs
import numpy_em
from slice_error import FineSlice

LOBES = 8
NODES_PER_AXIS = 64
MATERIALS = [("ward", (0.1, 0.1)), ("ward", (0.05, 0.2)), ("ward", (0.01, 0.2)), ("ggx", (0.1, 0.1))]
VIEWS = [(0.0, 0.0), (40.0, 30.0), (60.0, 70.0), (75.0, 10.0), (85.0, 45.0)]  # degrees

# The fitter as it bakes tables: EmOptions' own limits.
OUR_ITERATIONS, OUR_TOLERANCE = 200, 1e-6
# Where it gets about as far as EM without acceleration does by its rule.
OUR_QUICK_TOLERANCE = 1e-5
# The stopping rule of EM without acceleration; so many iterations where an error is to be reached.
EM_ITERATIONS, EM_TOLERANCE = 200, 1e-7
REACH_ITERATIONS = 600
# Attributes of slice_error.Errors, and 1 where less is better.
METRICS = {"l1": 1, "l2": 1, "log_likelihood": -1}


@dataclass
class Run:
    """One method on one slice. seconds: processor time; errors: slice_error.Errors."""

    lobes: np.ndarray
    iterations: int
    seconds: float
    errors: object


def direction(elevation, azimuth):
    theta, phi = np.radians([elevation, azimuth])
    return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])


def timed(work, repetitions):
    """What work() gives, and the least processor time of its repetitions."""
    best = np.inf
    for _ in range(repetitions):
        start = time.process_time()
        result = work()
        best = min(best, time.process_time() - start)
    return result, best


class Contest:
    """All methods on one slice."""

    def __init__(self, fitter, of, repetitions):
        self.fitter, self.of, self.repetitions = fitter, of, repetitions
        self.fine = FineSlice(fitter, of)
        self.start = fitter.start(of, LOBES)
        self.values = fitter.evaluate(of, of.directions)

    def run(self, work, repetitions=None):
        (lobes, iterations), seconds = timed(work, repetitions or self.repetitions)
        return Run(lobes, int(iterations), seconds, self.fine.errors(lobes))

    def ours(self, tolerance=OUR_TOLERANCE):
        of = self.of
        return self.run(
            lambda: self.fitter.em(of, self.start, OUR_ITERATIONS, tolerance), 4 * self.repetitions
        )

    def ours_plain(self):
        of = self.of
        return self.run(
            lambda: self.fitter.em(of, self.start, EM_ITERATIONS, EM_TOLERANCE, accelerate=False)
        )

    def numpy(self, method, iterations=EM_ITERATIONS, tolerance=EM_TOLERANCE, repetitions=None):
        of = self.of
        return self.run(
            lambda: method(of.directions, of.weights, self.start, iterations, tolerance), repetitions
        )

    def lbfgs(self, iterations=15000, repetitions=None):
        of = self.of

        def work():
            return lbfgs.fit(of.directions, of.weights, self.values, self.start, iterations)[:2]

        return self.run(work, repetitions)

    def first_to_reach(self, places, target):
        """For each metric of `target` (Errors) the first iteration among `places`, pairs of iteration and lobes, that
        is as good, or None."""
        first = dict.fromkeys(METRICS)
        for iteration, lobes in places:
            errors = self.fine.errors(lobes)
            for metric, sign in METRICS.items():
                if first[metric] is None and sign * getattr(errors, metric) <= sign * getattr(target, metric):
                    first[metric] = iteration
            if None not in first.values():
                break
        return first

    def places_of_em(self):
        """EM's lobes at more and more iterations. The C++ EM without acceleration makes the same iterations as
        NumPy's, in less time."""
        lobes, done = self.start, 0
        for step in [1] * 10 + [2] * 20 + [5] * 30 + [10] * ((REACH_ITERATIONS - 200) // 10):
            lobes = self.fitter.em(self.of, lobes, step, -1.0, accelerate=False)[0]
            done += step
            yield done, lobes

    def places_of_lbfgs(self):
        visited = []
        lbfgs.fit(self.of.directions, self.of.weights, self.values, self.start, visited=visited)
        for iteration, lobes in enumerate(visited, start=1):
            if iteration <= 60 or iteration % 5 == 0 or iteration == len(visited):
                yield iteration, lobes

    def one_lobe(self):
        """SciPy's fit knows no weights: it is given as many equal samples as there are nodes, drawn from the slice
        by its weights; ours the nodes themselves. Seconds of SciPy's and of ours, and both κ."""
        of = self.of
        places = (np.arange(len(of.weights)) + 0.5) / len(of.weights)
        chosen = np.searchsorted(np.cumsum(of.weights) / of.weights.sum(), places)
        samples = of.directions[np.minimum(chosen, len(of.weights) - 1)]
        start = self.fitter.start(of, 1)
        (_, kappa), theirs = timed(lambda: vonmises_fisher.fit(samples), self.repetitions)
        (lobes, _), ours = timed(
            lambda: self.fitter.em(of, start, OUR_ITERATIONS, OUR_TOLERANCE), 4 * self.repetitions
        )
        return {"scipy_seconds": theirs, "our_seconds": ours, "scipy_kappa": float(kappa), "our_kappa": float(lobes[0, 4])}


def describe(run):
    return {
        "iterations": run.iterations,
        "seconds": run.seconds,
        "l1_percent": run.errors.l1,
        "l2_percent": run.errors.l2,
        "log_likelihood": run.errors.log_likelihood,
    }


def compare(fitter, quick, report):
    """Rows for every slice; report(row) is called after each."""
    materials = MATERIALS[1:2] if quick else MATERIALS
    views = VIEWS[1:3] if quick else VIEWS
    repetitions = 1 if quick else 3
    rows = []
    for brdf, alpha in materials:
        for elevation, azimuth in views:
            of = fitter.slice(brdf, alpha, direction(elevation, azimuth), NODES_PER_AXIS)
            contest = Contest(fitter, of, repetitions)
            ours = contest.ours()
            runs = {
                "ours": ours,
                "ours_quick": contest.ours(OUR_QUICK_TOLERANCE),
                "ours_not_accelerated": contest.ours_plain(),
                "numpy_textbook": contest.numpy(numpy_em.textbook, repetitions=1 if quick else 2),
                "numpy_tuned": contest.numpy(numpy_em.tuned),
                "lbfgs": contest.lbfgs(repetitions=1 if quick else 2),
            }
            row = {"slice": of.name(), "nodes": len(of.weights), "runs": {k: describe(r) for k, r in runs.items()}}
            by_em = contest.first_to_reach(contest.places_of_em(), ours.errors)
            by_lbfgs = contest.first_to_reach(contest.places_of_lbfgs(), ours.errors)
            reached = {
                "numpy_textbook": (by_em, lambda n, c=contest: c.numpy(numpy_em.textbook, n, -1.0, 1)),
                "numpy_tuned": (by_em, lambda n, c=contest: c.numpy(numpy_em.tuned, n, -1.0)),
                "lbfgs": (by_lbfgs, contest.lbfgs),
            }
            row["as_good_as_ours"] = {
                name: {metric: describe(again(n)) if n else None for metric, n in first.items()}
                for name, (first, again) in reached.items()
            }
            row["one_lobe"] = contest.one_lobe()
            rows.append(row)
            report(row)
    return rows
