"""The picture of ./dev compare in NumPy, written from its definition and from the papers, not from the C++ code.

Directions are arrays (…, 3), unit vectors; radiance is linear RGB. Local frames are x = tangent, y = bitangent,
z = normal; `i` points to the light, `o` to the viewer.
"""

import numpy as np
import OpenEXR

VIEW = np.array([0.0, 0.0, 1.0])


def read_panorama(path):
    """Returns float64 (height, width, 3); negative values and NaN are 0, infinite ones 65504 or the largest, if that is more."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        picture = np.stack([channels[c].pixels.astype(np.float64) for c in "RGB"], axis=-1)
    brightest = max(65504.0, picture.max(initial=0.0, where=np.isfinite(picture)))
    return np.where(picture > 0, np.minimum(picture, brightest), 0.0)


def write_panorama(path, picture):
    """Writes (height, width, 3) as 32-bit floats."""
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": np.ascontiguousarray(picture, dtype=np.float32)}) as file:
        file.write(str(path))


def direction_at(u, v):
    """The direction at (u, v) of a panorama: u = fract(atan2(x, −z)/2π), v = acos(y)/π."""
    azimuth, polar = 2 * np.pi * u, np.pi * v
    return np.stack(
        [np.sin(polar) * np.sin(azimuth), np.cos(polar), -np.sin(polar) * np.cos(azimuth)], axis=-1
    )


def bilinear(panorama, x, y):
    """Radiance at texel coordinates (texel i has its centre at i + ½): wrapped in x, clamped in y."""
    height, width = panorama.shape[:2]
    x, y = x - 0.5, np.clip(y - 0.5, 0, height - 1)
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    right, bottom = (left + 1) % width, np.minimum(top + 1, height - 1)
    left = left % width
    s, t = (x - np.floor(x))[..., None], (y - top)[..., None]
    return (panorama[top, left] * (1 - s) + panorama[top, right] * s) * (1 - t) + (
        panorama[bottom, left] * (1 - s) + panorama[bottom, right] * s
    ) * t


def frame_at(column, row, size):
    """Tangent, bitangent and normal of the sphere's pixel as the rows of a 3 × 3 matrix."""
    x, y = (2 * column + 1) / size - 1, 1 - (2 * row + 1) / size
    normal = np.array([x, y, np.sqrt(1 - x * x - y * y)])
    tangent = np.cross([0.0, 1.0, 0.0], normal)
    tangent /= np.linalg.norm(tangent)
    return np.stack([tangent, np.cross(normal, tangent), normal])


def ward(i, o, alpha):
    """Ward 1992, eq. 5a, specular part with albedo 1, times the cosine of the light."""
    h = i + o
    exponent = ((h[..., 0] / alpha[0]) ** 2 + (h[..., 1] / alpha[1]) ** 2) / h[..., 2] ** 2
    cosine = np.maximum(i[..., 2], 1e-300)
    value = np.exp(-exponent) / (4 * np.pi * alpha[0] * alpha[1] * np.sqrt(cosine * o[2]))
    return np.where(i[..., 2] > 0, value * cosine, 0.0)


def smith_lambda(v, alpha):
    """Heitz 2014, eqs. 72 and 86."""
    slope = ((alpha[0] * v[..., 0]) ** 2 + (alpha[1] * v[..., 1]) ** 2) / v[..., 2] ** 2
    return (np.sqrt(1 + slope) - 1) / 2


def ggx(i, o, alpha):
    """D G2 / (4 o_z), Smith's height-correlated masking: Heitz 2014, eqs. 85 and 99, times the light's cosine."""
    light = np.where((i[..., 2] > 1e-12)[..., None], i, [0.0, 0.0, 1.0])
    h = light + o
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    ellipsoid = (h[..., 0] / alpha[0]) ** 2 + (h[..., 1] / alpha[1]) ** 2 + h[..., 2] ** 2
    density = 1 / (np.pi * alpha[0] * alpha[1] * ellipsoid**2)
    masking = 1 / (1 + smith_lambda(light, alpha) + smith_lambda(o, alpha))
    return np.where(i[..., 2] > 1e-12, density * masking / (4 * o[2]), 0.0)


REFLECTANCE = {"ward": ward, "ggx": ggx}
