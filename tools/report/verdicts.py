"""Sections of the page of `./dev report`: what the comparison says, in words, tables and pictures."""

import analysis
import cases
import document as doc
import figures
from page import decibels, entries_of, joined, number, plain, ratio, source_of

TITLE = "Error against run time"
OTHER_REPORTS = {
    "accuracy": "lobes over more widths and maps, error against fetches for ratios from 1:1 to 1:100",
    "bench": "the fit beside NumPy and SciPy, its error against bake time",
    "stability": "the fit and the shaders on their hardest input",
    "mobile-cost": "instructions and registers on phones' GPUs",
}
DESCRIPTIONS = {
    "gmm": "this project: as many lobes of a table, one fetch of the pyramid each",
    "line": "this project: as many lobes strung along the highlight's long axis, computed without a table",
    "auto": "this project: as many lobes as a material of these widths draws by itself, of a table or of a line",
    "toral": "Töral 2015 as written: independent fits, nearest view, dual-paraboloid map with 2 × 2 means, eq. 2.11",
    "fis": "filtered importance sampling, Colbert and Křivánek 2007, as many samples, on 2 × 2 means, with kernels of the density's"
    " integral for Ward (Tokuyoshi 2016) and the bounded visible normals for GGX (Tokuyoshi and Eto 2024); `fis40g` on our pyramid",
    "allfreq": "all-frequency rendering, Wang et al. 2009: one spherical Gaussian by spherical warp, or eight",
    "asg": "one anisotropic spherical Gaussian, Xu et al. 2013",
    "majoraxis": "samples along the BRDF's major axis on a prefiltered map, Cocco, Zanni and Chermain 2024",
    "closed": "lobes from a closed form, without a table",
    "splitsum": "split sum with a map filtered for this very width; a bent normal for different widths",
    "stock": "Godot's `StandardMaterial3D` under the engine's own sky; always GGX, ratios up to 10:1",
}


def timing_sizes(page):
    """Of how many pixels the timed frames are, in words; empty without times."""
    sizes = sorted({entry["timing_size"] for entry in page.entries if entry["timing_size"]})
    return f" of {joined(f'{size}²' for size in sizes)} pixels" if sizes else ""


def introduction(page):
    page.blocks.append(doc.Heading(TITLE, 1))
    maps = joined(dict.fromkeys(entry["map"] for entry in page.entries))
    page.text(
        "Written by `./dev report`. A sphere lit by an environment map, drawn in the engine by every method in the same fragment"
        " function, against a brute-force integrator. PSNR over the sphere's pixels: the reference's median is exposed to 0.18,"
        " clamped, gamma 2.2 (`./dev compare --help`). GPU times are medians over interleaved rounds of a method's time over that"
        f" of `{cases.BASELINE}` in the same round, of whole frames{timing_sizes(page)}; drivers in software say what the processor spends, not what a graphics card"
        f" would. Times are taken on {cases.TIMED_MAP} and serve for the other maps. Maps: {maps}. No fit has seen a map."
    )
    page.text(source_of(page.entries))
    data = "Raw numbers, rounds and settings: [compare/results.json](compare/results.json), [compare/results.csv](compare/results.csv)."
    others = [f"[{name}]({page.link(name, 'README.md')})" for name in OTHER_REPORTS if page.link(name, "README.md")]
    page.text(data + (f" Other reports: {joined(others)}." if others else ""))


def in_short(page, left_out, to_come):
    page.heading("In short")
    items = []
    for device in (cases.SOFTWARE, cases.GPU):
        own = [row for row in page.goals if row["place"].device == device]
        if own:
            reached = sum(row["reached"] for row in own)
            items.append(
                f"At least as accurate as `{analysis.GOAL_RIVAL}` in a third of its time"
                f"{' on the GPU' if device == cases.GPU else ''}: {reached} of {len(own)} checks reached (below)."
            )
    if page.verdicts:
        count = analysis.tally(page.verdicts)
        items.append(
            f"Of {sum(count.values())} pairs of a case and a time budget, Lobelight is the most accurate in {count['ours']},"
            f" a rival in {count['rivals']}; in {count['none']} nothing is as fast."
        )
        count = analysis.tally(page.verdicts, "best_by_fetches")
        items.append(
            f"Of {sum(count.values())} pairs of a case and a number of fetches, Lobelight is the most accurate in {count['ours']},"
            f" a rival in {count['rivals']}."
        )
    if page.thesis:
        agreed = [row["place"] for row in page.thesis if row["above"] and row["as_high"]]
        items.append(
            f"The thesis' claim (its eight lobes above importance sampling, and as many dB as it reports) is reproduced in"
            f" {len(agreed)} of {len(page.thesis)} cases."
        )
    if to_come:
        items.append(f"**Not measured yet**: {to_come} cases; the same command goes on.")
    items += [f"**Not measured**: {title}: {reason}" for title, reason in left_out.items()]
    page.items(items)


def acceptance(page):
    if not page.goals:
        return
    page.heading("A third of the time of importance sampling")
    page.text(
        f"Goal: at equal or lower error than `{analysis.GOAL_RIVAL}`, `{cases.BASELINE}` takes at most a third of its GPU time on equal"
        f" widths; on (0.05, 0.2), lobes with at most {analysis.MOST_GOAL_FETCHES} fetches do. It is judged by the whole frame's time, which has what the renderer takes for any frame in"
        " it, whatever the method; the column after it is the ratio of what both take above the time of a sphere that reflects"
        " nothing, drawn in the same rounds. All methods draw the same pixels."
    )
    rows = [
        [
            row["place"].renderer + ("" if row["place"].device == cases.SOFTWARE else ", GPU"),
            cases.material_name(row["place"].material),
            row["method"],
            decibels(row["psnr"]),
            decibels(row["rival_psnr"]),
            ratio(row["time"]),
            ratio(row["time_without_fixed"]),
            "reached" if row["reached"] else "**missed**",
        ]
        for row in page.goals
    ]
    head = ["renderer", "material", "method", "its dB", f"{analysis.GOAL_RIVAL} dB"]
    head += ["whole frame's time ratio", "without the renderer's part", "goal"]
    page.table(head, rows, names=3)
    entries = [analysis.find(page.entries, row["place"]) for row in page.goals]
    page.items(
        f"{renderer}: the renderer's part is {number(fixed, 2)} ms of a frame, {100 * share:.0f} % of `{analysis.GOAL_RIVAL}`'s"
        for renderer, fixed, share in analysis.fixed_parts(entries)
    )
    page.text(source_of(entries))


def best_cell(best):
    if best is None:
        return "–"
    text = f"{best.method} {decibels(best.psnr)}"
    return text if cases.is_ours(best.method) else f"**{text}**"


def budgets(page):
    if not page.verdicts:
        return
    page.heading("The best method within a time")
    page.text(
        f"The most accurate method that takes at most so many times the GPU time of `{cases.BASELINE}`, and its PSNR in dB;"
        " rivals are **bold**."
    )
    budget_tables(page, "best", analysis.budget_name)


def fetch_budgets(page):
    if not page.verdicts:
        return
    page.heading("The best method within so many fetches")
    page.text(
        "The same for fetches of the environment, which are what an update of the pyramid, memory and a phone's bandwidth see; the"
        " time that a method computes for is not in it. Maps that were filtered for one material (`splitsum`, `majoraxis`) take part."
    )
    budget_tables(page, "best_by_fetches", lambda budget: f"≤ {budget}")


def budget_tables(page, by, name_of):
    keys = [(v["place"].device, v["place"].renderer, v["place"].map) for v in page.verdicts]
    for device, renderer, map_name in dict.fromkeys(keys):
        own = [v for v, key in zip(page.verdicts, keys) if key == (device, renderer, map_name)]
        rows = [[cases.material_name(v["place"].material), *(best_cell(best) for _, best in v[by])] for v in own]
        page.heading(f"{renderer}, {map_name}{', GPU' if device == cases.GPU else ''}", 3)
        page.table(["material", *(name_of(budget) for budget, _ in own[0][by])], rows)
        page.text(source_of(entries_of(page.entries, own)))


def rivals_ahead(page):
    if not page.verdicts:
        return
    page.heading("Where a rival beats us")
    page.text(
        "Rivals on the Pareto front: nothing of ours is as accurate in their time. Either ours within that time are less accurate, or"
        f" nothing of ours is as fast. {len(page.verdicts)} cases."
    )
    ahead = [(v["place"], rival, ours) for v in page.verdicts for rival, ours in v["rivals"]]
    if not ahead:
        page.text("Nowhere in these cases.")
        return
    rows = []
    for method in dict.fromkeys(rival.method for _, rival, _ in ahead):
        own = [(place, rival, ours) for place, rival, ours in ahead if rival.method == method]
        leads = [rival.psnr - ours.psnr for _, rival, ours in own if ours]
        materials = dict.fromkeys(cases.material_name(place.material) for place, _, ours in own if ours)
        lead = f"{max(leads):.1f}" if leads else "–"
        rows.append([method, joined(materials) if materials else "–", lead, str(len(leads)), str(len(own) - len(leads))])
    head = ["rival", "more accurate in the same time at", "by at most, dB", "cases", "faster than all of ours, cases"]
    page.table(head, rows, names=2)
    lines = [
        [
            cases.material_name(place.material),
            place.map,
            place.renderer + ("" if place.device == cases.SOFTWARE else ", GPU"),
            f"**{rival.method}**",
            decibels(rival.psnr),
            ratio(rival.time),
            f"{ours.method} {decibels(ours.psnr)}" if ours else "–",
        ]
        for place, rival, ours in ahead
    ]
    head = ["material", "map", "renderer", "rival", "its dB", "its time", "ours within that time, dB"]
    page.blocks.append(doc.Folded(f"The {len(lines)} cases", [doc.Table(head, lines, 4)]))


def time(page):
    if not page.verdicts:
        return
    page.heading("Error against time")
    keys = [(v["place"].device, v["place"].renderer) for v in page.verdicts]
    for device, renderer in dict.fromkeys(keys):
        own = [
            v for v, key in zip(page.verdicts, keys) if key == (device, renderer) and v["place"].map == cases.TIMED_MAP
        ]
        where = f"{renderer}, {'software' if device == cases.SOFTWARE else 'GPU'}"
        caption = f"Error against GPU time, {where}, {cases.TIMED_MAP}; the grey steps are the Pareto fronts"
        name = f"time_{renderer}{'' if device == cases.SOFTWARE else '_gpu'}.svg"
        page.figure(name, caption, entries_of(page.entries, own), figures.error_against_time, page.entries, own)


def sheets(page, title, isotropic):
    shown = [e for e in page.entries if e["sheet"] and cases.is_isotropic(analysis.material_of(e)) == isotropic]
    if shown:
        page.heading(title, 3)
    for entry in shown:
        caption = f"{cases.material_name(analysis.material_of(entry))}, {entry['map']}; below, the errors four times enlarged"
        page.blocks.append(doc.Figure(f"compare/{entry['sheet']}", caption, source_of([entry])))


def pictures(page):
    by_map, used = {}, []
    for place in analysis.places(page.entries, page.device, page.renderer):
        brdf, alpha = place.material
        if brdf == "ward" and alpha[0] == alpha[1]:
            used.append(analysis.find(page.entries, place))
            for point in analysis.points(page.entries, place):
                by_map.setdefault(place.map, {}).setdefault(point.method, {})[alpha[0]] = point.psnr
    page.heading("Widths, and pictures")
    if by_map:
        page.figure("isotropic.svg", "PSNR of every method against the width, Ward", used, figures.isotropic, by_map)
    sheets(page, "Equal widths, as in figure 4.1 of the thesis", isotropic=True)
    sheets(page, "Different widths, as in figure 4.2", isotropic=False)


def coverage_table(page):
    rows, used = [], []
    for place in analysis.places(page.entries, page.device, page.renderer, cases.TIMED_MAP):
        found = [analysis.coverages(page.entries, place, method) for method in ("toral8", "toral16")]
        if all(len(own) > 1 for own in found):
            used.append(analysis.find(page.entries, place))
            rows.append([cases.material_name(place.material), *(decibels(v) for own in found for v in own.values())])
    if rows:
        shares = [f"{c:g}" for c in (analysis.USUAL_COVERAGE, *cases.COVERAGES)]
        head = ["material", *(f"{method} {share}" for method in ("toral8", "toral16") for share in shares)]
        page.text(f"On {cases.TIMED_MAP}, PSNR in dB by coverage:")
        page.table(head, rows)
        page.text(source_of(used))


def claim(page):
    if not page.thesis:
        return
    page.heading("What the thesis claims")
    page.text(
        "Töral 2015 reports, with Grace Cathedral on a GTX 480, the PSNR in the columns with its name. Grace Cathedral has no clear"
        f" licence; `{cases.SYNTHETIC}` is a made-up map with its contrast (60000). `toral8` is the thesis as written with its coverage"
        " at 0.47, where its texels have the lobe's variance, at 0.77 and at 0.9; the thesis does not give it."
    )
    rows, items = [], []
    for row in page.thesis:
        place, claimed = row["place"], row["thesis"]
        entry = analysis.find(page.entries, place)
        own, own16 = (analysis.coverages(page.entries, place, method) for method in ("toral8", "toral16"))
        drawn = [entry["methods"].get(m, {}).get("psnr") for m in (analysis.GOAL_RIVAL, "allfreq1", "gmm8", "gmm16")]
        rows.append(
            [
                cases.material_name(place.material),
                place.map,
                *(f"{claimed[name]:.1f}" for name in ("GMM 8", "FIS", "all-frequency")),
                *(decibels(own.get(coverage)) for coverage in (analysis.USUAL_COVERAGE, *cases.COVERAGES)),
                *(decibels(own16.get(coverage)) for coverage in (analysis.USUAL_COVERAGE, *cases.COVERAGES)),
                *map(decibels, drawn),
            ]
        )
        coverage, psnr = row["toral8"]
        above = "above" if row["above"] else "below"
        level = "as high as" if row["as_high"] else "less than"
        said = "reproduced" if row["above"] and row["as_high"] else "reproduced in part" if row["above"] or row["as_high"] else "refuted"
        items.append(
            f"{cases.material_name(place.material)}, {place.map}: the thesis' eight lobes reach {decibels(psnr)} dB (coverage"
            f" {coverage:g}), {above} importance sampling ({decibels(row['fis'])} dB), {level} the {claimed['GMM 8']:.1f} dB claimed:"
            f" **{said}**"
        )
    head = ["material", "map", "thesis: GMM 8", "FIS", "all-freq.", "toral8 .47", ".77", ".9", "toral16 .47", ".77", ".9"]
    page.table([*head, analysis.GOAL_RIVAL, "allfreq1", "gmm8", "gmm16"], rows, names=2)
    page.items(items)
    coverage_table(page)


def fetches(page):
    found = page.of_first()
    if found:
        page.heading("Error against fetches")
        caption = f"Error against fetches of the environment, {page.renderer}, {cases.TIMED_MAP}; fetches of tables come on top"
        page.figure("fetches.svg", caption, entries_of(page.entries, found), figures.error_against_fetches, found)


def methods(page):
    page.heading("The methods, and where they could not be drawn")
    drawn = dict.fromkeys(m for e in page.entries for m in e["methods"] if m != cases.REFERENCE)
    rows = []
    for method in sorted(drawn, key=lambda m: (*cases.METHODS, m).index(m)):
        family = next((name for name in DESCRIPTIONS if method.startswith(name)), "")
        seen = [e for e in page.entries if method in e["methods"] and not e["stage"]]
        settings = seen[0]["methods"][method]["settings"] if seen else {}
        said = ", ".join(f"{name} {plain(value)}" for name, value in settings.items() if not name.startswith("prefilter"))
        where = joined(dict.fromkeys(e["renderer"] for e in seen)) if seen else "–"
        rows.append([method, DESCRIPTIONS.get(family, ""), said, where])
    page.table(["method", "what it is", "settings in its first case", "drawn in"], rows, 4)
    reasons = {}
    for entry in page.entries:
        for method, reason in entry["unavailable"].items():
            reasons.setdefault((method, reason), []).append(entry["renderer"])
    page.items(
        f"**{method}** is not drawn in {joined(dict.fromkeys(where))}: {reason}" for (method, reason), where in reasons.items()
    )


def everything(page):
    page.heading("All figures with the usual settings")
    head = ["method", "fetches", "probes", "table fetches", "PSNR, dB", "FLIP", "rel. RMSE"]
    head += ["GPU ms", f"over {cases.BASELINE}", "quartiles", "without the renderer's part"]
    for place in analysis.places(page.entries):
        entry = analysis.find(page.entries, place)
        rows = [
            [
                method,
                str(own["fetches"]),
                f"{own['probes']:g}",
                str(own["table_fetches"]),
                number(own["psnr"], 2),
                number(own["flip"], 4),
                number(own["relative_rmse"], 4),
                number(own["gpu_ms"], 3),
                ratio(own["gpu_ms_ratio"]),
                "–".join(f"{value:.2f}" for value in analysis.ratio_range(entry, method) or ()),
                ratio(own["gpu_ms_ratio_without_fixed"]),
            ]
            for method, own in entry["methods"].items()
        ]
        title = place.title() + ("" if place.device == cases.SOFTWARE else ", GPU")
        page.blocks.append(doc.Folded(title, [doc.Table(head, rows), doc.Text(source_of([entry]))]))


def links(page):
    items = [f"[{n}]({page.link(n, 'README.md')}): {what}" for n, what in OTHER_REPORTS.items() if page.link(n, "README.md")]
    if items:
        page.heading("Other reports")
        page.items(items)
