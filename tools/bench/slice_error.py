"""How far a mixture is from a slice, on a quadrature that is nobody's nodes.

Polar coordinates in the plane of half-vector slopes divided by alpha, where slices and lobes are smooth: i is the
reflection of o at h = (α_x s_x, α_y s_y, 1)/|…|, di = 4 (o·h) h_z³ α_x α_y ds; every i but −o comes from one h. The
midpoint rule in the angle and in r/(r + SCALE).
"""

from dataclasses import dataclass

import numpy as np

SCALE = 1.5


@dataclass(frozen=True)
class Errors:
    """l1 = ∫|m − f| / ∫f, l2 = √(∫(m − f)² / ∫f²), both in per cent; log_likelihood = ∫ f ln m / ∫f."""

    l1: float
    l2: float
    log_likelihood: float


class FineSlice:
    def __init__(self, fitter, of, resolution=224):
        places = (np.arange(resolution) + 0.5) / resolution
        radius = SCALE * places / (1.0 - places)
        slope = SCALE / (1.0 - places) ** 2 / resolution  # dr
        angle = 2.0 * np.pi * places
        r, phi = np.meshgrid(radius, angle)
        area = (radius * slope * 2.0 * np.pi / resolution)[None, :].repeat(resolution, axis=0)
        half = np.stack([of.alpha[0] * r * np.cos(phi), of.alpha[1] * r * np.sin(phi), np.ones_like(r)], axis=-1)
        half = half.reshape(-1, 3)
        z = 1.0 / np.linalg.norm(half, axis=1)
        half *= z[:, None]
        cosine = half @ of.view
        keep = cosine > 0.0
        half, cosine, z = half[keep], cosine[keep], z[keep]
        self.directions = np.ascontiguousarray(2.0 * cosine[:, None] * half - of.view)
        self.solid_angles = 4.0 * cosine * z**3 * of.alpha.prod() * area.ravel()[keep]
        self.values = fitter.evaluate(of, self.directions)
        self.albedo = self.solid_angles @ self.values
        self.energy = self.solid_angles @ self.values**2

    def mixture(self, lobes):
        """Values (N,) of Σ weight κ/(2π(1 − e^{−2κ})) e^{−κ|i − μ|²/2}."""
        value = np.zeros(len(self.directions))
        for weight, x, y, z, kappa in lobes:
            offset = self.directions - (x, y, z)
            distance = np.einsum("nc,nc->n", offset, offset)
            value += weight * kappa / (-2.0 * np.pi * np.expm1(-2.0 * kappa)) * np.exp(-0.5 * kappa * distance)
        return value

    def errors(self, lobes):
        value = self.mixture(lobes)
        difference = value - self.values
        bright = self.values > 0.0
        return Errors(
            l1=float(100.0 * (self.solid_angles @ np.abs(difference)) / self.albedo),
            l2=float(100.0 * np.sqrt((self.solid_angles @ difference**2) / self.energy)),
            log_likelihood=float(
                (self.solid_angles * self.values)[bright] @ np.log(np.maximum(value[bright], 1e-300)) / self.albedo
            ),
        )
