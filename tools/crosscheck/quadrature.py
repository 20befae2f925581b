"""Single pixels by quadrature: two rules, neither of which draws a sample."""

import numpy as np
from scipy.integrate import cubature
from scipy.special import roots_legendre

import contract


def adaptive(light, brdf, alpha, frame, tolerance=1e-6):
    """∫ L ρ i_z di by SciPy's adaptive cubature over half-vector slopes.

    light: directions (n, 3) in world space to radiance (n, 3), smooth. The slopes are α r (cos φ, sin φ) with r given
    by u in [0, 1): e^{−r²} = 1 − u for Ward, 1/(1 + r²) = 1 − u for GGX, which flattens the lobe; then
    di = 4 (o·h) h_z³ dslopes, dslopes = α_x α_y r dr dφ. Returns (radiance, error estimate), each (3,).
    """
    o = frame @ contract.VIEW
    reflectance = contract.REFLECTANCE[brdf]

    def integrand(points):
        u, phi = points[:, 0], points[:, 1]
        if brdf == "ward":
            squared = -np.log1p(-u)
            r_dr = 0.5 / (1 - u)
        else:
            squared = u / (1 - u)
            r_dr = 0.5 / (1 - u) ** 2
        r = np.sqrt(squared)
        h = np.stack([alpha[0] * r * np.cos(phi), alpha[1] * r * np.sin(phi), np.ones_like(r)], axis=-1)
        h /= np.linalg.norm(h, axis=-1, keepdims=True)
        o_dot_h = h @ o
        i = 2 * o_dot_h[:, None] * h - o
        jacobian = 4 * o_dot_h * h[:, 2] ** 3 * alpha[0] * alpha[1] * r_dr
        value = np.where(o_dot_h > 0, reflectance(i, o, alpha) * jacobian, 0.0)
        return value[:, None] * light(i @ frame)

    # At u = 1 the slopes are infinite; what is left out weighs 1e-9.
    result = cubature(
        integrand, [0, 0], [1 - 1e-9, 2 * np.pi], rtol=tolerance, atol=0, max_subdivisions=20000
    )
    return result.estimate, result.error


def _cell_rows(height):
    """The strips between which a bilinear panorama is smooth in y, in texels."""
    return np.concatenate([[0.0], np.arange(height) + 0.5, [float(height)]])


def _by_cells(panorama, reflectance, alpha, frame, nodes):
    height, width = panorama.shape[:2]
    o = frame @ contract.VIEW
    offsets, weights = roots_legendre(nodes)
    offsets, weights = (offsets + 1) / 2, weights / 2
    x = (np.arange(width)[:, None] + 0.5 + offsets).ravel()
    x_weights = np.tile(weights, width)
    edges = _cell_rows(height)
    total = np.zeros(3)
    for low, high in zip(edges[:-1], edges[1:]):
        for y, y_weight in zip(low + (high - low) * offsets, (high - low) * weights):
            direction = contract.direction_at(x / width, np.full_like(x, y / height))
            value = reflectance(direction @ frame.T, o, alpha)
            lit = value > 0
            if not lit.any():
                continue
            radiance = contract.bilinear(panorama, x[lit], np.full(np.count_nonzero(lit), y))
            total += y_weight * np.sin(np.pi * y / height) * ((value[lit] * x_weights[lit]) @ radiance)
    # dω = 2π² sin θ du dv
    return total * 2 * np.pi**2 / (width * height)


def by_cells(panorama, brdf, alpha, frame, nodes=(4, 6)):
    """∫ L ρ i_z di by Gauss–Legendre in every cell between texel centres, where a bilinear map is smooth.

    Returns (radiance, error estimate), each (3,); the estimate is the difference of two numbers of nodes.
    """
    reflectance = contract.REFLECTANCE[brdf]
    coarse, fine = (_by_cells(panorama, reflectance, alpha, frame, n) for n in nodes)
    return fine, np.abs(fine - coarse)
