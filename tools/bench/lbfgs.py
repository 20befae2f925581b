"""Least squares by L-BFGS-B, as Wang et al. 2009, "All-frequency rendering of dynamic, spatially-varying reflectance",
fit spherical Gaussians.

The squared error ∫ (m − f)² di / ∫ f² di over the slice's own nodes; bounds keep weights and sharpnesses positive. The
variables are scaled to the start so that the solver meets a well-conditioned problem: weights in units of the albedo,
ln κ, and means by their offset in the start's tangent plane in units of the start's standard deviation 1/√κ.
"""

import numpy as np
from scipy.optimize import minimize


class Problem:
    """Objective and gradient for one slice: `directions` (N, 3), masses `weights` (N,), `values` (N,) of ρ i_z."""

    def __init__(self, directions, weights, values, start):
        self.count = len(start)
        self.samples = np.ascontiguousarray(directions.T)  # (3, N)
        self.values = values
        solid_angles = weights / values
        self.factors = solid_angles / (solid_angles @ values**2)
        self.albedo = start[:, 0].sum()
        self.mean = start[:, 1:4]
        self.width = 1.0 / np.sqrt(start[:, 4])
        # Two unit vectors that span each start's tangent plane, (K, 3) each.
        other = np.where(np.abs(self.mean[:, 2:]) < 0.9, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
        self.u = np.cross(other, self.mean)
        self.u /= np.linalg.norm(self.u, axis=1, keepdims=True)
        self.v = np.cross(self.mean, self.u)
        self.start = np.column_stack(
            [start[:, 0] / self.albedo, np.log(start[:, 4]), np.zeros((self.count, 2))]
        ).ravel()
        self.bounds = [(0.0, None), (np.log(1e-3), np.log(1e8)), (None, None), (None, None)] * self.count

    def lobes(self, variables):
        """Rows of (weight, mean x, y, z, kappa)."""
        weight, log_kappa, p, q = variables.reshape(self.count, 4).T
        mean = self.mean + self.width[:, None] * (p[:, None] * self.u + q[:, None] * self.v)
        mean /= np.linalg.norm(mean, axis=1, keepdims=True)
        return np.column_stack([self.albedo * weight, mean, np.exp(log_kappa)])

    def __call__(self, variables):
        weight, log_kappa, p, q = variables.reshape(self.count, 4).T
        kappa = np.exp(log_kappa)
        raw = self.mean + self.width[:, None] * (p[:, None] * self.u + q[:, None] * self.v)
        length = np.linalg.norm(raw, axis=1)
        mean = raw / length[:, None]
        tail = np.exp(-2.0 * kappa)
        normalisation = kappa / (2.0 * np.pi * -np.expm1(-2.0 * kappa))
        # Densities (K, N), and cos − 1.
        below = mean @ self.samples
        below -= 1.0
        density = kappa[:, None] * below
        np.exp(density, out=density)
        density *= normalisation[:, None]
        residual = (self.albedo * weight) @ density
        residual -= self.values
        weighted = self.factors * residual
        error = weighted @ residual

        density *= weighted  # its sums are what every derivative is made of
        by_weight = density.sum(axis=1)
        pulled = density @ self.samples.T  # (K, 3)
        below *= density
        amount = 2.0 * self.albedo * weight
        # d ln normalisation / dκ = 1/κ − 2 e^{−2κ}/(1 − e^{−2κ})
        slope = 1.0 / kappa - 2.0 * tail / -np.expm1(-2.0 * kappa)
        by_kappa = amount * (slope * by_weight + below.sum(axis=1))
        by_mean = (amount * kappa)[:, None] * pulled
        # Only what is across the mean turns it.
        by_mean -= (by_mean * mean).sum(axis=1, keepdims=True) * mean
        by_mean *= (self.width / length)[:, None]
        gradient = np.column_stack(
            [
                2.0 * self.albedo * by_weight,
                kappa * by_kappa,
                (by_mean * self.u).sum(axis=1),
                (by_mean * self.v).sum(axis=1),
            ]
        )
        return error, gradient.ravel()


def fit(directions, weights, values, start, max_iterations=15000, visited=None):
    """Lobes (K, 5), iterations and evaluations. `visited`, a list, receives the lobes after every iteration."""
    problem = Problem(directions, weights, values, start)
    callback = None if visited is None else lambda x: visited.append(problem.lobes(x))
    result = minimize(
        problem,
        problem.start,
        jac=True,
        method="L-BFGS-B",
        bounds=problem.bounds,
        callback=callback,
        options={"maxiter": max_iterations, "maxfun": 10 * max_iterations},
    )
    return problem.lobes(result.x), int(result.nit), int(result.nfev)
