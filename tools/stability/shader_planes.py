"""Probes of triplanar mapping: the weights of the three planes, and their tangents."""

import exact_shader as shader
from exact import mpf, normalised, vector
from probes import DIVISION, INVERSE_SQRT, U, Near, Probe, pow_error, single
from shader_points import turn

NORMALS = [(0, 0, 1), (0, -1, 0), (1, 0, 0), (1, 1, 1), (-0.9, 0.3, 0.2), (1e-3, -1, 1e-5), *(turn(n)[2] for n in range(8))]


def expect_planes(row):
    share = [abs(x) for x in vector(row[:3])]
    # The least that the shader takes: 0 has no power of 0.
    sharpness = max(mpf(row[3]), mpf("0.01"))
    powers = [(x / max(share)) ** sharpness for x in share]
    total = sum(powers)
    weights = [x / total for x in powers]
    off = DIVISION + 4 * U
    for x, weight in zip(share, weights):
        if 0 < x < max(share):
            base = float(x / max(share))
            off += float(weight) * (pow_error(base, float(sharpness)) + 2 * float(sharpness) * DIVISION)
    tangent = normalised((share[1] + share[2], mpf(0), -share[0]))
    bitangent = normalised((mpf(0), share[0] + share[2], -share[1]))
    steady = INVERSE_SQRT + DIVISION + 8 * U
    return [
        Near((0, 1, 2), weights, 2 * off, "share"),
        Near((3, 4, 5), tangent, steady, "radians"),
        Near((6, 7, 8), bitangent, steady, "radians"),
    ]


def probes(quick):
    probe = Probe("planes", "shader coordinates", "planes", 9, expect_planes)
    for sharpness in (1.0, 150.0) if quick else (0.0, 0.25, 1.0, 4.0, 30.0, 150.0):
        rows = []
        for normal in NORMALS:
            # Normals in the world are as long as scales make them.
            for length in (1.0, 0.02, 30.0):
                rows.append((*single(shader.scaled(normalised(vector(normal)), length)), sharpness))
        probe.add(f"planes, sharpness {sharpness:g}", rows)
    return [probe]
