"""The figure of ./dev mobile-cost."""

import matplotlib

matplotlib.use("Agg")
# Files that differ only where the numbers do.
matplotlib.rcParams.update({"svg.hashsalt": "lobelight", "font.size": 9})

import matplotlib.pyplot as plt  # noqa: E402
from gpus import GPUS  # noqa: E402

COLOURS = {"empty": "#999999", "stock": "#5b7fa6", "gmm": "#2f8f5b", "line": "#2f8f5b", "own": "#2f8f5b", "fis": "#b5633c"}
OTHER_RIVALS = "#8a6fb0"


def _colour(variant):
    return next((colour for start, colour in COLOURS.items() if variant.startswith(start)), OTHER_RIVALS)


def cost(rows, variants, path):
    """Bars of the fragment shader's instructions, a panel for each GPU, the registers beside each bar."""
    gpus = list(dict.fromkeys(row["gpu"] for row in rows))
    names = list(dict.fromkeys(row["variant"] for row in rows))
    figure, axes = plt.subplots(
        1, len(gpus), figsize=(2.8 + 2.5 * len(gpus), 0.9 + 0.27 * len(names)), squeeze=False, sharey=True, layout="constrained"
    )
    for axis, gpu in zip(axes[0], gpus):
        of_gpu = {row["variant"]: row for row in rows if row["gpu"] == gpu}
        most = max(row["instructions"] for row in of_gpu.values())
        for place, name in enumerate(names):
            row = of_gpu.get(name)
            if row is None:
                continue
            axis.barh(place, row["instructions"], color=_colour(name), height=0.72)
            text = f"{row['instructions']} · {row['registers']} r"
            inside = row["instructions"] > 0.6 * most
            offset = -0.015 * most if inside else 0.015 * most
            axis.text(
                row["instructions"] + offset, place, text, va="center", ha="right" if inside else "left", fontsize=7,
                color="white" if inside else "black",
            )
        axis.set_title(f"{GPUS[gpu].label}\n{'Mobile' if GPUS[gpu].renderer == 'mobile' else 'Compatibility'}", fontsize=9)
        axis.set_xlabel("instructions a pixel · registers")
        axis.grid(axis="x", alpha=0.3)
        axis.set_axisbelow(True)
    axes[0][0].set_yticks(range(len(names)), [variants[name]["label"] for name in names], fontsize=8)
    axes[0][0].invert_yaxis()
    temporary = path.with_name("." + path.name)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(temporary, format="svg", metadata={"Date": None})
    temporary.replace(path)
    plt.close(figure)
