#!/usr/bin/env python3
"""How far ./dev compare finds eight lobes from the reference, on three maps in Compatibility, on two of them in every renderer.

The bounds are the project's promise, not yesterday's figures: 30 dB for Ward (0.1, 0.1), 29 dB for
Ward (0.05, 0.2), renderers within 0.3 dB of one another where the reference is above 0.001, a reference that agrees with itself to 55 dB.
Errors below what the reference is known to (55 dB) are not told apart: there the renderers' pictures themselves must agree.
One case has rivals too, which must not be worse than a prototype that shares no code with this found them
(29.9 and 25.7 dB at 128 x 128, here with room); it is drawn once more by the command itself, with GPU times.
"""

import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/compare"))
import batch  # noqa: E402
import metrics  # noqa: E402

MAPS = ["demo/environments/hall.exr", "demo/environments/sunset.exr", "tests/data/forest.exr"]
RENDERERS = ["mobile", "gl_compatibility", "forward_plus"]
LEAST_PSNR = {"0.1,0.1": 30.0, "0.05,0.2": 29.0}
RIVALS_CASE = ("demo/environments/hall.exr", "0.1,0.1")
LEAST_PSNR_OF_RIVALS = {"fis40": 29.0, "toral8": 24.5}
TIMING_ROUNDS = "1"
MOST_BETWEEN_RENDERERS = 0.3
# Compatibility's frame buffer is black below this, which is felt where the error is small altogether.
LEAST_COMPARED_RADIANCE = 0.001
LEAST_SELF_AGREEMENT = 55.0
LEAST_AGREEMENT_OF_RENDERERS = 55.0
SIZE = 64
CASES = [(environment, alpha) for environment in MAPS for alpha in LEAST_PSNR]
# Round and brushed, a photograph of a room and one of a wood. With ./dev test --thorough, all draw all.
SHARED_CASES = [RIVALS_CASE, ("tests/data/forest.exr", "0.05,0.2")]
ALL_IN = "gl_compatibility"


class CompareError(Exception):
    """Says in one sentence why a picture was not drawn."""


class Count:
    """Prints one line a check and counts them."""

    def __init__(self):
        self.passed = self.failed = 0

    def check(self, name, passed, figure):
        self.passed += passed
        self.failed += not passed
        print(f"  {name}: {'passed' if passed else 'FAILED'}, {figure}", flush=True)


def entry_of(environment, alpha, folder):
    """A comparison as bake/compare_list.gd wants it."""
    return {
        "env": str(ROOT / environment),
        "brdf": "ward",
        "alpha": [float(width) for width in alpha.split(",")],
        "methods": methods_of(environment, alpha),
        "size": SIZE,
        "samples": 0,
        "timing_rounds": 0,
        "out": str(folder),
    }


def methods_of(environment, alpha):
    return ["gmm8", "reference"] + (list(LEAST_PSNR_OF_RIVALS) if (environment, alpha) == RIVALS_CASE else [])


def cases_of(renderer):
    return CASES if renderer == ALL_IN or os.environ.get("LOBELIGHT_THOROUGH") else SHARED_CASES


def compare_all(renderer, folder):
    """By case, the rows of each method, drawn in one run of the engine."""
    folders = {case: folder / str(number) for number, case in enumerate(cases_of(renderer))}
    entries = [entry_of(*case, own) for case, own in folders.items()]
    drawn = list(batch.draw(entries, renderer, folder))
    if drawn != list(range(len(entries))):
        raise CompareError(batch.failure(folder))
    return {case: add_compared(metrics.judge(str(own))[1], own) for case, own in folders.items()}


def compare_by_command(environment, alpha, renderer, folder):
    """The same of one case by ./dev compare, with times."""
    command = [ROOT / "dev", "compare", "--env", ROOT / environment, "--brdf", "ward", "--alpha", alpha]
    command += ["--methods", ",".join(methods_of(environment, alpha)), "--size", str(SIZE), "--renderer", renderer]
    command += ["--timing-rounds", TIMING_ROUNDS, "--timing-size", str(SIZE), "--out", folder]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode:
        raise CompareError(done.stdout.decode()[-600:])
    return add_compared(json.loads((folder / "metrics.json").read_text(encoding="utf-8")), folder)


def add_compared(rows, folder):
    """The rows by method, each with `psnr_between`, that of the pixels that are compared between renderers, and its
    `picture` of these pixels, exposed."""
    reference = metrics.read_rgb(f"{folder}/reference.exr")
    mask = metrics.sphere_mask(reference.shape[0])
    exposure = metrics.exposure_of(reference, mask)
    mask &= reference.min(axis=-1) >= LEAST_COMPARED_RADIANCE
    for row in rows:
        if row["method"] != "reference":
            picture = metrics.read_rgb(f"{folder}/{row['method']}.exr")
            row["psnr_between"] = metrics.psnr(picture, reference, exposure, mask)
            row["picture"] = exposure * picture[mask]
    return {row["method"]: row for row in rows}


def check_between(count, name, rows):
    """`rows`: a method's row of each renderer."""
    found = [min(row["psnr_between"], LEAST_SELF_AGREEMENT) for row in rows]
    spread = max(found) - min(found)
    count.check(f"{name}, between renderers", spread <= MOST_BETWEEN_RENDERERS, f"{spread:.3f} dB")
    pairs = itertools.combinations([row["picture"] for row in rows], 2)
    agreement = min(-10.0 * np.log10(np.mean((one - other) ** 2) + 1e-30) for one, other in pairs)
    count.check(f"{name}, pictures of renderers", agreement >= LEAST_AGREEMENT_OF_RENDERERS, f"{agreement:.1f} dB")


def check_case(count, case, rows_by_renderer):
    """`rows_by_renderer`: of each renderer, the case's rows."""
    environment, alpha = case
    name = f"ward ({alpha}), {pathlib.Path(environment).stem}"
    bounds = {"gmm8": LEAST_PSNR[alpha], **(LEAST_PSNR_OF_RIVALS if case == RIVALS_CASE else {})}
    for method, bound in bounds.items():
        for renderer, rows in rows_by_renderer.items():
            psnr = rows[method]["psnr"]
            count.check(f"{name}, {method}, {renderer}", psnr >= bound, f"{psnr:.2f} dB")
        if len(rows_by_renderer) > 1:
            check_between(count, f"{name}, {method}", [rows[method] for rows in rows_by_renderer.values()])
    agreement = next(iter(rows_by_renderer.values()))["reference"]["psnr"]
    count.check(f"{name}, reference", agreement >= LEAST_SELF_AGREEMENT, f"{agreement:.1f} dB")


def check_command(count, rows, in_one_run):
    """./dev compare finds what the list of comparisons found, and times of what it was asked to time."""
    for method in ("gmm8", *LEAST_PSNR_OF_RIVALS):
        figures = [found[method]["psnr"] for found in (rows, in_one_run)]
        count.check(f"./dev compare, {method}", abs(figures[0] - figures[1]) < 0.01, "{:.3f} and {:.3f} dB".format(*figures))
        row = rows[method]
        timed = row["gpu_ms"] > 0.0 and row["gpu_ms_ratio"] > 0.0 and (method != "gmm8" or row["gpu_ms_ratio"] == 1.0)
        count.check(f"./dev compare, times of {method}", timed, f"{row['gpu_ms']} ms, {row['gpu_ms_ratio']} of gmm8")
    untimed = rows["reference"]["gpu_ms"] is None and rows["reference"]["gpu_ms_ratio"] is None
    count.check("./dev compare, no time of the reference", untimed, str(rows["reference"]["gpu_ms"]))


def main():
    count = Count()
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for renderer in RENDERERS:
            own = pathlib.Path(folder) / renderer
            own.mkdir()
            try:
                found[renderer] = compare_all(renderer, own)
            except (CompareError, metrics.MetricError) as error:
                count.check(f"drawing in {renderer}", False, str(error))
        for case in CASES:
            rows_by_renderer = {renderer: rows[case] for renderer, rows in found.items() if case in rows}
            if rows_by_renderer:
                check_case(count, case, rows_by_renderer)
        own = pathlib.Path(folder) / "command"
        try:
            rows = compare_by_command(*RIVALS_CASE, RENDERERS[0], own)
            check_command(count, rows, found[RENDERERS[0]][RIVALS_CASE])
        except (CompareError, KeyError) as error:
            count.check("./dev compare", False, str(error))
    print(f"accuracy: {count.passed} passed, {count.failed} failed")
    return 1 if count.failed else 0


if __name__ == "__main__":
    sys.exit(main())
