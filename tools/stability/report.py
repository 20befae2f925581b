"""The report of ./dev stability: worst.csv, README.md and heat maps, written to a folder as a whole."""

import csv
import io
import math
from collections import defaultdict
from pathlib import Path

import figures

GROUP_TITLES = {
    "gaussian": "Spherical Gaussians against 50 digits",
    "brdf": "Reflectances against 50 digits",
    "step": "One step of EM against 50 digits",
    "slice": "Slices and their fits; energy against quadrature",
    "data": "Awkward data",
    "shader": "The shader's formulas in single precision",
    "table": "Whole tables; energy against quadrature",
    "storage float": "Tables decoded in single precision",
    "storage half": "Tables as half floats",
    "storage byte": "Tables as bytes (slope/α in [−4, 4])",
    "look-up": "Looking up between views",
}
# Of each group, BRDF and alpha (or function): how many cases, and the worst of each figure. --json has every case.
COLUMNS = (
    "group",
    "subject",
    "alpha",
    "lobes",
    "cases",
    "failed",
    "error",
    "error_bound",
    "unit",
    "energy_error",
    "energy_bound",
    "iterations",
    "fit_error",
    "standard_deviations",
    "beyond_range",
)


def number(value):
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    return f"{value:.2g}" if isinstance(value, float) else str(value)


def table_rows(results):
    """One row for each group: count, failures, and the worst of each figure relative to its bound."""
    groups = defaultdict(list)
    for result in results:
        groups[result["group"]].append(result)
    for group, title in GROUP_TITLES.items():
        cases = groups.pop(group, [])
        if not cases:
            continue
        worst = max(cases, key=lambda case: case["error"] / (case["error_bound"] or math.inf))
        energies = [case for case in cases if case["energy_error"] is not None]
        energy = max(energies, key=lambda case: case["energy_error"] / case["energy_bound"], default=None)
        yield [
            title,
            len(cases),
            sum(not case["passed"] for case in cases),
            f"{number(worst['error'])} ({worst['unit']})" if worst["unit"] else "–",
            number(worst["error_bound"]) if worst["unit"] else "–",
            worst["name"] if worst["unit"] else "–",
            number(energy["energy_error"]) if energy else "–",
            number(energy["energy_bound"]) if energy else "–",
            max(case["iterations"] for case in cases) or "–",
        ]


def markdown_table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]


def worst_of(results, group, key):
    cases = [case for case in results if case["group"] == group and case.get(key) is not None]
    return max(cases, key=lambda case: case[key], default=None)


def limits(results):
    """Sentences on what storage costs at the extremes, from this run."""
    half = worst_of(results, "storage half", "standard_deviations")
    byte = worst_of(results, "storage byte", "standard_deviations")
    beyond = worst_of(results, "storage byte", "beyond_range")
    single = worst_of(results, "storage float", "standard_deviations")
    fits = [case for case in results if case["group"] == "slice" and case.get("lobes") == 8]
    capped = sum(case["iterations"] >= 200 for case in fits)
    sentences = []
    for case, form in ((single, "Single precision"), (half, "Half floats"), (byte, "Bytes")):
        if case:
            sentences.append(
                f"{form}: a mean moves by at most {number(case['standard_deviations'])} standard deviations of its"
                f" lobe ({case['name']})."
            )
    if beyond:
        sentences.append(
            f"Bytes clamp slopes at 4 α: at most {100 * beyond['beyond_range']:.0f} % of a view's energy is in"
            f" lobes beyond ({beyond['name']}); these are not counted above."
        )
    sentences.append(f"{capped} of {len(fits)} fits of eight lobes stop at the limit of iterations.")
    return sentences


def readme(results, pictures):
    failed = [case for case in results if not case["passed"]]
    lines = [
        "# Stability",
        "",
        "Written by `./dev stability`; the worst of each material is a row of [worst.csv](worst.csv), and `--json FILE`"
        " writes every case. Errors are the worst of a group relative to their bound; energies are relative to the"
        " directional albedo.",
        "",
        f"**{len(results) - len(failed)} cases passed, {len(failed)} failed.**",
        "",
    ]
    header = ("group", "cases", "failed", "error", "bound", "where", "energy", "bound", "iterations ≤")
    lines += markdown_table(header, table_rows(results))
    if failed:
        lines += ["", "## Failed", ""] + [f"- {case['name']}: {case['reason']}" for case in failed]
    lines += ["", "## What storage and iterations cost at the extremes", ""]
    lines += [f"- {sentence}" for sentence in limits(results)]
    for name, caption in pictures:
        lines += ["", f"## {caption}", "", f"![{caption}]({name})"]
    return "\n".join(lines) + "\n"


def worst_csv(results):
    groups = defaultdict(list)
    for case in results:
        alpha = " ".join(f"{width:g}" for width in case.get("alpha", []))
        subject = case.get("brdf") or case.get("function", "")
        groups[case["group"], subject, alpha, case.get("lobes", "")].append(case)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for key, cases in groups.items():
        worst = max(cases, key=lambda case: case["error"] / (case["error_bound"] or math.inf))
        row = {"cases": len(cases), "failed": sum(not case["passed"] for case in cases), "unit": worst["unit"]}
        row |= {"error": worst["error"], "error_bound": worst["error_bound"]}
        for name in COLUMNS[9:]:
            row[name] = max((case[name] for case in cases if case.get(name) is not None), default="")
        row |= dict(zip(COLUMNS[:4], key))
        writer.writerow([f"{row[c]:.3g}" if isinstance(row[c], float) else row[c] for c in COLUMNS])
    return text.getvalue()


def write(results, folder):
    """README.md, worst.csv and the heat maps below `folder`."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    pictures = figures.draw(results, folder)
    for name, text in (("worst.csv", worst_csv(results)), ("README.md", readme(results, pictures))):
        temporary = folder / f"{name}.tmp"
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(folder / name)
