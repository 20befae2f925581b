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
    "table": "Whole tables; energy against quadrature",
    "storage half": "Tables as half floats",
    "look-up": "Looking up between views, in the library",
}
SHADER_TITLES = {
    "shader bits": "Numbers there and back",
    "shader level": "Level of the pyramid",
    "shader decode": "Texel to lobe",
    "shader position": "Place in a table",
    "shader line": "Lobes without a table",
    "shader frame": "Tangent frames",
    "shader view": "View in tangent space",
    "shader widths": "Widths of a set",
    "shader occlusion": "Occlusion of lobes",
    "shader coordinates": "Coordinates",
    "shader fades": "Fades",
    "shader antialiasing": "Variance of normals",
    "shader look-up": "Lobes of any view",
    "shader reflection": "Reflected light",
    "shader coat": "Clear coat",
    "shader sheen": "Sheen",
    "shader sources": "Sources",
    "shader diffuse": "Diffuse light",
    "shader placed light": "Lights of a place",
    "shader material": "Whole materials",
    "shader own": "Functions for shaders of others",
    "shader colour": "Colours",
    "shader half": "Half floats",
    "shader faces": "Faces of cube maps",
    "shader panorama": "Panoramas",
    "shader pyramid": "Levels of the pyramid",
    "shader views": "Captured views",
    "shader pack": "Levels as bytes",
}
RENDERER_TITLES = {"mobile": "Mobile", "gl_compatibility": "Compatibility", "forward_plus": "Forward+"}
# Of each group, BRDF and alpha (or function or renderer): how many cases, and the worst of each figure. --json has every case.
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
)


def number(value):
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    return f"{value:.2g}" if isinstance(value, float) else str(value)


def worst_case(cases):
    return max(cases, key=lambda case: case["error"] / (case["error_bound"] or math.inf))


def worst_energy(cases):
    energies = [case for case in cases if case["energy_error"] is not None]
    return max(energies, key=lambda case: case["energy_error"] / case["energy_bound"], default=None)


def error_cells(cases):
    worst = worst_case(cases)
    if not worst["unit"]:
        return ["–", "–", "–"]
    return [f"{number(worst['error'])} ({worst['unit']})", number(worst["error_bound"]), worst["name"]]


def table_rows(results):
    """One row for each group of the library: count, failures, and the worst of each figure relative to its bound."""
    for group, title in GROUP_TITLES.items():
        cases = [case for case in results if case["group"] == group]
        if not cases:
            continue
        energy = worst_energy(cases)
        yield [
            title,
            len(cases),
            sum(not case["passed"] for case in cases),
            *error_cells(cases),
            number(energy["energy_error"]) if energy else "–",
            number(energy["energy_bound"]) if energy else "–",
            max(case["iterations"] for case in cases) or "–",
        ]


def renderer_of(case):
    title = RENDERER_TITLES.get(case.get("renderer"), "–")
    return f"{title}, halves" if case.get("precision") == "half" else title


def shader_rows(results):
    """One row for each group of the shaders and renderer."""
    for group, title in SHADER_TITLES.items():
        cases = defaultdict(list)
        for case in results:
            if case["group"] == group:
                cases[renderer_of(case)].append(case)
        for renderer, some in cases.items():
            yield [title, renderer, len(some), sum(not case["passed"] for case in some), *error_cells(some)]


def markdown_table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]


def worst_of(results, group, key):
    cases = [case for case in results if case["group"] == group and case.get(key) is not None]
    return max(cases, key=lambda case: case[key], default=None)


def limits(results):
    """Sentences on what storage costs at the extremes, from this run."""
    half = worst_of(results, "storage half", "standard_deviations")
    fits = [case for case in results if case["group"] == "slice" and case.get("lobes") == 8]
    capped = sum(case["iterations"] >= 200 for case in fits)
    sentences = []
    if half:
        sentences.append(
            f"Half floats: a mean moves by at most {number(half['standard_deviations'])} standard deviations of its lobe"
            f" ({half['name']})."
        )
    sentences.append(f"{capped} of {len(fits)} fits of eight lobes stop at the limit of iterations.")
    rounded = [case for case in results if case.get("precision") == "half"]
    if rounded:
        radians, deviations = (worst_of(rounded, "shader look-up", f"moved_{key}") for key in ("radians", "deviations"))
        light = max(rounded, key=lambda case: case.get("moved_light", 0.0))
        sentences.append(
            "Rounding all that is `mediump` to half floats, as phones may, moves a lobe's mean by at most"
            f" {number(radians['moved_radians'])} radians ({radians['name']}) or"
            f" {number(deviations['moved_deviations'])} standard deviations ({deviations['name']}), and changes the light"
            f" by at most {100 * light['moved_light']:.2g} % ({light['name']})."
        )
    return sentences


def readme(results, pictures):
    failed = [case for case in results if not case["passed"]]
    first_picture, pictures = [f"![{caption}]({name})\n" for name, caption in pictures[:1]], pictures[1:]
    lines = [
        "# Stability",
        "",
        *first_picture,
        f"**{len(results) - len(failed)} cases passed, {len(failed)} failed.**",
        "",
        "Written by `./dev stability`; the worst of each material is a row of [worst.csv](worst.csv), and `--json FILE`"
        " writes every case. Errors are the worst of a group relative to their bound; energies are relative to the"
        " directional albedo.",
        "",
    ]
    header = ("group", "cases", "failed", "error", "bound", "where", "energy", "bound", "iterations ≤")
    lines += markdown_table(header, table_rows(results))
    lines += [
        "",
        "## The shaders",
        "",
        "Functions of the shipped shaders, run in the engine on software drivers, their results read back bit by bit and held"
        " against 50 digits (levels of the pyramid against double precision). Bounds come from what Vulkan asks of"
        " single precision, from the filters' eight bits and from the approximations that the shaders state;"
        " they stand beside the judges in tools/stability. *Halves*: everything that is `mediump` rounded to a"
        " half float, as phones may; software drivers compute it with 32 bits.",
        "",
    ]
    header = ("group", "renderer", "cases", "failed", "error", "bound", "where")
    lines += markdown_table(header, shader_rows(results))
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
        subject = case.get("brdf") or case.get("function") or ("renderer" in case and renderer_of(case)) or ""
        groups[case["group"], subject, alpha, case.get("lobes", "")].append(case)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for key, cases in groups.items():
        worst = worst_case(cases)
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
