"""The figures of ./dev report."""

import analysis
import cases
import matplotlib

matplotlib.use("Agg")
# Files that differ only where the numbers do.
matplotlib.rcParams.update({"svg.hashsalt": "lobelight", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3})

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator  # noqa: E402

FAMILIES = tuple(cases.FAMILIES)
STYLES = {
    "Lobelight, tables": ("#c2410c", "o"),
    "Lobelight, lines": ("#f59e0b", "d"),
    "Lobelight, automatic": ("#7f1d1d", "8"),
    "Töral 2015": ("#64748b", "s"),
    "importance sampling": ("#1d4ed8", "^"),
    "importance sampling, our pyramid": ("#0891b2", "v"),
    "all-frequency": ("#15803d", "D"),
    "anisotropic Gaussian": ("#7e22ce", "P"),
    "major axis": ("#be185d", "X"),
    "closed form": ("#a16207", "*"),
    "split sum": ("#111827", "h"),
    "Godot": ("#478cbf", "p"),
}
RATIO_TICKS = (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4, 6, 8, 16, 32, 64, 128, 256, 512, 1024)
COLUMNS = 4
# A legend's entry is about as wide.
LEGEND_INCHES = 2.1


def save(figure, path):
    temporary = path.with_name("." + path.name)
    figure.savefig(temporary, format="svg", metadata={"Date": None})
    temporary.replace(path)
    plt.close(figure)


def style_of(method):
    return STYLES.get(cases.family_of(method), ("#000000", "o"))


def panels(count, sharey=False):
    """A figure of `count` axes in rows, and those axes."""
    columns = min(COLUMNS, count)
    rows = -(-count // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(3.5 * columns, 3.3 * rows + 0.9), squeeze=False, layout="constrained", sharey=sharey
    )
    flat = list(axes.flat)
    for axis in flat[count:]:
        axis.remove()
    return figure, flat[:count]


def ratio_axis(axis, values):
    axis.set_xscale("log")
    # Names stand to the right of the points.
    low, high = min(values) / 1.25, max(values) * 1.6
    axis.set_xlim(low, high)
    axis.xaxis.set_major_locator(FixedLocator([t for t in RATIO_TICKS if low <= t <= high]))
    axis.xaxis.set_minor_locator(NullLocator())
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def family_legend(figure, methods):
    shown = [family for family in FAMILIES if any(cases.family_of(method) == family for method in methods)]
    handles = [
        plt.Line2D([], [], color=STYLES[f][0], marker=STYLES[f][1], linestyle="", markersize=5, label=f) for f in shown
    ]
    columns = max(1, min(len(handles), int(figure.get_figwidth() / LEGEND_INCHES)))
    figure.legend(handles=handles, loc="outside lower center", ncols=columns, fontsize=8)


def scatter(axis, found, x_of):
    """Points of methods, one line through each family that has several of them; x_of: point to position or None."""
    for family, methods in cases.FAMILIES.items():
        own = [(x_of(p), p.psnr) for p in found if p.method in methods and x_of(p) is not None]
        if own:
            colour, marker = STYLES[family]
            line = "-" if len(own) > 1 else ""
            axis.plot(*zip(*sorted(own)), marker=marker, color=colour, linestyle=line, linewidth=0.8, markersize=5)
    for point in found:
        if x_of(point) is not None:
            place, move = (x_of(point), point.psnr), (4, 3)
            axis.annotate(point.method, place, move, textcoords="offset points", fontsize=6.5)


def spread(values, gap):
    """Places for labels as near as can be to these values, from the lowest to the highest, no two nearer than `gap`."""
    order = sorted(range(len(values)), key=lambda i: values[i])
    groups = []
    for index in order:
        groups.append([[index], values[index]])
        # Labels that touch share the room about their middle.
        while len(groups) > 1 and groups[-1][1] - groups[-2][1] < gap * (len(groups[-1][0]) + len(groups[-2][0])) / 2:
            (one, middle), (two, other) = groups[-2:]
            joint = (middle * len(one) + other * len(two)) / (len(one) + len(two))
            groups[-2:] = [[one + two, joint]]
    places = [0.0] * len(values)
    for members, middle in groups:
        for place, index in enumerate(members):
            places[index] = middle + gap * (place - (len(members) - 1) / 2)
    return places


def error_against_time(entries, found, path):
    """A panel for each verdict: PSNR against GPU time over gmm8's; the grey step is the Pareto front."""
    figure, axes = panels(len(found))
    for axis, verdict in zip(axes, found):
        shown = [p for p in verdict["points"] if p.time is not None]
        front = [p for p in shown if p.method in verdict["front"]]
        times, values = [p.time for p in front], [p.psnr for p in front]
        ratio_axis(axis, [p.time for p in shown])
        # To the right of the last one, nothing is gained.
        axis.step([*times, axis.get_xlim()[1]], [*values, values[-1]], where="post", color="#9ca3af", linewidth=3, alpha=0.5)
        scatter(axis, shown, lambda p: p.time)
        axis.set_title(cases.material_name(verdict["place"].material))
        axis.set_xlabel("GPU time over that of gmm8")
    for axis in axes[::COLUMNS]:
        axis.set_ylabel("PSNR, dB")
    family_legend(figure, [p.method for v in found for p in v["points"]])
    save(figure, path)


def error_against_fetches(found, path):
    """A panel for each verdict: PSNR against fetches of the environment."""
    figure, axes = panels(len(found))
    for axis, verdict in zip(axes, found):
        scatter(axis, verdict["points"], lambda p: p.fetches if p.fetches > 0 else None)
        axis.set_xscale("log", base=2)
        axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_title(cases.material_name(verdict["place"].material))
        axis.set_xlabel("fetches of the environment")
    for axis in axes[::COLUMNS]:
        axis.set_ylabel("PSNR, dB")
    family_legend(figure, [p.method for v in found for p in v["points"]])
    save(figure, path)


def isotropic(by_map, path):
    """Like figure 4.1 of the thesis: PSNR against the width, a panel for each map; by_map: {map: {method: {width: dB}}}."""
    figure, axes = panels(len(by_map))
    for axis, (map_name, lines) in zip(axes, by_map.items()):
        ends = []
        for method, line in lines.items():
            colour, marker = style_of(method)
            axis.plot(*zip(*sorted(line.items())), marker=marker, color=colour, markersize=3.5, linewidth=1)
            ends.append((line[max(line)], method, max(line)))
        low, high = axis.get_ylim()
        last = max(width for *_, width in ends)
        for (_, method, _), place in zip(ends, spread([value for value, *_ in ends], 0.035 * (high - low))):
            axis.annotate(method, (last, place), (8, -2), textcoords="offset points", fontsize=6.5)
        axis.set_xlim(0.0, 1.3 * last)
        axis.set_title(map_name)
        axis.set_xlabel("alpha")
    for axis in axes[::COLUMNS]:
        axis.set_ylabel("PSNR, dB")
    family_legend(figure, [method for lines in by_map.values() for method in lines])
    save(figure, path)


def curves(lines, label, path):
    """PSNR against a size: lines is {panel: {(method, note): [(x, dB)]}}."""
    figure, axes = panels(len(lines))
    for axis, (title, own) in zip(axes, lines.items()):
        for (method, note), line in own.items():
            colour, marker = style_of(method)
            dashes = "--" if method == "gmm16" else "-"
            name = f"{method} {note}".strip()
            axis.plot(*zip(*sorted(line)), dashes, marker=marker, color=colour, markersize=4, linewidth=1, label=name)
        axis.set_xscale("log", base=2)
        axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_title(title)
        axis.set_xlabel(label)
        axis.legend(fontsize=7)
    for axis in axes[::COLUMNS]:
        axis.set_ylabel("PSNR, dB")
    save(figure, path)


def bars(groups, path):
    """PSNR by filter: groups is {panel: {method: {filter: dB}}}."""
    figure, axes = panels(len(groups))
    shades = dict(zip(cases.FILTERS, ("#cbd5e1", "#94a3b8", "#64748b", "#c2410c")))
    for axis, (title, methods) in zip(axes, groups.items()):
        for place, (method, values) in enumerate(methods.items()):
            for shift, name in enumerate(name for name in cases.FILTERS if name in values):
                bar = axis.bar(place + 0.2 * shift, values[name], 0.18, color=shades[name], label=name if place == 0 else None)
                axis.bar_label(bar, fmt="%.1f", fontsize=6)
        lows = [value for values in methods.values() for value in values.values()]
        axis.set_ylim(min(lows) - 4.0, max(lows) + 2.0)
        axis.set_xticks([place + 0.3 for place in range(len(methods))], list(methods))
        axis.set_title(title)
        axis.legend(fontsize=7)
    for axis in axes[::COLUMNS]:
        axis.set_ylabel("PSNR, dB")
    save(figure, path)


def error_against_instructions(panels_of_points, path):
    """PSNR against instructions of phones' GPUs: {panel: [(method, instructions, dB)]}."""
    figure, axes = panels(len(panels_of_points))
    for axis, (title, found) in zip(axes, panels_of_points.items()):
        points = [analysis.Point(method, None, psnr, count) for method, count, psnr in found]
        scatter(axis, points, lambda p: p.fetches)
        axis.set_title(title)
        axis.set_xlabel("instructions a pixel")
        axis.set_xlim(0, 1.15 * max(p.fetches for p in points))
    for axis in axes[::COLUMNS]:
        axis.set_ylabel("PSNR, dB")
    family_legend(figure, [method for found in panels_of_points.values() for method, *_ in found])
    save(figure, path)


def changing(by_panel, path):
    """PSNR against the time of an update and a frame together, over gmm8's: {panel: [(method, ratio, dB)]}."""
    figure, axes = panels(len(by_panel))
    for axis, (title, found) in zip(axes, by_panel.items()):
        points = [analysis.Point(method, time, psnr, 1) for method, time, psnr in found]
        scatter(axis, points, lambda p: p.time)
        ratio_axis(axis, [p.time for p in points])
        axis.set_title(title)
        axis.set_xlabel("an update and the sphere, over gmm8's")
    for axis in axes[::COLUMNS]:
        axis.set_ylabel("PSNR, dB")
    family_legend(figure, [method for found in by_panel.values() for method, *_ in found])
    save(figure, path)
