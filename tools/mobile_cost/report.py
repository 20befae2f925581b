"""The report of ./dev mobile-cost: README.md, results.json, results.csv and cost.svg."""

import csv
import io
import json

import figures
from gpus import GPUS

COLUMNS = (
    "gpu renderer variant instructions own registers texture nops move alu special full half waves static unknown_loops"
    " cycles vertex mesa"
).split()
# (GPU, variant, figure, at most).
GOALS = (
    ("adreno630", "gmm8", "instructions", 480),
    ("adreno630", "gmm8", "registers", 14),
    ("adreno630", "gmm4", "instructions", 360),
    ("adreno630", "gmm8_isotropic", "instructions", 420),
    ("adreno320", "gmm8", "instructions", 850),
)
GOAL_GPU = "adreno630"
# What a layer or another kind of surface may add to the metal of a ready set.
LAYERS = (
    ("gmm8_coat", "gmm8_set", 160),
    ("gmm8_coat_isotropic", "gmm8_set_isotropic", 160),
    ("gmm8_dielectric", "gmm8_set", 60),
)
MALI_WITH_COAT = 60
# Directions from uniforms serve materials whose widths are the same all over; the other samples per pixel.
QUARTERS = (("gmm8", "fis40"), ("gmm8", "fis40_ggx"))
# What the first probe may add.
PROBES = (("gmm8_probe", "gmm8"), ("gmm8_probe_isotropic", "gmm8_isotropic"))
MOST_WITH_PROBE = 1.25


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| --- |" + " ---: |" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def _exactly(row):
    return f"{'≥ ' if row['unknown_loops'] else ''}{row['instructions']}"


def _own(row):
    # The unshaded one is less than the base.
    return row["own"] if row["own"] >= 0 else "–"


def adreno_table(rows, variants):
    head = ["variant", "instructions", "own", "of them nops", "special", "fetches", "registers", "waves", "vertex"]
    return table(
        head,
        [
            [variants[r["variant"]]["label"], _exactly(r), _own(r), r["nops"], r["special"], r["texture"], r["registers"]]
            + [r["waves"], r["vertex"]]
            for r in rows
        ],
    )


def mali_table(rows, variants):
    head = ["variant", "instructions", "own", "cycles", "busiest units (cycles)", "registers", "threads", "vertex"]

    def units(row):
        busiest = sorted(row["units"].items(), key=lambda unit: -unit[1])[:3]
        return ", ".join(f"{name} {cycles:.1f}" for name, cycles in busiest)

    return table(
        head,
        [
            [variants[r["variant"]]["label"], _exactly(r), _own(r), f"{r['cycles']:.1f}", units(r), r["registers"]]
            + [r["waves"], r["vertex"]]
            for r in rows
        ],
    )


def goals(rows):
    """[(sentence, reached)] of what can be told from these rows."""
    found = {row["variant"]: row for row in rows if row["gpu"] == GOAL_GPU}
    told = []
    values = {(row["gpu"], row["variant"]): row for row in rows}
    for gpu, variant, figure, most in GOALS:
        if (gpu, variant) in values:
            value = values[gpu, variant][figure]
            told.append((f"{GPUS[gpu].label}, {variant}: {value} {figure}, at most {most} wanted", value <= most))
    for name, without, most in LAYERS:
        if name in found and without in found:
            more = found[name]["instructions"] - found[without]["instructions"]
            told.append((f"{name} over {without}: {more} instructions more, at most {most} wanted", more <= most))
    mali = values.get(("mali-g610", "gmm8_coat"))
    if mali:
        cycles = mali["units"]["ls"]
        sentence = f"{GPUS['mali-g610'].label}, gmm8_coat: {cycles:g} load/store cycles, at most {MALI_WITH_COAT} wanted"
        told.append((sentence, cycles <= MALI_WITH_COAT))
    for name, rival in QUARTERS:
        if name in found and rival in found:
            share = found[name]["instructions"] / found[rival]["instructions"]
            told.append((f"{name} over {rival}: {share:.3f} of the instructions, less than 0.25 wanted", share < 0.25))
    for name, without in PROBES:
        if name in found and without in found:
            ratio = found[name]["instructions"] / found[without]["instructions"]
            text = f"{name} over {without}: {ratio:.2f} of the instructions, at most {MOST_WITH_PROBE} wanted"
            told.append((text, ratio <= MOST_WITH_PROBE))
    return told


def summary(rows, variants):
    lines = []
    for gpu in dict.fromkeys(row["gpu"] for row in rows):
        lines.append(f"{GPUS[gpu].label}, {GPUS[gpu].renderer}:")
        for row in rows:
            if row["gpu"] == gpu:
                label = variants[row["variant"]]["label"]
                lines.append(f"  {label:64} {_exactly(row):>6} instructions {row['registers']:3} registers {row['waves']:3} waves")
    lines += [f"{'reached' if reached else 'MISSED '}  {sentence}" for sentence, reached in goals(rows)]
    return "\n".join(lines)


INTRODUCTION = """# What a pixel costs on phones

![Instructions of every variant](cost.svg)

Written by `./dev mobile-cost`: statistics of Mesa {mesa}'s shader compilers for shaders as the engine
hands them to the driver, without a phone. They rank variants; they are not milliseconds, and Qualcomm's and Arm's own
compilers will differ.

- *instructions*: issue slots of the fragment shader, repeats and nops included, as the compiler counts them. What is listed
  was counted again from the listing and equals the compiler's totals (slots, nops, categories, loops, registers).
  The preamble, which runs once a draw, is left out. Instructions of loops count as often as the loop runs; “≥” marks loops
  whose trips the listing does not tell.
- *own*: without what the engine's scene shader takes for an empty material of the same render mode.
- *registers*: of four 32-bit numbers; from Adreno 6xx on 16-bit ones lie in them. *waves*: how many the GPU keeps in flight.
- The scene is one sphere under a sky, without lights, fog or decals: Mobile's pipelines are specialised to it, as on a phone,
  and Compatibility's programs are its variant for that. Mesa uses no half floats on Adreno 320.
- *vertex*: instructions of the vertex shader.
- *ready set*: tables of addons/lobelight/tables, with what goes with them for energy; the others have a table of their own.
  Rivals are the shaders of bake/comparators in a material like ours. FIS has Ward's samples from uniforms, which works where
  the widths are the same all over, or GGX's visible normals, sampled per pixel. The others, too, have widths that are the same
  all over; majoraxis and the split sum fetch from maps that were filtered beforehand.
"""


def versions(rows):
    return " and ".join(sorted({row["mesa"] for row in rows}))


def readme(rows, variants):
    parts = [INTRODUCTION.format(mesa=versions(rows))]
    told = goals(rows)
    if told:
        parts.append("## Goals (Adreno in Mobile, Adreno 320 in Compatibility)\n")
        parts.append("\n".join(f"- {sentence}: {'reached' if reached else '**missed**'}" for sentence, reached in told) + "\n")
    for name in dict.fromkeys(row["gpu"] for row in rows):
        gpu = GPUS[name]
        of_gpu = [row for row in rows if row["gpu"] == name]
        renderer = {"mobile": "Mobile", "gl_compatibility": "Compatibility"}[gpu.renderer]
        parts.append(f"## {gpu.label}, {renderer} ({gpu.phones})\n")
        parts.append((mali_table if gpu.family == "mali" else adreno_table)(of_gpu, variants) + "\n")
    return "\n".join(parts)


def comma_separated(rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, extrasaction="ignore", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def write_all(folder, rows, variants, write):
    write(folder / "results.json", json.dumps(rows, indent=1) + "\n")
    write(folder / "results.csv", comma_separated(rows))
    figures.cost(rows, variants, folder / "cost.svg")
    write(folder / "README.md", readme(rows, variants))
