"""The figures of ./dev bench."""

import matplotlib

matplotlib.use("Agg")
# Files that differ only where the numbers do.
matplotlib.rcParams.update({"svg.hashsalt": "lobelight", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3})

import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {16: "#c9a227", 32: "#3a7d44", 64: "#1f4e79", 96: "#8b2e5d"}


def save(figure, path):
    temporary = path.with_name("." + path.name)
    figure.savefig(temporary, format=path.suffix[1:], metadata={"Date": None} if path.suffix == ".svg" else None)
    temporary.replace(path)
    plt.close(figure)


def curve(rows, path):
    """Error between views against processor time; a line for each node count, dashed without acceleration."""
    materials = list(dict.fromkeys((row["brdf"], row["alpha_x"], row["alpha_y"]) for row in rows))
    figure, axes = plt.subplots(1, len(materials), figsize=(4.4 * len(materials), 3.8), squeeze=False, layout="constrained")
    for axis, material in zip(axes[0], materials):
        own = [row for row in rows if (row["brdf"], row["alpha_x"], row["alpha_y"]) == material]
        for accelerated in (1.0, 0.0):
            for nodes in dict.fromkeys(row["nodes_per_axis"] for row in own):
                line = [r for r in own if r["nodes_per_axis"] == nodes and r["accelerated"] == accelerated]
                axis.plot(
                    [r["seconds"] for r in line],
                    [r["between"] for r in line],
                    "o-" if accelerated else "s--",
                    markersize=3.5,
                    linewidth=1.3,
                    color=COLOURS.get(int(nodes)),
                    label=f"{nodes:.0f}² nodes, {'accelerated' if accelerated else 'textbook EM'}",
                )
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel("processor time of the whole table, s")
        axis.set_title(f"{material[0]} ({material[1]:g}, {material[2]:g}), 8 lobes")
        axis.yaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
        axis.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        errors = [r["between"] for r in own]
        ticks = [t for t in (2, 3, 4, 5, 7, 10, 14, 20, 30, 45, 60) if min(errors) * 0.95 <= t <= max(errors) * 1.05]
        axis.set_yticks(ticks)
    axes[0][0].set_ylabel("L1 error between views, % of the albedo")
    axes[0][-1].legend(fontsize=7)
    save(figure, path)


def speed(rows, path):
    """Processor time of a table, all threads together, against lobes, views and nodes."""
    tables = {}
    for row in rows:
        if row["name"].startswith("table/"):
            fields = dict(part.split(":") for part in row["name"].split("/") if ":" in part)
            key = tuple(int(fields[name]) for name in ("lobes", "elevations", "azimuths", "nodes", "threads"))
            tables[key] = row["cpu_time"]
    panels = {
        "lobes": ([key for key in tables if key[1:4] == (16, 8, 64)], lambda key: key[0]),
        "views": ([key for key in tables if key[0] == 8 and key[3] == 64], lambda key: key[1] * key[2]),
        "nodes per axis": ([key for key in tables if key[:3] == (8, 16, 8)], lambda key: key[3]),
    }
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), layout="constrained")
    for axis, (title, (keys, place)) in zip(axes, panels.items()):
        for threads in (1, 2):
            line = sorted((place(key), tables[key]) for key in keys if key[4] == threads)
            axis.plot(*zip(*line) if line else ([], []), "o-", label=f"{threads} thread{'s' if threads > 1 else ''}")
        axis.set_xlabel(title)
        axis.set_ylim(bottom=0.0)
    axes[0].set_ylabel("processor time of a Ward (0.05, 0.2) table, ms")
    axes[0].legend()
    save(figure, path)
