"""README.md of `./dev accuracy`: tables of the four parts, the goals and where they are missed."""

import math

import cases
import figures

# dB, of eight lobes; photographed maps and the synthetic one.
LEAST = {"isotropic": (36.0, 33.5), cases.ANISOTROPIC: (35.0, 32.5)}
# dB better than the rival within its GPU time, at the widths of the part "leads".
LEAST_LEADS = {cases.HARD: 10.0, (0.01, 0.5): 6.0, (0.005, 0.5): 6.0, (0.5, 0.5): 4.0}
# dB, on photographed maps.
LEAST_HARD = 33.0
LEAST_GAIN = 4.0
LEAST_SELF_AGREEMENT = 55.0


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def widths(alpha):
    return f"({alpha[0]:g}, {alpha[1]:g})"


def number(value, digits):
    return "–" if value is None else f"{value:.{digits}f}"


def find(entries, map_name, brdf, alpha, methods):
    """The methods' figures of one material on one map, or None where one of them is not there."""
    for entry in entries:
        if (entry["map"], entry["brdf"], tuple(entry["alpha"])) == (map_name, brdf, tuple(alpha)):
            return entry["methods"] if all(method in entry["methods"] for method in methods) else None
    return None


def names_of_maps(entries):
    return list(dict.fromkeys(entry["map"] for entry in entries))


def of_maps(entries):
    """Eight lobes on every map, and the hard material with up to sixteen: (text, missed goals)."""
    missed, text = [], ""
    columns = [(w, w) for w in cases.ISOTROPIC_WIDTHS] + [cases.ANISOTROPIC, cases.HARD]
    shown = [(alpha, "gmm8") for alpha in columns] + [(cases.HARD, "gmm16")]
    for brdf in cases.BRDFS:
        rows = []
        for map_name in names_of_maps(entries):
            row = [map_name]
            synthetic = map_name == cases.SYNTHETIC
            for alpha, method in shown:
                found = find(entries, map_name, brdf, alpha, [method])
                psnr = found[method]["psnr"] if found else None
                least = 0.0 if alpha == cases.HARD else LEAST.get(alpha, LEAST["isotropic"])[synthetic]
                if psnr is not None and psnr < least:
                    missed.append(f"{map_name}, {brdf} {widths(alpha)}, {method}: {psnr:.2f} dB, {least:g} wanted")
                row.append(number(psnr, 1))
            if any(cell != "–" for cell in row[1:]):
                rows.append(row)
        if rows:
            head = ["map", *(f"{widths(alpha)} {method}" for alpha, method in shown)]
            text += f"\n{brdf}, PSNR in dB:\n\n" + table(head, rows)
    return text, missed


def of_ratios(entries):
    """Every count of lobes at every ratio; empty where the part was not measured."""
    text = ""
    for map_name in names_of_maps(entries):
        rows = []
        for ratio, alpha in cases.RATIO_WIDTHS.items():
            found = find(entries, map_name, "ward", alpha, ["gmm4", cases.RIVAL])
            if found:
                cells = [
                    f"{found[m]['psnr']:.1f} ({number(found[m]['gpu_ratio'], 2)})" if m in found else "–"
                    for m in cases.RATIO_METHODS
                ]
                rows.append([f"1:{ratio}", widths(alpha), *cells])
        if rows:
            text += f"\n{map_name}, PSNR in dB (GPU time over that of {cases.RIVAL}):\n\n"
            text += table(["ratio", "widths", *cases.RATIO_METHODS], rows)
    return text


def best_within(found, most_fetches):
    """Of ours that cost no more GPU time than the rival, the most accurate: (method, gain in dB, time ratio); the first
    where all cost more."""
    counts = [m for m in found if cases.is_ours(m) and found[m]["fetches"] <= most_fetches]
    cheap = [m for m in counts if (found[m]["gpu_ratio"] or 0.0) <= 1.0] or counts[:1]
    best = max(cheap, key=lambda m: found[m]["psnr"])
    return best, found[best]["psnr"] - found[cases.RIVAL]["psnr"], found[best]["gpu_ratio"]


def of_leads(entries):
    """What is hardest against the rival: (text, missed)."""
    missed, rows = [], []
    for entry in entries:
        found, alpha = entry["methods"], tuple(entry["alpha"])
        if alpha not in LEAST_LEADS or not {cases.RIVAL, *cases.LEAD_METHODS[:1]} <= found.keys():
            continue
        method, gain, ratio = best_within(found, math.inf)
        rival = found[cases.RIVAL]["psnr"]
        automatic = number(found[cases.AUTOMATIC]["psnr"], 1) if cases.AUTOMATIC in found else "–"
        where = [entry["map"], entry["brdf"], widths(alpha)]
        rows.append([*where, method, f"{rival + gain:.1f}", f"{rival:.1f}", f"{gain:+.1f}", number(ratio, 2), automatic])
        least = LEAST_LEADS[alpha]
        if gain < least or ratio is None or ratio > 1.0:  # Not timed is not shown.
            missed.append(f"{', '.join(where)}: {method} {gain:+.2f} dB at {number(ratio, 2)} of the time, {least:+g} wanted")
        if alpha == cases.HARD and entry["map"] != cases.SYNTHETIC and rival + gain < LEAST_HARD:
            missed.append(f"{', '.join(where)}: {method} {rival + gain:.2f} dB, {LEAST_HARD:g} wanted")
    head = ["map", "BRDF", "widths", "method", "its dB", f"{cases.RIVAL} dB", "gain", "GPU time ratio", f"{cases.AUTOMATIC} dB"]
    return ("\n" + table(head, rows) if rows else ""), missed


def of_grid(entries):
    """Each material of the grid against the rival: (text, missed, [(map, alpha, gain, time ratio)])."""
    missed, cells, rows = [], [], []
    for entry in entries:
        found, alpha = entry["methods"], tuple(entry["alpha"])
        on_grid = alpha[0] in cases.GRID_WIDTHS and alpha[1] in cases.GRID_WIDTHS
        if entry["brdf"] != "ward" or entry["map"] not in cases.GRID_MAPS or not on_grid or not {cases.RIVAL, "gmm16"} <= found.keys():
            continue
        method, gain, ratio = best_within(found, cases.MOST_FETCHES)
        cells.append((entry["map"], alpha, gain, ratio))
        rival = found[cases.RIVAL]["psnr"]
        rows.append([entry["map"], widths(alpha), method, f"{rival + gain:.1f}", f"{rival:.1f}", f"{gain:+.1f}", number(ratio, 2)])
        if gain < LEAST_GAIN or ratio is None or ratio > 1.0:  # Not timed is not shown.
            missed.append(f"{entry['map']}, {widths(alpha)}: {method} {gain:+.2f} dB at {number(ratio, 2)} of the time")
    head = ["map", "widths", "method", "its dB", f"{cases.RIVAL} dB", "gain", "GPU time ratio"]
    return ("\n" + table(head, rows) if rows else ""), missed, cells


def listed(missed):
    return "\nGoals that are missed:\n\n" + "".join(f"- {line}\n" for line in missed) if missed else "\nEvery goal is met by these cases.\n"


def write(folder, entries, driver, options):
    """Writes README.md and the figures; returns the summary to print."""
    maps, maps_missed = of_maps(entries)
    ratios = of_ratios(entries)
    leads, leads_missed = of_leads(entries)
    grid, grid_missed, cells = of_grid(entries)
    agreement = min(entry["methods"][cases.REFERENCE]["psnr"] for entry in entries)
    text = (
        "# Accuracy\n\nWritten by `./dev accuracy`. The metric is that of `./dev compare`: PSNR over a sphere's pixels,\n"
        f"{options.size} × {options.size}, renderer {options.renderer}, drawn by {driver}; the reference takes {options.samples}\n"
        f"samples a pixel and agrees with itself to {agreement:.1f} dB or better"
        + ("" if agreement >= LEAST_SELF_AGREEMENT else f", less than the {LEAST_SELF_AGREEMENT:g} dB wanted")
        + ".\nGPU times are medians of the ratios of interleaved rounds; of a software driver they say what the processor\n"
        f"spends, not what a graphics card would. They are taken on {cases.TIMED_MAP} and serve for the other maps. No fit has seen\n"
        "a map. Every figure is in [results.csv](results.csv).\n"
    )
    if maps:
        text += "\n## Maps\n\nGoals with 8 lobes: 36 dB for equal widths and 35 for (0.05, 0.2) on photographed maps, 33.5 and 32.5\n"
        text += "on the synthetic map, whose brightest texel is 60000 times its median.\n"
        text += maps + listed(maps_missed)
    if leads:
        text += (
            f"\n## Ahead of {cases.RIVAL}\n\nGoals within its GPU time: at (0.01, 0.2) {LEAST_LEADS[cases.HARD]:g} dB better, and"
            f" {LEAST_HARD:g} dB on photographed maps; at 1:50 and 1:100\n{LEAST_LEADS[(0.01, 0.5)]:g} dB better; at (0.5, 0.5)"
            f" {LEAST_LEADS[(0.5, 0.5)]:g}. The last column is what a material draws by itself, however long it takes.\n"
        )
        text += leads + listed(leads_missed)
    if ratios:
        figures.ratios(entries, folder / "ratios.svg")
        text = text.replace("# Accuracy\n", "# Accuracy\n\n![Error against fetches, a curve for each ratio](ratios.svg)\n", 1)
        text += "\n## Strong anisotropy\n" + ratios
    if grid:
        figures.grid(cells, folder / "grid.svg")
        text += (
            f"\n## Grid of widths\n\nGoal: with at most {cases.MOST_FETCHES} fetches and no more GPU time, {LEAST_GAIN:g} dB better than"
            f" {cases.RIVAL}. Exchanging the widths is\nturning the material by 90 degrees: both halves are measured on"
            f" {cases.WHOLE_GRID_MAP}, one half elsewhere.\n\n![Gain and GPU time over the widths](grid.svg)\n"
        )
        text += listed(grid_missed) + grid
    temporary = folder / ".README.md"
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(folder / "README.md")
    return (
        f"accuracy: {len(entries)} cases, {len(maps_missed) + len(leads_missed) + len(grid_missed)} goals missed; {folder / 'README.md'}"
    )
