#!/usr/bin/env python3
"""What refinement gains: ./dev compare with gmm8 and gmm8r on the maps that are named, material by material.

    python3 tools/compare/refinement.py MAP… [--size N] [--json FILE]

Prints dB without and with refinement for each map and material, and the mean gain of each material.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
MATERIALS = [
    *(("ward", alpha) for alpha in ("0.05,0.05", "0.1,0.1", "0.2,0.2", "0.5,0.5")),
    *(("ggx", alpha) for alpha in ("0.05,0.05", "0.1,0.1", "0.3,0.3")),
    ("ward", "0.05,0.2"),
    ("ggx", "0.05,0.2"),
]
METHODS = ("gmm8", "gmm8r")


def psnr(environment, brdf, alpha, size):
    """dB of METHODS, in their order; raises CalledProcessError with the command's output."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [ROOT / "dev", "compare", "--env", environment, "--brdf", brdf, "--alpha", alpha]
            + ["--methods", ",".join(METHODS), "--size", str(size), "--timing-rounds", "0", "--out", folder],
            check=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        rows = json.loads((pathlib.Path(folder) / "metrics.json").read_text(encoding="utf-8"))
    found = {row["method"]: row["psnr"] for row in rows}
    return [found[method] for method in METHODS]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("maps", nargs="+", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=96)
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    rows = []
    for brdf, alpha in MATERIALS:
        gains = []
        for environment in options.maps:
            try:
                plain, refined = psnr(environment.resolve(), brdf, alpha, options.size)
            except subprocess.CalledProcessError as error:
                sys.exit(f"{environment}: {error.stdout.decode()[-600:]}")
            gains.append(refined - plain)
            rows.append({"map": environment.stem, "brdf": brdf, "alpha": alpha, "gmm8": plain, "gmm8r": refined})
            print(f"{brdf:5} {alpha:10} {environment.stem:14} {plain:6.2f} {refined:6.2f} {gains[-1]:+6.2f}", flush=True)
        print(f"{brdf:5} {alpha:10} mean gain {sum(gains) / len(gains):+.2f} dB, least {min(gains):+.2f}", flush=True)
    gains = [row["gmm8r"] - row["gmm8"] for row in rows]
    print(f"all: mean gain {sum(gains) / len(gains):+.2f} dB, least {min(gains):+.2f}, most {max(gains):+.2f}")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
