#!/usr/bin/env python3
"""How far ./dev compare finds eight lobes from the reference, on three maps, in every renderer.

The bounds are the project's promise, not yesterday's figures: 30 dB for Ward (0.1, 0.1), 29 dB for
Ward (0.05, 0.2), renderers within 0.3 dB of one another, a reference that agrees with itself to 55 dB.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAPS = ["demo/environments/hall.exr", "demo/environments/sunset.exr", "tests/data/forest.exr"]
RENDERERS = ["mobile", "gl_compatibility", "forward_plus"]
LEAST_PSNR = {"0.1,0.1": 30.0, "0.05,0.2": 29.0}
MOST_BETWEEN_RENDERERS = 0.3
LEAST_SELF_AGREEMENT = 55.0
SIZE = "64"


class Count:
    """Prints one line a check and counts them."""

    def __init__(self):
        self.passed = self.failed = 0

    def check(self, name, passed, figure):
        self.passed += passed
        self.failed += not passed
        print(f"  {name}: {'passed' if passed else 'FAILED'}, {figure}", flush=True)


def compare(environment, alpha, renderer, folder):
    """The rows of metrics.json by method; raises CalledProcessError with the command's output."""
    subprocess.run(
        [ROOT / "dev", "compare", "--env", ROOT / environment, "--brdf", "ward", "--alpha", alpha]
        + ["--methods", "gmm8,reference", "--size", SIZE, "--renderer", renderer, "--out", folder],
        check=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    rows = json.loads((pathlib.Path(folder) / "metrics.json").read_text(encoding="utf-8"))
    return {row["method"]: row for row in rows}


def main():
    count = Count()
    for environment in MAPS:
        for alpha, least in LEAST_PSNR.items():
            case = f"ward ({alpha}), {pathlib.Path(environment).stem}"
            found = []
            for renderer in RENDERERS:
                with tempfile.TemporaryDirectory() as folder:
                    try:
                        rows = compare(environment, alpha, renderer, folder)
                    except subprocess.CalledProcessError as error:
                        count.check(f"{case}, {renderer}", False, error.stdout.decode()[-600:])
                        continue
                found.append(rows["gmm8"]["psnr"])
                count.check(f"{case}, {renderer}", found[-1] >= least, f"{found[-1]:.2f} dB")
            if found:
                spread = max(found) - min(found)
                count.check(f"{case}, between renderers", spread <= MOST_BETWEEN_RENDERERS, f"{spread:.3f} dB")
                agreement = rows["reference"]["psnr"]
                count.check(f"{case}, reference", agreement >= LEAST_SELF_AGREEMENT, f"{agreement:.1f} dB")
    print(f"accuracy: {count.passed} passed, {count.failed} failed")
    return 1 if count.failed else 0


if __name__ == "__main__":
    sys.exit(main())
