"""Sections of the page of `./dev report`: error against what methods cost beside a frame's time."""

import json
import math

import analysis
import cases
import document as doc
import figures
from analysis import Place
from page import decibels, joined, ratio, source_of

# Variants of ./dev mobile-cost by method, for equal and for different widths; GPU and renderer of its figures shown here.
PHONE_GPUS = (("adreno630", "mobile", "Adreno 630"), ("adreno740", "mobile", "Adreno 740"), ("adreno320", "gl_compatibility", "Adreno 320"))
PHONE_MATERIALS = (("ward", (0.1, 0.1)), ("ward", (0.05, 0.2)))
ANISOTROPIC_VARIANTS = {"stock": "stock_anisotropic"}
TORAL_TEXEL_BYTES = 16
# Six faces of half floats in four channels, a third more for the levels.
BYTES_OF_SIDE = 64


CHECKS = {
    "self": "itself, with twice the samples",
    "adaptive": "SciPy's adaptive cubature, an analytic map, single pixels",
    "cells": "Gauss–Legendre rules between all texels, single pixels",
    "mitsuba": "Mitsuba 3, the sphere",
    "teapot": "Mitsuba 3, the teapot without shadows",
}


def update_time(own, kind="prefilter_ms"):
    """Milliseconds for what a changed environment asks of a method, where plan.json says it: of the GPU, or by the clock
    with "prefilter_wall_ms"."""
    value = own["settings"].get(kind)
    return value if isinstance(value, (int, float)) and math.isfinite(value) and value > 0.0 else None


def phone_variant(method, material, variants):
    """The name of ./dev mobile-cost for a method's shader at a material."""
    if cases.is_isotropic(material):
        return f"{method}_isotropic" if f"{method}_isotropic" in variants else method
    return ANISOTROPIC_VARIANTS.get(method, method)


def study(page, name):
    return [e for e in page.entries if e["study"] == name and (e["device"], e["renderer"]) == (page.device, page.renderer)]


def toral_sizes(page, materials):
    sizes = []
    for material in dict.fromkeys(materials):
        entry = analysis.find(page.entries, Place(page.device, page.renderer, cases.TIMED_MAP, material))
        own = entry["methods"].get("toral8") if entry else None
        if own and "views" in own["settings"]:
            views = own["settings"]["views"]
            size = views[0] * views[1] * own["fetches"] * TORAL_TEXEL_BYTES
            sizes.append(f"{cases.material_name(material)} {size} bytes for {decibels(own['psnr'])} dB")
    return f" The thesis' texture (`toral8`): {joined(sizes)}." if sizes else ""


def tables_size(page):
    entries = study(page, "table")
    if not entries:
        return
    lines = {}
    for entry in entries:
        material = analysis.material_of(entry)
        for method, own in entry["methods"].items():
            size = own["settings"].get("table_bytes")
            if size and own["psnr"] is not None:
                panel = lines.setdefault(cases.material_name(material), {})
                panel.setdefault((method, ""), []).append((size, own["psnr"]))
    page.heading("Error against the table's size")
    page.text(
        "Views of the table, half floats, eight bytes for each lobe and view."
        + toral_sizes(page, [analysis.material_of(entry) for entry in entries])
    )
    page.figure("table_size.svg", f"PSNR against the table's bytes, {cases.TIMED_MAP}", entries, figures.curves, lines, "bytes")


def pyramids(page):
    sizes, filters = study(page, "pyramid"), study(page, "filter")
    if sizes:
        lines = {}
        for entry in sizes:
            panel = lines.setdefault(cases.material_name(analysis.material_of(entry)), {})
            for method, own in entry["methods"].items():
                if method != cases.REFERENCE and own["psnr"] is not None:
                    panel.setdefault((method, ""), []).append((entry["stage"]["pyramid_size"], own["psnr"]))
        page.heading("Error against the pyramid's size")
        largest = max(entry["stage"]["pyramid_size"] for entry in sizes)
        page.text(
            f"Six faces of half floats with all levels take {BYTES_OF_SIDE} side² bytes: {BYTES_OF_SIDE * largest**2 / 1e6:.1f} MB for"
            f" {largest}. `fis40` has a pyramid of 2 × 2 means of that size."
        )
        caption = f"PSNR against the side of the cube map's faces, {cases.TIMED_MAP}"
        page.figure("pyramid_size.svg", caption, sizes, figures.curves, lines, "texels along a face")
    if filters:
        groups = {}
        for entry in filters:
            material = analysis.material_of(entry)
            usual = analysis.find(page.entries, Place(page.device, page.renderer, cases.TIMED_MAP, material))
            panel = groups.setdefault(cases.material_name(material), {})
            for method, own in entry["methods"].items():
                if method == cases.REFERENCE or own["psnr"] is None:
                    continue
                panel.setdefault(method, {})[entry["stage"]["filter"]] = own["psnr"]
                if usual and usual["methods"].get(method, {}).get("psnr") is not None:
                    panel[method][cases.USUAL_FILTER] = usual["methods"][method]["psnr"]
        page.heading("Error against the pyramid's filter")
        page.figure("filter.svg", f"PSNR by the pyramid's filter, {cases.TIMED_MAP}", filters, figures.bars, groups)


def biases(page):
    entries, rows = study(page, "bias"), []
    for entry in entries:
        material = analysis.material_of(entry)
        usual = analysis.find(page.entries, Place(page.device, page.renderer, cases.TIMED_MAP, material))
        if usual:
            methods = [m for m in entry["methods"] if m != cases.REFERENCE and m in usual["methods"]]
            cells = [f"{decibels(usual['methods'][m]['psnr'])} / {decibels(entry['methods'][m]['psnr'])}" for m in methods]
            rows.append([cases.material_name(material), *cells])
    if rows:
        page.heading("Importance sampling with another level")
        bias = entries[0]["stage"]["fis_bias"]
        page.text(
            "PSNR in dB with the level of Colbert and Křivánek 2007, which is compared above, and"
            f" {bias:g} level higher, as Křivánek and Colbert 2008 have it; on {cases.TIMED_MAP}."
        )
        page.table(["material", *methods], rows)
        page.text(source_of(entries))


def forms(page):
    """Importance sampling as published and with what came later."""
    rows, used = {}, []
    for entry in study(page, "form"):
        material = analysis.material_of(entry)
        usual = analysis.find(page.entries, Place(page.device, page.renderer, cases.TIMED_MAP, material))
        if usual is None:
            continue
        used.append(entry)
        of_material = rows.setdefault(material, {m: [usual["methods"][m]["psnr"]] for m in cases.FIS_METHODS if m in usual["methods"]})
        for method, found in of_material.items():
            if method in entry["methods"]:
                found.append(entry["methods"][method]["psnr"])
    if rows:
        page.heading("Importance sampling as it was published, and since")
        page.text(
            "PSNR in dB as compared above / as in the chapter of 2007 / with kernels of the density's integral (Tokuyoshi 2016) for"
            f" GGX too; on {cases.TIMED_MAP}. For Ward the first and the last are the same."
        )
        methods = list(next(iter(rows.values())))
        cells = [[cases.material_name(m), *(" / ".join(map(decibels, found)) for found in own.values())] for m, own in rows.items()]
        page.table(["material", *methods], cells)
        page.text(source_of(used))


def changing(page):
    panels, rows, used = {}, [], []
    for v in page.of_first():
        entry = analysis.find(page.entries, v["place"])
        name = cases.material_name(v["place"].material)
        found = {m: update_time(own) for m, own in entry["methods"].items() if own["gpu_ms"] is not None}
        whole = {m: update + entry["methods"][m]["gpu_ms"] for m, update in found.items() if update is not None}
        if cases.BASELINE not in whole:
            continue
        used.append(entry)
        for method, time in whole.items():
            own = entry["methods"][method]
            if own["psnr"] is not None:
                share = time / whole[cases.BASELINE]
                panels.setdefault(name, []).append((method, share, own["psnr"]))
                cells = [f"{found[method]:.1f}", f"{own['gpu_ms']:.2f}", ratio(share), decibels(own["psnr"])]
                rows.append([name, method, *cells])
    if not panels:
        return
    page.heading("When the environment changes")
    page.text(
        "What a method makes anew from a changed environment before it can draw: a map filtered for its widths, or the pyramid. GPU"
        f" time of one update and of the sphere, over that of `{cases.BASELINE}`. The sphere is small: in a game everything that is drawn"
        " shares an update. The sizes of the maps are in the table of the methods. The dual-paraboloid map of the thesis and the"
        " engine's sky are not timed."
    )
    page.figure("changing.svg", f"Error against the time of an update and a frame, {page.renderer}", used, figures.changing, panels)
    head = ["material", "method", "update, ms", "sphere, ms", f"both over {cases.BASELINE}", "dB"]
    page.blocks.append(doc.Folded("Updates and frames; milliseconds of this run", [doc.Table(head, rows, 2)]))


def changing_by_the_clock(page):
    """Updates where the engine has no GPU times of them."""
    rows, used = [], []
    for place in analysis.places(page.entries, map_name=cases.TIMED_MAP):
        entry = analysis.find(page.entries, place)
        found = {m: update_time(own, "prefilter_wall_ms") for m, own in entry["methods"].items()}
        if found.get(cases.BASELINE) is None:
            continue
        used.append(entry)
        for method, time in found.items():
            if time is not None:
                cells = [f"{time:.1f}", ratio(time / found[cases.BASELINE]), decibels(entry["methods"][method]["psnr"])]
                rows.append([cases.material_name(place.material), place.renderer, method, *cells])
    if rows:
        page.text(
            "In Compatibility the engine gives no GPU time for an update. There it is measured by the clock: from asking for it until"
            " everything is read back, which waits for the driver, so what moving the map costs is in it too."
        )
        head = ["material", "renderer", "method", "update by the clock, ms", f"over {cases.BASELINE}", "dB"]
        blocks = [doc.Table(head, rows, 3), doc.Text(source_of(used))]
        page.blocks.append(doc.Folded("Updates by the clock; milliseconds of this run", blocks))


def bake(page):
    curve, readme = page.link("bench", "curve.svg"), page.link("bench", "README.md")
    if curve and readme:
        page.heading("Error against bake time")
        where = json.loads((page.report_folder / "bench/curve.json").read_text(encoding="utf-8"))["machine"]
        source = f"Measured by `./dev bench` on {where['processor']}, {where['cores']} cores; [the whole report]({readme})."
        caption = "Error of whole tables of 8 lobes between views against the processor time of the bake"
        page.blocks.append(doc.Figure(curve, caption, source))


def phones(page):
    path = page.report_folder / "mobile-cost/results.json"
    readme = page.link("mobile-cost", "README.md")
    if not path.exists() or readme is None:
        return
    counted = json.loads(path.read_text(encoding="utf-8"))
    panels, rows, versions = {}, [], set()
    for gpu, renderer, name in PHONE_GPUS:
        variants = {row["variant"]: row for row in counted if row["gpu"] == gpu and row["renderer"] == renderer}
        for material in PHONE_MATERIALS:
            place = Place(page.device, page.renderer, cases.TIMED_MAP, material)
            entry = analysis.find(page.entries, place)
            if not variants or entry is None:
                continue
            found = []
            for method, own in entry["methods"].items():
                row = variants.get(phone_variant(method, material, variants))
                if row and own["psnr"] is not None:
                    found.append((method, row["instructions"], own["psnr"]))
                    versions.add(row["mesa"])
                    rows.append(
                        [name, cases.material_name(material), method]
                        + [str(row["instructions"]), str(row["registers"]), decibels(own["psnr"])]
                    )
            if found:
                panels[f"{name}, {cases.material_name(material)}"] = found
    if panels:
        page.heading("What phones' GPUs execute")
        figures.error_against_instructions(panels, page.folder / "phones.svg")
        caption = f"PSNR ({page.renderer}, {cases.TIMED_MAP}) against instructions a pixel, by Mesa's compilers"
        source = f"Compiled by `./dev mobile-cost` with Mesa {joined(sorted(versions))}; [all variants and GPUs]({readme})."
        page.blocks.append(doc.Figure("compare/phones.svg", caption, source))
        table = doc.Table(["GPU", "material", "method", "instructions", "registers", "dB"], rows, 3)
        page.blocks.append(doc.Folded("Instructions and registers", [table]))


def reference(page):
    """How far the reference can be trusted, where ./dev crosscheck has left what it found."""
    path = page.report_folder / "crosscheck/results.json"
    if not path.exists():
        return
    found = json.loads(path.read_text(encoding="utf-8"))
    rows = []
    for check, what in CHECKS.items():
        own = [result for result in found if result["check"] == check]
        if not own:
            continue
        materials = joined(dict.fromkeys(cases.material_name((r["brdf"], r["alpha"])) for r in own))
        if check == "self":
            worst = f"{min(r['difference'] for r in own):.1f} dB"
        else:
            worst = f"{100 * max(abs(r['difference']) for r in own):.3f} %"
        rows.append([what, materials, f"{sum(r['passed'] for r in own)} of {len(own)}", worst])
    page.heading("Is the reference right?")
    page.text(
        "`./dev crosscheck --json docs/report/crosscheck/results.json` compares it with integrators that share no code with it; each"
        " comparison is judged by its own noise. Differences are of a pixel's light, and for Mitsuba of the whole picture's."
    )
    page.table(["compared with", "materials", "agree", "largest difference"], rows, names=2)
