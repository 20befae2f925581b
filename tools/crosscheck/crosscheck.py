"""Compares the reference integrator with itself and with integrators that share no code with it.

self         the same picture at doubled sampling and with other noise, PSNR of the contract
adaptive     single pixels, an analytic map, SciPy's adaptive cubature
cells        single pixels, real maps, Gauss–Legendre between all texel centres
mitsuba      whole pictures, real maps, Mitsuba 3

Each comparison is judged by its own noise. The last line is "N passed, N failed"; the exit status is 1 if any failed.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

import contract
import quadrature

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "compare"))
import metrics  # noqa: E402

MATERIALS = [
    ("ward", (0.1, 0.1)),
    ("ward", (0.05, 0.2)),
    ("ward", (0.01, 0.01)),
    ("ward", (0.01, 0.2)),
    ("ggx", (0.1, 0.1)),
]
SMOOTH_MATERIALS = [("ward", (0.1, 0.1)), ("ward", (0.05, 0.2)), ("ggx", (0.1, 0.1)), ("ggx", (0.2, 0.5))]
MITSUBA_MATERIALS = [("ggx", (0.1, 0.1)), ("ggx", (0.05, 0.3)), ("ward", (0.1, 0.1)), ("ward", (0.05, 0.2))]

# Of a picture of 256²: the middle, half-way, towards the rim at the top, and close to the rim.
PIXELS = [(128, 128), (60, 90), (200, 40), (20, 128)]
PIXEL_SIZE = 256

SELF_AGREEMENT_DB = 55.0
# The reference at a pixel: runs that are independent of one another, and samples in each.
RUNS, SAMPLES = 8, 1 << 17
# Standard errors. Those of pixels come from RUNS × 4 batches: Student's t with 24 degrees of freedom leaves the
# interval once in 25000 times. Nothing here is random from run to run.
SIGMAS = 5.0
# Root mean square of a picture's deviations over their standard errors; 1.02 is expected of 64 batches.
MAX_RMS_DEVIATION = 1.2
# Mitsuba's map may differ by the rounding of single precision at steep places.
MAX_MAP_DIFFERENCE = 2e-3


class CheckError(Exception):
    """Says in one sentence what went wrong outside the comparisons."""


@dataclass
class Result:
    """One comparison. `difference` and `noise` are relative to the radiance, except for `self`: dB and the limit."""

    check: str
    map: str
    brdf: str
    alpha: tuple
    place: str
    difference: float
    noise: float
    passed: bool
    seconds: float

    def line(self):
        verdict = "ok    " if self.passed else "FAILED"
        material = f"{self.brdf} {self.alpha[0]:g},{self.alpha[1]:g}"
        if self.check == "self":
            numbers = f"{self.difference:10.1f} dB  at least {self.noise:.0f} dB"
        else:
            numbers = f"{self.difference:10.1e}     noise {self.noise:.1e}"
        return f"{verdict} {self.check:8} {self.map:14} {material:14} {self.place:10} {numbers} {self.seconds:6.1f} s"


class Reference:
    """The command-line tool around the C++ integrator."""

    def __init__(self, tool, folder):
        self.tool, self.folder = tool, Path(folder)

    def _run(self, panorama, brdf, alpha, *options):
        command = [self.tool, "--env", panorama, "--brdf", brdf, "--alpha", f"{alpha[0]},{alpha[1]}", *options]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines() or [f"the reference ended with {done.returncode}"]
            raise CheckError(lines[-1])
        return done.stdout

    def picture(self, panorama, brdf, alpha, size, samples, seed):
        """Radiance and standard error, (size, size, 3) each."""
        path = self.folder / "reference.exr"
        self._run(
            panorama, brdf, alpha, "--size", size, "--samples", samples, "--seed", seed, "--out", path
        )
        with metrics.OpenEXR.File(str(path), separate_channels=True) as file:
            channels = file.channels()
            planes = [
                np.stack([channels[prefix + c].pixels.astype(np.float64) for c in "RGB"], axis=-1)
                for prefix in ("", "error.")
            ]
        return planes

    def pixel(self, panorama, brdf, alpha, column, row):
        """Radiance and standard error of one pixel, (3,) each."""
        places = ",".join([f"{column},{row}"] * RUNS)
        output = self._run(
            panorama, brdf, alpha, "--size", PIXEL_SIZE, "--samples", SAMPLES, "--pixels", places
        )
        values = np.array([line.split() for line in output.splitlines()], dtype=np.float64)
        return values[:, 2:5].mean(axis=0), np.sqrt((values[:, 5:8] ** 2).sum(axis=0)) / len(values)


def check_self(reference, panorama, material, size, samples):
    start = time.monotonic()
    once, _ = reference.picture(panorama, *material, size, samples, seed=1)
    twice, _ = reference.picture(panorama, *material, size, 2 * samples, seed=2)
    mask = metrics.sphere_mask(size)
    decibels = float(metrics.psnr(once, twice, metrics.exposure_of(twice, mask), mask))
    return Result(
        "self", panorama.stem, *material, f"{size}²", decibels, SELF_AGREEMENT_DB,
        decibels >= SELF_AGREEMENT_DB, time.monotonic() - start,
    )  # fmt: skip


def check_pixel(name, reference, panorama, material, pixel, integrate, allowance=0.0):
    """integrate(brdf, alpha, frame) gives radiance and error; `allowance`: a known relative difference."""
    start = time.monotonic()
    value, error = integrate(*material, contract.frame_at(*pixel, PIXEL_SIZE))
    ours, noise = reference.pixel(panorama, *material, *pixel)
    limit = SIGMAS * noise + error + allowance * value
    worst = int(np.argmax(np.abs(ours - value) / limit))
    return Result(
        name, panorama.stem, *material, f"{pixel[0]},{pixel[1]}",
        float((ours - value)[worst] / value[worst]), float(limit[worst] / value[worst] / SIGMAS),
        bool(np.all(np.abs(ours - value) <= limit)), time.monotonic() - start,
    )  # fmt: skip


def analytic_light(direction):
    """e^{d·a} with another axis a for each channel."""
    axes = np.array([[0.6, 0.8, 0.0], [0.0, 0.6, -0.8], [-0.8, 0.0, 0.6]])
    return np.exp(direction @ axes.T)


def analytic_panorama(path, width=2048):
    """Writes analytic_light; returns a bound of its relative interpolation error.

    Along a great circle |L''| ≤ 2 L, so linear interpolation errs by at most 2 h²/8 in each of the two axes.
    """
    height = width // 2
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    contract.write_panorama(path, analytic_light(contract.direction_at(u, v)))
    return 2 * 2 * (np.pi / height) ** 2 / 8


def check_mitsuba(reference, panorama, material, size, samples):
    import mitsuba_sphere

    start = time.monotonic()
    texels = contract.read_panorama(panorama)
    if (difference := mitsuba_sphere.check_panorama(texels)) > MAX_MAP_DIFFERENCE:
        raise CheckError(f"{panorama}: Mitsuba's map differs by {difference:.1e}, so it cannot be compared.")
    theirs, their_error = mitsuba_sphere.render(texels, *material, size, samples, batches=64)
    ours, our_error = reference.picture(panorama, *material, size, samples, seed=3)
    inside = metrics.sphere_mask(size)
    deviation = (theirs - ours)[inside]
    variance = (their_error**2 + our_error**2)[inside]
    rms = float(np.sqrt(np.mean(deviation**2 / variance)))
    total, noise = deviation.sum(), np.sqrt(variance.sum())
    light = ours[inside].sum()
    return Result(
        "mitsuba", panorama.stem, *material, f"rms {rms:.2f}", float(total / light), float(noise / light),
        bool(rms <= MAX_RMS_DEVIATION and abs(total) <= SIGMAS * noise), time.monotonic() - start,
    )  # fmt: skip


def comparisons(arguments, reference, folder):
    """Yields a function for each comparison."""
    small = arguments.small
    maps = arguments.env[:1] if small else arguments.env
    for panorama in maps:
        for material in MATERIALS:
            size = 32 if small else 128
            yield lambda p=panorama, m=material, s=size: check_self(reference, p, m, s, 2048)

    smooth = folder / "analytic.exr"
    allowance = analytic_panorama(smooth)

    def adaptive(brdf, alpha, frame):
        return quadrature.adaptive(analytic_light, brdf, alpha, frame)

    for material in SMOOTH_MATERIALS[1::2] if small else SMOOTH_MATERIALS:
        for pixel in PIXELS[1::2] if small else PIXELS:
            yield lambda m=material, p=pixel: check_pixel(
                "adaptive", reference, smooth, m, p, adaptive, allowance
            )

    for panorama in maps:
        texels = contract.read_panorama(panorama)

        def cells(brdf, alpha, frame, texels=texels):
            return quadrature.by_cells(texels, brdf, alpha, frame)

        for material in MATERIALS[1::3] if small else MATERIALS:
            for pixel in PIXELS[3:] if small else PIXELS:
                yield lambda e=panorama, m=material, p=pixel, c=cells: check_pixel(
                    "cells", reference, e, m, p, c
                )

    for panorama in maps:
        for material in MITSUBA_MATERIALS[1:3] if small else MITSUBA_MATERIALS:
            size, samples = (24, 2048) if small else (48, 8192)
            yield lambda p=panorama, m=material, s=size, n=samples: check_mitsuba(reference, p, m, s, n)


def check_arguments(arguments):
    for panorama in arguments.env:
        if not panorama.is_file():
            raise CheckError(f"{panorama}: no such file")
        try:
            contract.read_panorama(panorama)
        except (KeyError, OSError, RuntimeError, TypeError) as error:
            raise CheckError(f"{panorama}: is not an EXR with channels R, G and B") from error
    if arguments.json and not arguments.json.absolute().parent.is_dir():
        raise CheckError(f"{arguments.json}: its folder does not exist")


def main():
    parser = argparse.ArgumentParser(prog="./dev crosscheck", description="Checks the reference integrator.")
    parser.add_argument("--tool", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--default-env", nargs="+", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--env", action="append", type=Path, help="a panorama (.exr), instead of the demo's")
    parser.add_argument("--small", action="store_true", help="fewer and smaller comparisons: about a minute")
    parser.add_argument("--json", type=Path, help="write the results to this file")
    arguments = parser.parse_args()
    arguments.env = arguments.env or arguments.default_env

    results = []
    try:
        check_arguments(arguments)
        with tempfile.TemporaryDirectory(prefix="lobelight-") as folder:
            reference = Reference(arguments.tool, folder)
            for compare in comparisons(arguments, reference, Path(folder)):
                results.append(compare())
                print(results[-1].line(), flush=True)
    except (CheckError, metrics.MetricError) as error:
        print(f"crosscheck: {error}", file=sys.stderr)
        return 1
    if arguments.json:
        metrics.write_json(str(arguments.json), [asdict(result) for result in results])
    failed = sum(not result.passed for result in results)
    print(f"{len(results) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
