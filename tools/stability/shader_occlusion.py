"""Probes of how much of a lobe gets light, and what the material's own probes ask of it."""

import math
from functools import partial

import exact_shader as shader
from exact import dot, mpf, vector
from probes import DIVISION, INVERSE_SQRT, U, Near, Probe, exp2_error, log2_error, single
from shader_points import turn, view_at

SOFTNESS = mpf("0.08")
# Of the logistic curve about bent normals, and without.
STEEP = {True: 2, False: 1}


def hidden_odds(ao, bent_cosine):
    """(log2((1 - seen) / seen), what it may be off by). The ends are 1e-12, far enough that shares are 0 and 1."""
    seen = mpf(ao) / max(mpf(bent_cosine), mpf("0.1"))
    rounded = (DIVISION + 8 * U) * float(seen) + U
    total, off = mpf(0), 0.0
    for sign, part in ((1, 1 - seen), (-1, seen)):
        part = max(part, mpf("1e-12"))
        total += sign * shader.mp.log(part, 2)
        # Nearer to the end than a rounding, it may be anything down to there.
        off += log2_error(float(part)) + math.log2((float(part) + rounded) / max(float(part) - rounded, 1e-12))
    return total, off


def open_share(is_bent, odds, cosine, variance, cosine_off=0.0, relative_off=0.0):
    """(share, bound) of a lobe by its cosine to what is open; the odds with what they are off by."""
    k = STEEP[is_bent]
    soft = mpf(variance) + SOFTNESS
    below = mpf(2) / 3 - cosine
    exponent = float(k * shader.mp.log(mpf(shader.mp.e), 2) * below / shader.mp.sqrt(soft))
    slope = abs(exponent / float(below)) if below else float(k * shader.mp.log(mpf(shader.mp.e), 2) / shader.mp.sqrt(soft))
    # The constants have six digits.
    off = slope * (cosine_off + 8 * U) + abs(exponent) * (0.5 * relative_off + INVERSE_SQRT + 8 * U + 1e-5)
    off += odds[1] + U * (abs(exponent) + abs(float(odds[0])))

    def share(by):
        return 1 / (1 + mpf(2) ** (odds[0] + mpf(by)) * shader.mp.exp(k * below / shader.mp.sqrt(soft)))

    wanted = share(0)
    total = abs(exponent + float(odds[0]))
    off += exp2_error(total) / math.log(2)
    return wanted, float(max(share(-off) - wanted, wanted - share(off))) + (DIVISION + 2 * U) * float(wanted)


def share_above(normal_cosine, geometric_cosine, variance, cosine_off=0.0, relative_off=0.0):
    """(share, bound) of what is above the horizon of the lobe's normal that is above the geometric normal's."""
    slope = mpf("0.35") / shader.mp.sqrt(mpf(variance) + mpf("0.001"))

    def above(cosine, least):
        part = min(max(slope * cosine + mpf("0.5"), mpf(least)), mpf(1))
        steady = INVERSE_SQRT + 0.5 * relative_off + 4 * U
        return part, float(slope) * (cosine_off + 4 * U + abs(float(cosine)) * steady) + U

    of_all, all_off = above(normal_cosine, "0.01")
    of_seen, seen_off = above(geometric_cosine, 0)
    share = of_seen / of_all
    low = max(float(of_all) - all_off, 0.01)
    off = (seen_off + float(share) * all_off) / low + DIVISION * float(share)
    # Of two that are the same the quotient is 1.
    if share > 1 and (float(share) - 1) > off:
        off = U
    return min(share, mpf(1)), off


def lit(above, own):
    """Of a lobe, where the surface itself sends out a share of the light around it."""
    return above + (1 - above) * own


def expect_occlusion(is_bent, row):
    open_to, ao, mean, variance = vector(row[:3]), row[3], vector(row[4:7]), mpf(row[7])
    normal, bent_cosine, geometric = vector(row[8:11]), row[11], vector(row[12:15])
    near, near_off = open_share(is_bent, hidden_odds(ao, bent_cosine), dot(open_to, mean), variance)
    above, above_off = share_above(dot(normal, mean), dot(geometric, mean), variance)
    return [
        Near((0,), (near,), near_off, "share"),
        Near((1,), (above,), above_off, "share"),
        Near((2,), (near * lit(above, mpf("0.25")),), float(near) * above_off + near_off + 3 * U, "share"),
        Near((3,), (1,), U, "share"),
    ]


def probes(quick):
    for is_bent in (False, True):
        name = "occlusion about bent normals" if is_bent else "occlusion"
        probe = Probe(name.replace(" ", "_"), "shader occlusion", "occlusion", 4, partial(expect_occlusion, is_bent))
        probe.defines = ("LOBELIGHT_CONE", "LOBELIGHT_HORIZON", *["LOBELIGHT_BENT_NORMAL"] * is_bent)
        for ao in (0.0, 0.5, 1.0) if quick else (0.0, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999, 1.0):
            rows = []
            for seed, variance in enumerate((1e-5, 1e-3, 0.02, 0.1, 0.5, 1.0)):
                frame = turn(seed + 60)
                for elevation in (0.0, 48.2, 85.0, 90.0, 100.0, 180.0):
                    place = view_at(elevation, 40.0 * seed)
                    mean = single([sum(frame[n][axis] * place[n] for n in range(3)) for axis in range(3)])
                    # Bent away by nothing, by a little, and by a right angle.
                    for bend in (0.0, 20.0, 90.0):
                        bent = view_at(bend, 100.0)
                        normal = single([sum(frame[n][axis] * bent[n] for n in range(3)) for axis in range(3)])
                        bent_cosine = max(math.cos(math.radians(bend)), 0.0)
                        rows.append((*frame[2], ao, *mean, variance, *normal, bent_cosine, *single(frame[2]), 0))
            probe.add(f"{name}, of {ao:g}", rows)
        yield probe
