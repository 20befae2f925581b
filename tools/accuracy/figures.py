"""The figures of ./dev accuracy."""

import cases
import matplotlib

matplotlib.use("Agg")
# Files that differ only where the numbers do.
matplotlib.rcParams.update({"svg.hashsalt": "lobelight", "font.size": 9})

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402


def save(figure, path):
    temporary = path.with_name("." + path.name)
    figure.savefig(temporary, format="svg", metadata={"Date": None})
    temporary.replace(path)
    plt.close(figure)


def ratios(entries, path):
    """PSNR against fetches: for each ratio a line of tables and a dashed one of lines, a cross for the rival; a panel for each map."""
    own = [e for e in entries if tuple(e["alpha"]) in cases.RATIO_WIDTHS.values() and "gmm4" in e["methods"]]
    maps = list(dict.fromkeys(entry["map"] for entry in own))
    figure, axes = plt.subplots(1, len(maps), figsize=(4.2 * len(maps), 3.8), squeeze=False, sharey=True, layout="constrained")
    for axis, map_name in zip(axes[0], maps):
        for place, (ratio, alpha) in enumerate(cases.RATIO_WIDTHS.items()):
            for entry in own:
                if (entry["map"], tuple(entry["alpha"])) != (map_name, alpha):
                    continue
                colour = plt.cm.viridis(place / len(cases.RATIO_WIDTHS))
                for family, style, label in (("gmm", "o-", f"1:{ratio}"), ("line", "d--", None)):
                    lobes = sorted((f["fetches"], f["psnr"]) for m, f in entry["methods"].items() if m.startswith(family))
                    if lobes:
                        axis.plot(*zip(*lobes), style, color=colour, markersize=3.5, linewidth=1, label=label)
                axis.plot([40], [entry["methods"][cases.RIVAL]["psnr"]], "x", color=colour)
        axis.set_xscale("log", base=2)
        axis.set_xticks([4, 8, 16, 24, 32, 40], ["4", "8", "16", "24", "32", "40"])
        axis.grid(alpha=0.3)
        axis.set_xlabel(f"fetches of the map (dashed: lines; crosses: {cases.RIVAL})")
        axis.set_title(map_name)
    axes[0][0].set_ylabel("PSNR, dB")
    axes[0][-1].legend(fontsize=7)
    save(figure, path)


def grid(cells, path):
    """Heat maps over the widths: gain in dB above, GPU time ratio below; a column for each map."""
    maps = list(dict.fromkeys(cell[0] for cell in cells))
    names = [f"{width:g}" for width in cases.GRID_WIDTHS]
    figure, axes = plt.subplots(2, len(maps), figsize=(3.6 * len(maps), 6.4), squeeze=False, layout="constrained")
    for column, map_name in enumerate(maps):
        for row, (title, low, high, colours) in enumerate((("gain, dB", -4, 12, "RdYlGn"), ("GPU time ratio", 0, 2, "RdYlGn_r"))):
            values = np.full((len(names), len(names)), np.nan)
            for cell in cells:
                if cell[0] == map_name and cell[2 + row] is not None:
                    values[cases.GRID_WIDTHS.index(cell[1][1]), cases.GRID_WIDTHS.index(cell[1][0])] = cell[2 + row]
            axis = axes[row][column]
            axis.imshow(values, origin="lower", vmin=low, vmax=high, cmap=colours)
            for y, x in zip(*np.nonzero(np.isfinite(values))):
                axis.text(x, y, f"{values[y, x]:.1f}" if row == 0 else f"{values[y, x]:.2f}", ha="center", va="center", fontsize=8)
            axis.set_xticks(range(len(names)), names)
            axis.set_yticks(range(len(names)), names)
            axis.set_xlabel("alpha_x")
            axis.set_ylabel("alpha_y")
            axis.set_title(f"{map_name}: {title}")
    save(figure, path)
