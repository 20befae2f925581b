"""What the shaders compute, with 50 digits, from the papers and from what their comments say of them."""

from functools import cache

import mpmath as mp

from exact import clamp_view, dot, mpf, norm, normalised

LAST_ELEVATION = mp.radians(mpf("89.4"))


def scaled(a, x):
    return tuple(x * y for y in a)


def plus(*vectors):
    return tuple(sum(components, mpf(0)) for components in zip(*vectors))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def columns_times(columns, v):
    """A matrix, by its columns, times a vector."""
    return plus(*(scaled(c, x) for c, x in zip(columns, v)))


# Levels


def level(variance, component, texel, b, c, is_even):
    """Where the pyramid's blur is `variance` between levels that are mixed linearly; texel is t^2 = 4 / S^2, component the
    largest of the direction. V_l = t^2 (b - c + (c + 1/6) 4^l) for levels that blur alike everywhere, and
    t^2 (b + m^3 (c (4^l - 1) + 4^l / 6)) for those that are made of texels."""
    m3 = mpf(1) if is_even else mpf(component) ** 3
    scale = texel * m3 * (c + mpf(1) / 6)
    total = variance + texel * (c * m3 - b)
    smooth = mp.log(total / scale, 4)
    whole = mp.floor(smooth)
    return whole + (mpf(4) ** (smooth - whole) - 1) / 3


# Tables


def column(cosine):
    """Of a view, in [0, 1]: elevation = last (1 - (1 - column)^2)."""
    elevation = mp.acos(min(max(mpf(cosine), mpf(-1)), mpf(1)))
    return 1 - mp.sqrt(max(1 - elevation / LAST_ELEVATION, mpf(0)))


def quadrant_angle(x, y):
    return mp.atan2(abs(mpf(y)), abs(mpf(x)))


def lobe(texel, half_vectors, o):
    """(mean, variance, cosine): half-vector normalize(slope, 1), light 2 (o.h) h - o, variance (o.h) / 2^z."""
    h = columns_times(half_vectors, (mpf(texel[0]), mpf(texel[1]), mpf(1)))
    h = normalised(h)
    cosine = max(dot(o, h), mpf("1e-4"))
    return normalised(minus(scaled(h, 2 * cosine), o)), cosine * mpf(2) ** -mpf(texel[2]), cosine


def plane_lobe(texel, o, tangent):
    """(mean, variance, weight, weight times Schlick's part) of an isotropic table's texel, about the normal (0, 0, 1): its
    first two numbers are along the mirror direction of the view o and across it, and as long as 256 standard deviations."""
    sine, up = o[0], o[2]
    normal = (mpf(0), mpf(0), mpf(1))
    mirrored = minus(scaled(normal, up), scaled(tangent, sine))
    across = plus(scaled(tangent, up), scaled(normal, sine))
    mean = plus(scaled(mirrored, mpf(texel[0])), scaled(across, mpf(texel[1])))
    return normalised(mean), (mpf(texel[0]) ** 2 + mpf(texel[1]) ** 2) / 65536, mpf(texel[2]), mpf(texel[3])


# Frames


def any_tangent(n):
    """Duff et al. 2017, listing 3."""
    side = mpf(1) if n[2] >= 0 else mpf(-1)
    a = -1 / (side + n[2])
    return (1 + side * n[0] ** 2 * a, side * n[0] * n[1] * a, -side * n[0])


def view_of(normal, view):
    """(view in tangent space, in the space of the arguments, tangent) for isotropic tables; any tangent for a view along
    the normal."""
    cosine = dot(normal, view)
    across = minus(view, scaled(normal, cosine))
    sine = norm(across)
    o = clamp_view((sine, mpf(0), cosine))
    tangent = scaled(across, 1 / sine) if sine > mpf("1e-5") else any_tangent(normal)
    return o, plus(scaled(tangent, o[0]), scaled(normal, o[2])), tangent


# Widths: Burley 2012, B.1, as Godot has it.


def widths(roughness, anisotropy):
    mean = max(roughness, mpf("1e-4")) ** 2
    aspect = mp.sqrt(max(1 - mpf("0.9") * anisotropy, mpf("0.01")))
    return mean / aspect, mean * aspect


# Light


def schlick(cosine):
    """What Schlick's Fresnel has of f90 - f0."""
    return min(max(1 - cosine, mpf(0)), mpf(1)) ** 5


@cache
def cosine_lobes():
    """(1 / kappa, cos t, sin t) of six Gaussians around the normal that have the cosine's bands 1 and 2: 2/3 and 1/4 of
    band 0 (Ramamoorthi and Hanrahan 2001, eq. 8)."""

    def bands(kappa, tilt):
        first = mp.coth(kappa) - 1 / kappa
        second = 1 - 3 * first / kappa
        c = mp.cos(tilt)
        return first * c - mpf(2) / 3, second * (3 * c**2 - 1) / 2 - mpf(1) / 4

    kappa, tilt = mp.findroot(bands, (mpf(8), mpf("0.7")))
    return 1 / kappa, mp.cos(tilt), mp.sin(tilt)


# Colours


def to_srgb_of_compatibility(x):
    """The cubic by which Compatibility takes what is written for sRGB (Godot, scene.glsl, srgb_to_linear)."""
    return x * (x * (x * mpf("0.305306011") + mpf("0.682171111")) + mpf("0.012522878"))


def encoded(linear):
    """Its inverse."""
    linear = mpf(linear)
    if linear <= 0:
        return mpf(0)
    x = mp.sqrt(linear)
    a, b, c = mpf("0.305306011"), mpf("0.682171111"), mpf("0.012522878")
    for _ in range(60):
        step = (to_srgb_of_compatibility(x) - linear) / (3 * a * x**2 + 2 * b * x + c)
        x -= step
        if abs(step) < abs(x) * mpf(10) ** -40:
            return x
    raise ArithmeticError(f"no root for {linear}")


def srgb_to_linear(x):
    """IEC 61966-2-1."""
    x = mpf(x)
    return ((x + mpf("0.055")) / mpf("1.055")) ** mpf("2.4") if x > mpf("0.04045") else x / mpf("12.92")


# The sky's angles (Godot, sky.glsl, acos_approx and atan2_approx)


def sky_acos(x):
    angle = (mp.pi / 2 - mpf("0.156583") * abs(x)) * mp.sqrt(1 - min(abs(x), mpf(1)))
    return angle if x >= 0 else mp.pi - angle


def sky_atan(y, x):
    largest = max(abs(x), abs(y))
    a = min(abs(x), abs(y)) / largest if largest > 0 else mpf(0)
    s = a * a
    angle = ((mpf("0.0872929") * s - mpf("0.301895")) * s + 1) * a
    if abs(y) > abs(x):
        angle = mp.pi / 2 - angle
    if x < 0:
        angle = mp.pi - angle
    return -angle if y < 0 else angle

