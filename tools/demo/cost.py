"""What a frame of the demo asks of the shader units of two phones' GPUs: `./dev demo --cost`.

    time = sum over surfaces (pixels · instructions a pixel) / (ALUs · clock)

Pixels are those that each surface covers in the demo's picture (demo/commands/coverage.gd), instructions those that Mesa's
compilers make of the surface's shader (rows of `./dev mobile-cost`). Writes README.md and results.json.
"""

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path

# The Galaxy S4's screen. Pixels.
SCREEN = (1920, 1080)
BACKDROP, SHADOWS = "Backdrop", "Shadows"


@dataclass(frozen=True)
class Gpu:
    """`alus`: scalar multiply-adds a clock, the least and the most that is published; `clock` in MHz; `rate`: both in words."""

    name: str
    label: str
    renderer: str
    alus: tuple[int, int]
    clock: int
    rate: str


GPUS = (
    Gpu("adreno320", "Adreno 320, Compatibility (2012; Galaxy S4)", "gl_compatibility", (64, 96), 450,
        "64 to 96 units at 450 MHz (57.6 to 86.4 GFLOPS)"),
    Gpu("adreno630", "Adreno 630, Mobile (2018; Snapdragon 845)", "mobile", (512, 512), 710,
        "512 units at 710 MHz (727 GFLOPS)"),
)  # fmt: skip
RATES = "Wikipedia's article *Adreno*, not Qualcomm's own; of the Adreno 320's units it has no certain number"
# Frames a second that Töral 2015 reports on a Galaxy S4, by lobes.
THESIS = {8: 30, 16: 20}

# Rows of `./dev mobile-cost` whose sum is a surface's shader, with 8 lobes; for 16, those of SIXTEEN besides.
ISOTROPIC = {"gmm8_set_isotropic": 1}
ANISOTROPIC = {"gmm8_set": 1}
SURFACES = {
    "Disc": ANISOTROPIC,
    "Teapot": ISOTROPIC,
    "Vase": {"gmm8_dielectric": 1},
    "Knot": ISOTROPIC,
    "Pebble": {"gmm8_coat_isotropic": 1},
    "Torus": ANISOTROPIC,
    "Plinth": ISOTROPIC,
    BACKDROP: {"empty_backdrop": 1},
    SHADOWS: {"empty_shadow": 1},
}
MORE_ISOTROPIC = {"gmm16_isotropic": 1, "gmm8_isotropic": -1}
MORE_ANISOTROPIC = {"gmm16": 1, "gmm8": -1}
SIXTEEN = {
    "Disc": MORE_ANISOTROPIC,
    "Teapot": MORE_ISOTROPIC,
    "Vase": MORE_ANISOTROPIC,
    "Knot": MORE_ISOTROPIC,
    # The base and the coat.
    "Pebble": {"gmm16_isotropic": 2, "gmm8_isotropic": -2},
    "Torus": MORE_ANISOTROPIC,
    "Plinth": MORE_ISOTROPIC,
}
VARIANTS = sorted({name for parts in (*SURFACES.values(), *SIXTEEN.values()) for name in parts})


class Problem(Exception):
    """One sentence for the user."""


def instructions(rows: dict, gpu: Gpu, surface: str, lobes: int) -> int:
    """Instructions a pixel of a surface."""
    parts = [SURFACES[surface]] + ([SIXTEEN[surface]] if lobes == 16 and surface in SIXTEEN else [])
    total = 0
    for part in parts:
        for variant, count in part.items():
            if (gpu.name, variant) not in rows:
                raise Problem(f"{variant} was not measured on {gpu.name}.")
            total += count * rows[gpu.name, variant]["instructions"]
    return total


def frame(rows: dict, gpu: Gpu, layout: dict, lobes: int) -> dict:
    """A frame's instructions by surface, and the milliseconds that they take at the most and the fewest ALUs."""
    pixels = SCREEN[0] * SCREEN[1]
    surfaces = []
    for name, share in layout["shares"].items():
        if name not in SURFACES:
            raise Problem(f"the demo's surface {name} has no rows in tools/demo/cost.py.")
        count = instructions(rows, gpu, name, lobes)
        surfaces.append({"surface": name, "share": share, "instructions": count, "total": count * share * pixels})
    total = sum(surface["total"] for surface in surfaces)
    slowest, fastest = (1e3 * total / (alus * gpu.clock * 1e6) for alus in gpu.alus)
    return {
        "gpu": gpu.name, "renderer": gpu.renderer, "layout": layout["layout"], "lobes": lobes,
        "instructions": total, "milliseconds": [fastest, slowest], "surfaces": surfaces,
    }  # fmt: skip


def span(low: float, high: float, form: str = ".0f") -> str:
    first, last = format(low, form), format(high, form)
    return first if first == last else f"{first}–{last}"


def write_report(frames: list[dict], mesa: str, out: Path) -> None:
    lines = [
        "# What a frame of the demo asks of two phones",
        "",
        "Written by `./dev demo --cost`. **No phone was used.** Instructions a pixel are those of Mesa "
        f"{mesa}'s compilers, as in",
        "[mobile-cost](../mobile-cost/README.md); pixels are counted in the demo's own picture; their product over the",
        "published rate of the shader units is the time that the *shader units* would take if nothing else did.",
        "",
        "Assumed, and why a phone will differ:",
        "",
        f"- {SCREEN[0]} × {SCREEN[1]} pixels, the Galaxy S4's screen, no antialiasing, every pixel shaded once (opaque surfaces",
        "  come front to back), the interface not counted; vertices, which are some percent, neither.",
        "- One instruction a clock and unit, none of them waiting: fetches from caches and memory, bandwidth, heat and",
        "  Qualcomm's own compiler are not in these figures. They rank better than they predict.",
    ]
    lines += [f"- {gpu.label}: {gpu.rate}." for gpu in GPUS]
    lines += [f"- These rates are those of {RATES}."]
    lines += [
        "- Shaders with 16 lobes are those with 8 and the difference of the rows with 16 and with 8 lobes.",
        "- The thesis' figures are of another scene, drawn by another program: they tell the order of magnitude.",
        "",
        "| GPU | layout | lobes | million instructions | ms a frame | frames a second | thesis, Galaxy S4 |",
        "| --- | --- | ---: | ---: | ---: | ---: | ---: |",
    ]
    for entry in frames:
        gpu = next(gpu for gpu in GPUS if gpu.name == entry["gpu"])
        fastest, slowest = entry["milliseconds"]
        thesis = str(THESIS[entry["lobes"]]) if gpu.name == "adreno320" else "–"
        lines.append(
            f"| {gpu.label} | {entry['layout']} | {entry['lobes']} | {entry['instructions'] / 1e6:.0f} "
            f"| {span(fastest, slowest, '.1f')} | {span(1e3 / slowest, 1e3 / fastest)} | {thesis} |"
        )
    lines += ["", "## Where they go, landscape", "", "| surface | of the picture | " + " | ".join(
        f"{gpu.name}, {lobes} lobes" for gpu in GPUS for lobes in THESIS) + " |",
        "| --- | ---: | ---: | ---: | ---: | ---: |"]  # fmt: skip
    landscape = [entry for entry in frames if entry["layout"] == "landscape"]
    for index, surface in enumerate(landscape[0]["surfaces"]):
        counts = " | ".join(str(entry["surfaces"][index]["instructions"]) for entry in landscape)
        lines.append(f"| {surface['surface']} | {100 * surface['share']:.1f} % | {counts} |")
    lines += ["", "Instructions a pixel. *Shadows* are soft blots blended over the plinth."]
    write(out / "README.md", "\n".join(lines) + "\n")
    write(out / "results.json", json.dumps(frames, indent=1) + "\n")


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name("." + path.name)
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


def read_json(path: Path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Problem(f"{path}: cannot be read ({error}).") from error


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--variants", action="store_true", help="prints the rows of ./dev mobile-cost that are needed")
    parser.add_argument("--rows", type=Path, help="what ./dev mobile-cost --json wrote")
    parser.add_argument("--coverage", type=Path, help="what demo/commands/coverage.gd wrote")
    parser.add_argument("--out", type=Path, help="the folder for README.md and results.json")
    arguments = parser.parse_args()
    if arguments.variants:
        print(",".join(VARIANTS))
        return 0
    try:
        listed = read_json(arguments.rows)
        rows = {(row["gpu"], row["variant"]): row for row in listed}
        layouts = read_json(arguments.coverage)
        frames = [frame(rows, gpu, layout, lobes) for gpu in GPUS for layout in layouts for lobes in THESIS]
        write_report(frames, listed[0]["mesa"], arguments.out)
    except Problem as problem:
        print(f"demo: {problem}", file=sys.stderr)
        return 1
    for entry in frames:
        print(f"{entry['gpu']} {entry['layout']} {entry['lobes']} lobes: "
              f"{span(*entry['milliseconds'], '.1f')} ms of the shader units")  # fmt: skip
    return 0


if __name__ == "__main__":
    sys.exit(main())
