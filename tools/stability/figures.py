"""Heat maps of ./dev stability. One hue from light to dark, logarithmic where the range asks for it, every cell with
its number; grey where a case does not exist."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.colors import LogNorm, Normalize  # noqa: E402

BRDF_TITLES = {"ward": "Ward 1992", "ward_bounded": "bounded Ward", "ggx": "GGX"}
DARK_TEXT, LIGHT_TEXT = "#222222", "#ffffff"


def grid_of(cases, row, column, value):
    """Sorted keys of both axes and the worst value of each cell, NaN where there is none."""
    rows = sorted({row(case) for case in cases})
    columns = sorted({column(case) for case in cases})
    grid = np.full((len(rows), len(columns)), np.nan)
    for case in cases:
        at = rows.index(row(case)), columns.index(column(case))
        grid[at] = np.nanmax([grid[at], value(case)])
    return rows, columns, grid


def label(number):
    """Two digits, short: 0.0012, 1.2e-9 as 1e-9."""
    if number == 0:
        return "0"
    if 1e-3 <= number < 1000:
        return f"{number:.2g}" if number < 10 else f"{number:.0f}"
    mantissa, exponent = f"{number:.0e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def heat_map(axes, rows, columns, grid, norm):
    image = axes.imshow(np.ma.masked_invalid(grid), cmap="Blues", norm=norm, aspect="auto", origin="lower")
    axes.set_facecolor("#e4e4e4")
    axes.set_xticks(range(len(columns)), [f"{c:g}" if not isinstance(c, str) else c for c in columns], fontsize=7)
    axes.set_yticks(range(len(rows)), [f"{r:g}" if not isinstance(r, str) else r for r in rows], fontsize=7)
    axes.tick_params(length=0)
    for edge in axes.spines.values():
        edge.set_visible(False)
    for y, x in np.argwhere(np.isfinite(grid)):
        dark = norm(max(grid[y, x], norm.vmin)) > 0.6
        axes.text(
            x, y, label(grid[y, x]), ha="center", va="center", fontsize=5.5, color=LIGHT_TEXT if dark else DARK_TEXT
        )
    return image


def panels(path, title, cases, row, column, value, axis_labels, logarithmic, keys, key):
    """One heat map for each key, on one scale."""
    grids = {k: grid_of([case for case in cases if key(case) == k], row, column, value) for k in keys}
    grids = {k: g for k, g in grids.items() if g[2].size}
    values = np.concatenate([g[2][np.isfinite(g[2])] for g in grids.values()])
    if logarithmic:
        positive = values[values > 0]
        norm = LogNorm(max(positive.min(), positive.max() * 1e-6), positive.max() * 1.0001, clip=True)
    else:
        norm = Normalize(0, values.max())
    width = sum(max(3.0, 0.33 * len(g[1]) + 0.9) for g in grids.values()) + 0.9
    height = 0.26 * max(len(g[0]) for g in grids.values()) + 1.35
    figure, axes = plt.subplots(
        1,
        len(grids),
        figsize=(width, height),
        width_ratios=[max(3.0, 0.33 * len(g[1]) + 0.9) for g in grids.values()],
        squeeze=False,
        layout="constrained",
    )
    for one, (k, (rows, columns, grid)) in zip(axes[0], grids.items()):
        image = heat_map(one, rows, columns, grid, norm)
        one.set_title(BRDF_TITLES.get(k, k), fontsize=9)
        one.set_xlabel(axis_labels[0], fontsize=8)
    axes[0][0].set_ylabel(axis_labels[1], fontsize=8)
    bar = figure.colorbar(image, ax=list(axes[0]), pad=0.01, fraction=0.03)
    bar.ax.tick_params(labelsize=7)
    bar.outline.set_visible(False)
    figure.suptitle(title, fontsize=10)
    temporary = path.with_suffix(".tmp.png")
    figure.savefig(temporary, dpi=130, metadata={"Software": None})
    plt.close(figure)
    temporary.replace(path)


def is_isotropic(case):
    return case["alpha"][0] == case["alpha"][1]


def width(case):
    return max(case["alpha"])


def ratio(case):
    return max(case["alpha"]) / min(case["alpha"])


def rounded_ratio(case):
    return float(f"{ratio(case):.3g}")


VIEW = "view's elevation from the normal (°)"


def draw(results, folder):
    """Writes the heat maps; returns (file name, caption) of each."""
    fits = [
        case
        for case in results
        if case["group"] == "slice" and case.get("lobes") == 8 and case.get("nodes_per_axis") == 64
    ]
    round_ones = [case for case in fits if is_isotropic(case)]
    stretched = [case for case in fits if not is_isotropic(case)]
    brdfs = list(BRDF_TITLES)
    by_brdf = {"keys": brdfs, "key": lambda case: case["brdf"]}
    elevation = {"column": lambda case: case["elevation"]}
    pictures = []

    def add(name, caption, cases, **options):
        if cases:
            panels(folder / name, caption, cases, **options)
            pictures.append((name, caption))

    for cases, suffix, kind, row, row_label in (
        (round_ones, "isotropic", "isotropic", width, "α"),
        (stretched, "anisotropic", "anisotropic, worst azimuth and width", rounded_ratio, "α ratio"),
    ):
        common = {"row": row, **elevation, **by_brdf, "axis_labels": (VIEW, row_label)}
        add(
            f"energy_{suffix}.png",
            f"Energy: |albedo of the slice / quadrature − 1|, {kind}",
            cases,
            value=lambda case: case["energy_error"],
            logarithmic=True,
            **common,
        )
        add(
            f"fit_{suffix}.png",
            f"Fit of eight round lobes: ∫|mixture − slice| / ∫slice, {kind}",
            cases,
            value=lambda case: case["fit_error"],
            logarithmic=False,
            **common,
        )
        add(
            f"iterations_{suffix}.png",
            f"Iterations of EM, {kind}",
            cases,
            value=lambda case: case["iterations"],
            logarithmic=False,
            **common,
        )
    decodes = [case for case in results if case["group"] == "shader decode" and case["renderer"] == "mobile"]
    add(
        "shader_decode.png",
        "Single precision: a mean's worst error in standard deviations of the sharpest lobe, κ(o·h) = 2^27",
        decodes,
        value=lambda case: max(case.get("standard_deviations", 0.0), 1e-12),
        row=width,
        **elevation,
        axis_labels=(VIEW, "α"),
        logarithmic=True,
        keys=["ratio 1", "ratio up to 1000"],
        key=lambda case: "ratio 1" if is_isotropic(case) else "ratio up to 1000",
    )
    gaussians = [case for case in results if case["group"] == "gaussian" and 1e-8 <= case["kappa"] <= 1e10]
    add(
        "gaussian.png",
        "Spherical Gaussians: error against 50 digits over κ (samples: in standard deviations, else relative)",
        gaussians,
        value=lambda case: max(case["error"], 1e-18),
        row=lambda case: case["function"],
        column=lambda case: int(np.floor(np.log10(case["kappa"]) + 1e-9)),
        axis_labels=("log10 κ, rounded down", ""),
        logarithmic=True,
        keys=["double precision"],
        key=lambda case: "double precision",
    )
    return pictures
