"""Directional albedo E(o) = integral of rho(i, o) i_z di by a quadrature that shares nothing with the library.

In the half-vector's slopes s = (h_x, h_y)/h_z the incoming direction is above the horizon exactly in a disc: with
h ~ (s, 1), i_z = 2 (o.h) h_z - o_z = (2 o_xy.s + o_z - o_z |s|^2) / (1 + |s|^2). So the domain is known, and nothing
has to be found by sampling. With di = 4 (o.h) h_z^3 ds and slopes (alpha_x r cos a, alpha_y r sin a):

Ward          rho i_z di = exp(-r^2)/pi r dr da . sqrt(i_z/o_z) (o.h) h_z^3
bounded Ward  rho i_z di = exp(-r^2)/pi r dr da . 2 i_z / (i_z + o_z)
GGX           rho i_z di = 1/(pi (1 + r^2)^2) r dr da . G2 (o.h) / (o_z h_z)

Both integrals are tanh-sinh sums (Takahasi and Mori 1974), which reach layers of any width at the ends of their
intervals; these lie where the layers are: at the horizon, at the half-vector of the mirror direction, and in azimuth in
the planes along and across the view and the material.
"""

import numpy as np

STEPS = (0.14, 0.07, 0.035, 0.0175)
TOLERANCE = 1e-9


def tanh_sinh(step):
    """Nodes x of [0, 1], 1 - x without cancellation, and weights."""
    u = np.arange(-round(3.6 / step), round(3.6 / step) + 1) * step
    e = np.exp(np.pi * np.sinh(u))
    return e / (1 + e), 1 / (1 + e), step * np.pi * np.cosh(u) * e / (1 + e) ** 2


def smith_lambda(slope2):
    """(sqrt(1 + x) - 1)/2 without cancellation."""
    return 0.5 * slope2 / (np.sqrt(1.0 + slope2) + 1.0)


class Slice:
    """A BRDF and a view; angles in degrees."""

    def __init__(self, brdf, alpha, elevation, azimuth):
        theta, phi = np.radians(elevation), np.radians(azimuth)
        self.brdf = brdf
        self.alpha = alpha
        self.o = np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])

    def angles(self):
        """The ends of the intervals in a: along and across the view, and the axes."""
        along = np.arctan2(self.alpha[1] * self.o[1], self.alpha[0] * self.o[0])
        quarter = np.pi / 2
        ends = np.sort(np.concatenate([(along + quarter * np.arange(4)) % (2 * np.pi), quarter * np.arange(5)]))
        return ends[np.concatenate([[True], np.diff(ends) > 1e-9])]

    def density(self, t, left, a):
        """The integrand over t and a; left = 1 - t. left^2 is the share of a ray's mass that lies beyond the radius,
        which takes the root of i_z from the horizon and the pole from infinity."""
        alpha, o = self.alpha, self.o
        x, y = alpha[0] * np.cos(a), alpha[1] * np.sin(a)
        w = x * x + y * y
        # r at the horizon: o_z w r^2 - 2 b r - o_z = 0, the positive root in the form that does not cancel.
        b = o[0] * x + o[1] * y
        root = np.sqrt(b * b + w * o[2] ** 2)
        end = np.where(b > 0, (b + root) / (w * o[2]), o[2] / np.where(b > 0, 1.0, root - b))
        if self.brdf == "ggx":
            beyond = 1.0 / (1.0 + end * end)
            inside = end * end * beyond
        else:
            beyond = np.exp(-end * end)
            inside = -np.expm1(-end * end)
        mass = inside * t * (1.0 + left)
        rest = beyond + inside * left * left
        if self.brdf == "ggx":
            r2 = mass / rest
        else:
            r2 = np.where(mass < 0.5, -np.log1p(-np.minimum(mass, 0.5)), -np.log(rest))
        r = np.minimum(np.sqrt(r2), end)
        jacobian = inside * left / np.pi
        sx, sy = r * x, r * y
        hz2 = 1.0 / (1.0 + w * r * r)
        plane = b * r + o[2]  # (o.h) / h_z
        # i_z by its roots: exact at the horizon.
        iz = o[2] * (end - r) * (w * r + 1.0 / end) * hz2
        if self.brdf == "ward":
            return jacobian * np.sqrt(iz / o[2]) * np.maximum(plane, 0.0) * hz2 * hz2
        if self.brdf == "ward_bounded":
            return jacobian * 2.0 * iz / (iz + o[2])
        ix, iy = 2.0 * plane * sx * hz2 - o[0], 2.0 * plane * sy * hz2 - o[1]
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            lambda_i = smith_lambda(((alpha[0] * ix) ** 2 + (alpha[1] * iy) ** 2) / iz**2)
            lambda_o = smith_lambda(((alpha[0] * o[0]) ** 2 + (alpha[1] * o[1]) ** 2) / o[2] ** 2)
            value = jacobian * plane / o[2] / (1.0 + lambda_i + lambda_o)
        return np.where(iz > 0.0, value, 0.0)

    def integral(self, step):
        x, rest, weight = tanh_sinh(step)
        ends = self.angles()
        total = 0.0
        for low, high in zip(ends[:-1], ends[1:]):
            a = np.where(x < 0.5, low + (high - low) * x, high - (high - low) * rest)
            values = self.density(x[:, None], rest[:, None], a[None, :])
            total += (high - low) * float(weight @ values @ weight)
        return total


def directional_albedo(brdf, alpha, elevation, azimuth):
    """(albedo, estimate of its error); steps are halved until two sums agree to 1e-9."""
    one = Slice(brdf, alpha, elevation, azimuth)
    value = one.integral(STEPS[0])
    error = np.inf
    for step in STEPS[1:]:
        finer = one.integral(step)
        error, value = abs(finer - value), finer
        if error <= TOLERANCE * value:
            break
    return float(value), float(error)
