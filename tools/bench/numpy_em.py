"""Expectation maximisation for mixtures of von Mises–Fisher densities on the sphere, in NumPy.

Twice: `textbook` as one writes it down from the equations (Banerjee et al. 2005, "Clustering on the unit hypersphere
using von Mises–Fisher distributions", section 4, for weighted samples, with the exact sharpness of three dimensions),
vectorised over samples and lobes; and `tuned`, which computes the same numbers with arrays laid out for NumPy's inner
loops, the exponent's dot products and the moments in one matrix product each, and every large array written in place.

Lobes are rows of (weight, mean x, y, z, kappa).
"""

import numpy as np

# Rounding leaves a lobe of one sample with 1 − R̄ around 1e-16.
MAX_KAPPA = 1e8
MIN_WEIGHT = 1e-12


def sharpness(one_minus_r):
    """κ (K,) of the densities whose mean vectors have length 1 − one_minus_r (K,): Newton's method on
    coth κ − 1/κ = R̄ from Banerjee's approximation; 1/(1 − R̄) where coth κ is 1 to the last bit."""
    r = 1.0 - one_minus_r
    kappa = r * (3.0 - r * r) / (1.0 - r * r)
    for _ in range(5):
        value = 1.0 / np.tanh(kappa) - 1.0 / kappa
        kappa = kappa - (value - r) / (1.0 - value * value - 2.0 * value / kappa)
    kappa = np.where(one_minus_r < 0.05, 1.0 / np.maximum(one_minus_r, 1.0 / MAX_KAPPA), kappa)
    return np.clip(kappa, 0.0, MAX_KAPPA)


def log_normalisation(kappa):
    """ln κ/(2π(1 − e^{−2κ})) (K,): the density is this times e^{κ(μ·x − 1)}."""
    return np.log(kappa / (-2.0 * np.pi * np.expm1(-2.0 * kappa)))


def textbook(directions, weights, start, max_iterations, tolerance):
    """EM from `start` (K, 5) for samples `directions` (N, 3) of mass `weights` (N,).

    Stops after max_iterations, or when an iteration raises the log-likelihood (mean over the mass, in nats) by less
    than `tolerance`. Returns lobes (K, 5) whose weights sum to `weights`' and the iterations.
    """
    mass = weights.sum()
    w = weights / mass
    share, mean, kappa = start[:, 0] / start[:, 0].sum(), start[:, 1:4], start[:, 4]
    previous = -np.inf
    iterations = 0
    while True:
        log_density = np.log(share) + log_normalisation(kappa) + kappa * (directions @ mean.T - 1.0)
        largest = log_density.max(axis=1, keepdims=True)
        term = np.exp(log_density - largest)
        total = term.sum(axis=1, keepdims=True)
        log_likelihood = w @ (largest + np.log(total))[:, 0]
        if iterations == max_iterations or log_likelihood - previous < tolerance:
            break
        previous = log_likelihood
        responsibility = w[:, None] * term / total
        share = np.maximum(responsibility.sum(axis=0), MIN_WEIGHT)
        resultant = responsibility.T @ directions
        length = np.linalg.norm(resultant, axis=1)
        mean = resultant / length[:, None]
        kappa = sharpness(1.0 - length / share)
        iterations += 1
    return np.column_stack([mass * share, mean, kappa]), iterations


def tuned(directions, weights, start, max_iterations, tolerance):
    """As textbook(), to the same numbers up to rounding."""
    mass = weights.sum()
    w = weights / mass
    samples = np.ascontiguousarray(np.vstack([directions.T, np.ones(len(w))]))  # (4, N)
    share, mean, kappa = start[:, 0] / start[:, 0].sum(), start[:, 1:4], start[:, 4]
    term = np.empty((len(start), len(w)))
    largest, total = np.empty(len(w)), np.empty(len(w))
    factors = np.empty((len(start), 4))
    previous = -np.inf
    iterations = 0
    while True:
        factors[:, :3] = kappa[:, None] * mean
        factors[:, 3] = np.log(share) + log_normalisation(kappa) - kappa
        np.matmul(factors, samples, out=term)
        np.max(term, axis=0, out=largest)
        term -= largest
        np.exp(term, out=term)
        np.sum(term, axis=0, out=total)
        log_likelihood = w @ (largest + np.log(total))
        if iterations == max_iterations or log_likelihood - previous < tolerance:
            break
        previous = log_likelihood
        term *= np.divide(w, total, out=total)
        moments = term @ samples.T
        share = np.maximum(moments[:, 3], MIN_WEIGHT)
        length = np.linalg.norm(moments[:, :3], axis=1)
        mean = moments[:, :3] / length[:, None]
        kappa = sharpness(1.0 - length / share)
        iterations += 1
    return np.column_stack([mass * share, mean, kappa]), iterations
