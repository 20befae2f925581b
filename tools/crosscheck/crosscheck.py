"""Compares the reference integrator with itself and with integrators that share no code with it.

self         the same picture at doubled sampling and with other noise, PSNR of the contract
adaptive     single pixels, an analytic map, SciPy's adaptive cubature
cells        single pixels, real maps, Gauss–Legendre between all texel centres
mitsuba      the sphere, real maps, Mitsuba 3
teapot       the teapot without shadows, real maps, Mitsuba 3

Each comparison is judged by its own noise. The last line is "crosscheck: N passed, N failed"; the exit status is 1 if any failed.
"""

import argparse
import itertools
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

import contract
import mesh
import quadrature

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "compare"))
import metrics  # noqa: E402

CHECKS = ("self", "adaptive", "cells", "mitsuba", "teapot")
MATERIALS = [
    ("ward", (0.1, 0.1)),
    ("ward", (0.05, 0.2)),
    ("ward", (0.01, 0.01)),
    ("ward", (0.01, 0.2)),
    ("ggx", (0.1, 0.1)),
]
SMOOTH_MATERIALS = [("ward", (0.1, 0.1)), ("ward", (0.05, 0.2)), ("ggx", (0.1, 0.1)), ("ggx", (0.2, 0.5))]
MITSUBA_MATERIALS = [("ggx", (0.1, 0.1)), ("ggx", (0.05, 0.3)), ("ward", (0.1, 0.1)), ("ward", (0.05, 0.2))]

TEAPOT_MATERIALS = [("ggx", (0.1, 0.1)), ("ggx", (0.05, 0.3)), ("ward", (0.05, 0.2))]
TEAPOT = Path(__file__).resolve().parents[2] / "demo/meshes/teapot.obj"
TEAPOT_VIEW, TEAPOT_MIDDLE, TEAPOT_WIDTH = (0.4, 0.7, 1.0), (0.0, 0.75, 0.0), 3.4
# Largest difference of normals of a pixel that both sides see alike, and of how many pixels the front must be.
MAX_NORMAL_DIFFERENCE = 1e-3
LEAST_SHARE_ALIKE = 0.99

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
BATCHES = 64
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
        return f"{verdict} {self.check:8} {self.map:14} {material:14} {self.place:16} {numbers} {self.seconds:6.1f} s"


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

    def _read(self):
        with metrics.OpenEXR.File(str(self.folder / "reference.exr"), separate_channels=True) as file:
            channels = file.channels()
            return [
                np.stack([channels[prefix + c].pixels.astype(np.float64) for c in "RGB"], axis=-1)
                for prefix in ("", "error.")
            ]

    def picture(self, panorama, brdf, alpha, size, samples, seed):
        """Radiance and standard error, (size, size, 3) each."""
        path = self.folder / "reference.exr"
        self._run(
            panorama, brdf, alpha, "--size", size, "--samples", samples, "--seed", seed, "--out", path
        )
        return self._read()

    def surface(self, panorama, brdf, alpha, normal, view, samples, seed):
        """Radiance and standard error, (height, width, 3) each, of normals of that shape, seen from `view`."""
        pictures = {"normals": normal, "tangents": mesh.tangents(normal)}
        for name, picture in pictures.items():
            contract.write_panorama(self.folder / f"{name}.exr", picture)
        self._run(
            panorama, brdf, alpha, "--samples", samples, "--seed", seed, "--out", self.folder / "reference.exr",
            *(part for name in pictures for part in (f"--{name}", self.folder / f"{name}.exr")),
            "--view", ",".join(f"{part:.17g}" for part in view),
        )  # fmt: skip
        return self._read()

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


def texels_for_mitsuba(panorama):
    import mitsuba_renderer

    texels = contract.read_panorama(panorama)
    if (difference := mitsuba_renderer.check_panorama(texels)) > MAX_MAP_DIFFERENCE:
        raise CheckError(f"{panorama}: Mitsuba's map differs by {difference:.1e}, so it cannot be compared.")
    return texels


def judge_pictures(name, panorama, material, theirs, ours, start, also=True, note=""):
    """Two pictures with their standard errors, (pixels, 3) each: deviations pixel by pixel, and of all the light."""
    deviation, variance = theirs[0] - ours[0], theirs[1] ** 2 + ours[1] ** 2
    # Where the light comes from below, both are 0 without noise.
    noisy = variance > 0
    rms = float(np.sqrt(np.mean(deviation[noisy] ** 2 / variance[noisy])))
    # A pixel's channels err together.
    total, noise = deviation.sum(), np.sqrt(variance.sum(axis=0)).sum()
    light = ours[0].sum()
    equal = not np.any(deviation[~noisy])
    return Result(
        name, panorama.stem, *material, f"rms {rms:.2f}{note}", float(total / light), float(noise / light),
        bool(rms <= MAX_RMS_DEVIATION and abs(total) <= SIGMAS * noise and equal and also), time.monotonic() - start,
    )  # fmt: skip


def check_mitsuba(reference, panorama, material, size, samples):
    import mitsuba_renderer

    start = time.monotonic()
    theirs = mitsuba_renderer.render(texels_for_mitsuba(panorama), *material, size, samples, batches=BATCHES)
    ours = reference.picture(panorama, *material, size, samples, seed=3)
    inside = metrics.sphere_mask(size)
    return judge_pictures(
        "mitsuba", panorama, material, [p[inside] for p in theirs], [p[inside] for p in ours], start
    )


def check_teapot(reference, panorama, material, width, samples):
    """Our normals and tangents of the teapot against Mitsuba's rays: see mesh.py and mitsuba_renderer.py."""
    import mitsuba_renderer

    start = time.monotonic()
    camera = mesh.Camera(TEAPOT_VIEW, TEAPOT_MIDDLE, TEAPOT_WIDTH, width, width * 2 // 3)
    normal = mesh.normals(TEAPOT, camera)
    *theirs, their_normal = mitsuba_renderer.render_mesh(
        texels_for_mitsuba(panorama), TEAPOT, camera, *material, samples, batches=BATCHES
    )
    ours = reference.surface(panorama, *material, normal, camera.axes()[2], samples, seed=4)
    alike = np.abs(normal - their_normal).max(axis=-1) <= MAX_NORMAL_DIFFERENCE
    front = mesh.compared(normal, camera)
    share = float(alike[front].mean())
    inside = front & alike
    return judge_pictures(
        "teapot", panorama, material, [p[inside] for p in theirs], [p[inside] for p in ours], start,
        also=share >= LEAST_SHARE_ALIKE, note=f", {100 * share:.1f} %",
    )  # fmt: skip


def of_itself(reference, maps, small):
    for panorama, material in itertools.product(maps, MATERIALS):
        yield lambda p=panorama, m=material: check_self(reference, p, m, 32 if small else 128, 2048)


def by_adaptive_rules(reference, folder, small):
    smooth = folder / "analytic.exr"
    allowance = analytic_panorama(smooth)

    def adaptive(brdf, alpha, frame):
        return quadrature.adaptive(analytic_light, brdf, alpha, frame)

    materials, pixels = (SMOOTH_MATERIALS[1::2], PIXELS[1::2]) if small else (SMOOTH_MATERIALS, PIXELS)
    for material, pixel in itertools.product(materials, pixels):
        yield lambda m=material, p=pixel: check_pixel("adaptive", reference, smooth, m, p, adaptive, allowance)


def by_cells(reference, maps, small):
    for panorama in maps:
        texels = contract.read_panorama(panorama)

        def cells(brdf, alpha, frame, texels=texels):
            return quadrature.by_cells(texels, brdf, alpha, frame)

        materials, pixels = (MATERIALS[1::3], PIXELS[3:]) if small else (MATERIALS, PIXELS)
        for material, pixel in itertools.product(materials, pixels):
            yield lambda e=panorama, m=material, p=pixel, c=cells: check_pixel("cells", reference, e, m, p, c)


def by_mitsuba(reference, maps, small):
    size, samples = (24, 2048) if small else (48, 8192)
    for panorama, material in itertools.product(maps, MITSUBA_MATERIALS[:2] if small else MITSUBA_MATERIALS):
        yield lambda p=panorama, m=material: check_mitsuba(reference, p, m, size, samples)


def of_the_teapot(reference, maps, small):
    width, samples = (36, 2048) if small else (72, 8192)
    for panorama, material in itertools.product(maps, TEAPOT_MATERIALS[:2] if small else TEAPOT_MATERIALS):
        yield lambda p=panorama, m=material: check_teapot(reference, p, m, width, samples)


def comparisons(arguments, reference, folder):
    """Yields a function for each comparison."""
    small = arguments.small
    maps = arguments.env[:1] if small else arguments.env
    makers = {
        "self": lambda: of_itself(reference, maps, small),
        "adaptive": lambda: by_adaptive_rules(reference, folder, small),
        "cells": lambda: by_cells(reference, maps, small),
        "mitsuba": lambda: by_mitsuba(reference, maps, small),
        "teapot": lambda: of_the_teapot(reference, maps, small),
    }
    for name in arguments.only:
        yield from makers[name]()


def check_list(text):
    names = text.split(",")
    if unknown := [name for name in names if name not in CHECKS]:
        raise argparse.ArgumentTypeError(f"there is no comparison '{unknown[0]}'; take some of {', '.join(CHECKS)}")
    return names


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
    parser.add_argument("--only", type=check_list, default=CHECKS, help=f"some of {', '.join(CHECKS)}")
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
    print(f"crosscheck: {len(results) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
