"""Reflectances that Mitsuba 3's `measured` plugin reads from RGL files, written to gdextension/tests/rgl_oracle.h.

The files hold arbitrary numbers from a small generator, so that every index, stride and convention counts; the C++
tests write the same files, with `rgb` in the place of `spectra`. Needs mitsuba (./dev crosscheck installs it).

    python tools/oracles/rgl_oracle.py
"""

import struct
import tempfile
from math import cos, pi, radians, sin
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_spectral")
import drjit as dr  # noqa: E402

# name, nodes of phi_i and theta_i in degrees
FILES = [
    ("isotropic", [0.0], [0.0, 30.0, 60.0, 90.0]),
    ("circle", [-180.0, -90.0, 0.0, 90.0, 180.0], [0.0, 45.0, 80.0]),
    ("half", [-180.0, -120.0, -60.0, 0.0], [10.0, 40.0, 85.0]),
    ("quarter", [-180.0, -150.0, -90.0], [0.0, 45.0, 90.0]),
]

# Elevation and azimuth of o, then of i, in degrees.
DIRECTIONS = [
    ((20.0, 35.0), (30.0, -160.0)),
    ((50.0, -100.0), (45.0, 70.0)),
    ((70.0, 160.0), (60.0, -10.0)),
    ((5.0, -20.0), (80.0, 110.0)),
    # Close to the axes, where nodes begin and end.
    ((60.0, 0.1), (50.0, 150.0)),
    ((60.0, -0.1), (50.0, 150.0)),
    ((60.0, 90.1), (50.0, -60.0)),
]

WAVELENGTHS = [450.0, 550.0, 650.0, 750.0]


def numbers(count, seed):
    """`count` numbers in (0, 1] that are exact in single precision: the upper halves of a linear congruential
    generator's states (Press et al., Numerical Recipes, "quick and dirty")."""
    state, values = seed, []
    for _ in range(count):
        state = (state * 1664525 + 1013904223) % (1 << 32)
        values.append(((state >> 16) + 1) / 65536.0)
    return np.array(values, dtype=np.float32)


def fields(phi, theta):
    """The file's fields; float32 arrays, the last dimension the fastest."""
    slices = (len(phi), len(theta))
    # The plugin reads four wavelengths; the first three of them are the file's channels.
    channels = numbers(slices[0] * slices[1] * 3 * 4 * 4, 5).reshape(*slices, 3, 4, 4)
    return {
        "description": np.frombuffer(b"arbitrary", dtype=np.uint8),
        "theta_i": np.array([radians(t) for t in theta], dtype=np.float32),
        "phi_i": np.array([radians(p) for p in phi], dtype=np.float32),
        "sigma": numbers(3 * 4, 1).reshape(3, 4),
        "ndf": numbers(5 * 6, 2).reshape(5, 6),
        "vndf": numbers(slices[0] * slices[1] * 6 * 5, 3).reshape(*slices, 6, 5),
        "luminance": numbers(slices[0] * slices[1] * 4 * 4, 4).reshape(*slices, 4, 4),
        "wavelengths": np.array(WAVELENGTHS, dtype=np.float32),
        "spectra": np.concatenate([channels, channels[:, :, :1]], axis=2),
        "jacobian": np.array([1], dtype=np.uint8),
    }


def write_tensor_file(path, named):
    head = b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(named))
    size = len(head) + sum(2 + len(name) + 2 + 1 + 8 + 8 * a.ndim for name, a in named.items())
    body = b""
    for name, array in named.items():
        body += b"\0" * (-(size + len(body)) % 8)
        kind = {"uint8": 1, "float32": 10}[array.dtype.name]
        head += struct.pack("<H", len(name)) + name.encode() + struct.pack("<HBQ", array.ndim, kind, size + len(body))
        head += struct.pack(f"<{array.ndim}Q", *array.shape)
        body += np.ascontiguousarray(array).tobytes()
    path.write_bytes(head + body)


def direction(elevation, azimuth):
    e, a = radians(elevation), radians(azimuth)
    return mi.Vector3f(sin(e) * cos(a), sin(e) * sin(a), cos(e))


def main():
    lines = [
        "// Written by tools/oracles/rgl_oracle.py (Mitsuba 3's measured BSDF). Do not edit.",
        "#pragma once",
        "",
        "// clang-format off",
        "namespace lobelight::oracle {",
        "",
        "// The file; elevation and azimuth of o and of i in degrees; reflectance times cosine in the three channels.",
        "struct Reflectance {",
        "  const char* file;",
        "  double o_elevation, o_azimuth, i_elevation, i_azimuth, channels[3];",
        "};",
        "constexpr Reflectance kReflectances[] = {",
    ]
    for name, phi, theta in FILES:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"{name}.bsdf"
            write_tensor_file(path, fields(phi, theta))
            bsdf = mi.load_dict({"type": "measured", "filename": str(path)})
        for o, i in DIRECTIONS:
            interaction = dr.zeros(mi.SurfaceInteraction3f)
            interaction.wi = direction(*o)
            interaction.wavelengths = mi.Spectrum(WAVELENGTHS)
            value = bsdf.eval(mi.BSDFContext(), interaction, direction(*i))
            channels = ", ".join(f"{value[c]:.7f}" for c in range(3))
            lines.append(f'    {{"{name}", {o[0]}, {o[1]}, {i[0]}, {i[1]}, {{{channels}}}}},')
    lines += ["};", "", "}  // namespace lobelight::oracle", ""]
    header = Path(__file__).resolve().parents[2] / "gdextension/tests/rgl_oracle.h"
    header.write_text("\n".join(lines))


if __name__ == "__main__":
    main()
