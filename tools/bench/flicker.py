"""Puts what bench_flicker.gd measured in three renderers together, and judges it: flicker.py FOLDER [JSON]."""

import json
import os
import sys
from pathlib import Path

RENDERERS = ["forward_plus", "mobile", "gl_compatibility"]
LEAST_GAIN = 3.0


def judge(results: list[dict]) -> list[str]:
    """What the baked material fails at, in a sentence each; empty if it keeps all it promises."""
    by = {(r["renderer"], r["method"]): r for r in results}
    standard = by["forward_plus", "standard"]
    problems = []
    for renderer in RENDERERS:
        baked = by[renderer, "baked"]
        for figure, name in [("jumping", "pixels that jump"), ("mean_difference", "mean difference")]:
            if baked[figure] > standard[figure]:
                problems.append(f"{renderer}: {name} {baked[figure]:.5g}, Godot's in Forward+ {standard[figure]:.5g}")
        gain = baked["psnr"] - by[renderer, "without"]["psnr"]
        if gain < LEAST_GAIN:
            problems.append(f"{renderer}: {gain:.2f} dB more than without, not {LEAST_GAIN:g}")
    return problems


def main(folder: str, path: str | None) -> int:
    results = [part for renderer in RENDERERS for part in json.loads(Path(folder, f"{renderer}.json").read_text())]
    if path is not None:
        target = Path(os.environ.get("LOBELIGHT_CWD", ".")) / path
        try:
            target.with_suffix(".part").write_text(json.dumps(results, indent="\t") + "\n")
            target.with_suffix(".part").replace(target)
        except OSError as error:
            print(f"error: bench flicker: {target} cannot be written: {error.strerror}", file=sys.stderr)
            return 1
    problems = judge(results)
    print("\n".join(problems) or "No more flicker than Godot's material in Forward+ has, and closer to the truth.")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None))
