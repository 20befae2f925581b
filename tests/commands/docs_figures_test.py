"""Figures in the pages are those of the reports that they name, and the README's are those of the pages.

The last line is "docs-figures: N passed, N failed".
"""

import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

A630 = "adreno630"
A320 = "adreno320"


def row(label: str, *variants: str) -> tuple[str, list[tuple[str, str]]]:
    """A line of a table: the label, the variants on the one GPU and on the other."""
    cell = " / ".join(["{}"] * len(variants))
    return f"| {label} | {cell} | {cell} |", [(gpu, variant) for gpu in (A320, A630) for variant in variants]


def on(gpu: str, phrase: str, *variants: str) -> tuple[str, list[tuple[str, str]]]:
    return phrase, [(gpu, variant) for variant in variants]


# Instructions: by page, phrases with a brace for each of docs/report/mobile-cost.
INSTRUCTIONS: dict[str, list[tuple[str, list[tuple[str, str]]]]] = {
    "README.md": [
        on(A630, "8 isotropic lobes {}, 4 anisotropic ones {}, 8 of them {};", "gmm8_isotropic", "gmm4", "gmm8"),
        on(A630, "`StandardMaterial3D` {}, with anisotropy {};", "stock", "stock_anisotropic"),
        on(A630, "importance sampling with 40 samples {} and more", "fis40"),
    ],
    "docs/android.md": [
        row("`StandardMaterial3D`, metallic, with anisotropy", "stock_anisotropic"),
        row("8 lobes, isotropic", "gmm8_isotropic"),
        row("8 lobes, anisotropic", "gmm8"),
        (
            "| 8 lobes, anisotropic, first probe | {} and more | {} and more |",
            [(A320, "gmm8_probe"), (A630, "gmm8_probe")],
        ),
    ],
    "docs/brushed-metal.md": [
        on(
            A630,
            "8 lobes of the table take {} instructions a pixel, 12 without a table {}, 24 take {} and 40 take {}",
            "gmm8",
            "line12",
            "line24",
            "line40",
        ),
    ],
    "docs/compared.md": [
        on(A630, "takes {} instructions on an Adreno 630, eight anisotropic lobes {}", "splitsum", "gmm8"),
    ],
    "docs/cost.md": [
        row("`StandardMaterial3D`, metallic", "stock"),
        row("... with anisotropy", "stock_anisotropic"),
        row("4 lobes, isotropic / anisotropic", "gmm4_isotropic", "gmm4"),
        row("8 lobes, isotropic / anisotropic", "gmm8_isotropic", "gmm8"),
        row("8 anisotropic lobes and a clear coat", "gmm8_coat"),
        row("12 / 24 / 40 lobes without a table", "line12", "line24", "line40"),
        row("importance sampling, 40 samples, Ward / GGX", "fis40", "fis40_ggx"),
        row("split sum with a bent normal", "splitsum"),
        on(A630, "A normal map takes 8 anisotropic lobes to {}:", "gmm8_normal"),
        on(A630, "Disable Specular Occlusion* it is {}. An occlusion map takes them to {}.", "gmm8_normal_plain", "gmm8_ao"),
        on(A630, "take 8 lobes of GGX to {}, of Ward to {}.", "gmm8_sources", "gmm8_sources_ward"),
    ],
    "docs/own-shaders.md": [
        on(
            A630,
            "Adreno 630: {} for `lobelight_reflection` with `LOBELIGHT_ISOTROPIC`, {} with `LOBELIGHT_QUALITY` 8, and {} with 24,",
            "own_isotropic",
            "own_8",
            "own",
        ),
        on(
            A630,
            "`StandardMaterial3D`'s metal takes {}",
            "stock",
        ),
    ],
}

# Figures of other reports: the page, what it says, and how the report says it.
SAME_FIGURES = [
    ("docs/accuracy.md", r"third of its time: (\d+) of (\d+) checks", "docs/report/README.md", r"third of its time: (\d+) of (\d+) checks"),
    (
        "docs/accuracy.md",
        r"Of (\d+) pairs of a case and a time budget, Lobelight is the most accurate in (\d+), a rival in (\d+)",
        "docs/report/README.md",
        r"Of (\d+) pairs of a case and a time budget, Lobelight is the most accurate in (\d+), a rival in (\d+)",
    ),
    ("docs/accuracy.md", r"was reproduced in (\d+) of (\d+) cases", "docs/report/README.md", r"is reproduced in (\d+) of (\d+) cases"),
    (
        "docs/accuracy.md",
        r"lobes gain ([\d.]+) dB in the median .*? without, ([\d.]+) dB over",
        "docs/report/rooms/README.md",
        r"as the median, ([\d.]+) dB over .*? and ([\d.]+) dB over stock",
    ),
    ("docs/accuracy.md", r"which takes ([\d.]+) times as long", "docs/report/rooms/README.md", r"fis40 takes ([\d.]+) times as long"),
]


def words(path: str) -> str:
    return re.sub(r"\s+", " ", (ROOT / path).read_text(encoding="utf-8"))


def check_instructions(text: str, phrases: list[tuple[str, list[tuple[str, str]]]], counted: dict[tuple[str, str], int]) -> list[str]:
    problems = []
    for phrase, places in phrases:
        expected = phrase.format(*(counted[place] for place in places))
        if expected not in text:
            problems.append(f"has not “{expected}”")
    return problems


def check_same(text: str, pattern: str, report: str, pattern_of_report: str) -> list[str]:
    there = re.search(pattern_of_report, report)
    here = re.search(pattern, text)
    if there is None or here is None:
        return [f"nothing like “{pattern if here is None else pattern_of_report}”"]
    return [] if here.groups() == there.groups() else [f"says {here.groups()}, the report {there.groups()}"]


def accuracy_table(path: str) -> list[str]:
    lines = (ROOT / path).read_text(encoding="utf-8").splitlines()
    return [line for line in lines if re.match(r"\| (Ward \(|by itself|importance sampling, 40 / the thesis)", line)]


def main() -> int:
    rows = json.loads((ROOT / "docs/report/mobile-cost/results.json").read_text(encoding="utf-8"))
    counted = {(entry["gpu"], entry["variant"]): entry["instructions"] for entry in rows}
    results = {f"instructions in {page}": check_instructions(words(page), phrases, counted) for page, phrases in INSTRUCTIONS.items()}
    for page, pattern, report, pattern_of_report in SAME_FIGURES:
        results[f"{page}: {pattern}"] = check_same(words(page), pattern, words(report), pattern_of_report)
    tables = accuracy_table("README.md"), accuracy_table("docs/accuracy.md")
    results["the README's accuracy is that of its page"] = [] if tables[0] == tables[1] and len(tables[0]) == 9 else ["they differ"]
    # The test itself: a wrong figure is found.
    wrong = check_instructions(words("docs/compared.md"), INSTRUCTIONS["docs/compared.md"], {place: 1 for place in counted})
    results["a wrong count is found"] = [] if wrong else ["it is not"]
    results["a wrong share is found"] = [] if check_same("2 of 3", r"(\d) of (\d)", "2 of 4", r"(\d) of (\d)") else ["it is not"]
    failed = 0
    for name, problems in results.items():
        failed += bool(problems)
        print(f"{name}: {'FAILED, ' + '; '.join(problems) if problems else 'passed'}")
    print(f"docs-figures: {len(results) - failed} passed, {failed} failed")
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
