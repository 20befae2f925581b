#!/usr/bin/env python3
"""Writes the page of ./dev bench runtime --out: README.md, results.json and runtime.svg from what was measured."""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.hashsalt": "lobelight", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3})

import matplotlib.pyplot as plt  # noqa: E402

RENDERERS = {"mobile": "Mobile", "forward_plus": "Forward+", "gl_compatibility": "Compatibility"}
COLOURS = {"mobile": "#1f4e79", "forward_plus": "#3a7d44", "gl_compatibility": "#c9a227"}

# What the project wants to stay below: of first light in frames, of its longest frame, of an idle environment in
# microseconds, of a property beside StandardMaterial3D's, of a baked light in MiB.
FIRST_LIGHT, LONGEST, IDLE, PROPERTY, BAKED = 4.0, 2.0, 5.0, 4.0, 3.0


def table(head, rows):
    """A Markdown table; nothing if there are no rows."""
    if not rows:
        return ""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def section(title, text, head, rows):
    return f"## {title}\n\n{text}\n\n{table(head, rows)}\n" if rows else ""


def bounds(results):
    """(what, renderer, share of the bound) of all that has one."""
    for row in results:
        what, renderer = row["what"], row["renderer"]
        if what == "first-light" and row["mode"] == "once":
            yield f"first light, frames / {FIRST_LIGHT:g}", renderer, row["first_light_frames"] / FIRST_LIGHT
        elif what == "first-light":
            yield f"longest frame in slices / {LONGEST:g}", renderer, row["turn_longest_frame_ratio"] / LONGEST
        elif what == "idle":
            yield f"idle, {row['source']}, µs / {IDLE:g}", renderer, row["script_usec"] / IDLE
        elif what == "properties":
            yield f"{row['property']} / {PROPERTY:g} × StandardMaterial3D", renderer, row["ratio"] / PROPERTY
        elif what == "memory" and row["thing"] == "baked light":
            yield f"baked light, MiB / {BAKED:g}", renderer, row["texture_mib"] / BAKED


def plot(results, path):
    """Each figure as a share of what it is to stay below."""
    found = list(bounds(results))
    names = list(dict.fromkeys(name for name, _, _ in found))
    figure, axis = plt.subplots(figsize=(7.2, 1.0 + 0.32 * len(names)), layout="constrained")
    present = [renderer for renderer in RENDERERS if any(renderer == r for _, r, _ in found)]
    for i, renderer in enumerate(present):
        shares = [max((s for n, r, s in found if n == name and r == renderer), default=0.0) for name in names]
        places = [at + 0.25 * (i - 0.5 * (len(present) - 1)) for at in range(len(names))]
        axis.barh(places, [max(share, 0.01) for share in shares], 0.22, color=COLOURS[renderer], label=RENDERERS[renderer])
    axis.axvline(1.0, color="#8b2e5d", linewidth=1.2)
    axis.set_xscale("log")
    axis.set_xlim(left=0.01)
    axis.set_yticks(range(len(names)), names)
    axis.invert_yaxis()
    axis.set_xlabel("share of what it is to stay below")
    if present:
        axis.legend(fontsize=7)
    temporary = path.with_name("." + path.name)
    figure.savefig(temporary, format="svg", metadata={"Date": None})
    temporary.replace(path)
    plt.close(figure)


def page(results):
    def of(what):
        return [row for row in results if row["what"] == what]

    def name(row):
        return RENDERERS[row["renderer"]]

    text = """# What the addon costs in a running game

![Each figure as a share of what it is to stay below](runtime.svg)

`./dev bench runtime --out docs/report/runtime` measures and writes this page and `results.json`. Ratios are of one run,
medians over its rounds; times are those of the machine that measured, here software drivers, and mean little on others.
`LOBELIGHT_DISPLAY=real` measures your own GPU.

"""
    text += section(
        "First light",
        "How much longer the frames are, until a panorama's light is there, than those after, in frames of 720p that eight "
        f"lobes light (at most {FIRST_LIGHT:g}), and the longest of them. The first time in a process also compiles shaders. In "
        f"TIME_SLICED also the longest frame of the next update (at most {LONGEST:g}).",
        ["Renderer", "Mode", "Panorama", "An ordinary frame, ms", "First light, frames", "Longest frame", "Drawn in", "First time", "Next update's longest"],
        [
            [
                name(r),
                r["mode"],
                " × ".join(map(str, r["panorama"])),
                f"{r['frame_ms']:.1f}",
                f"{r['first_light_frames']:.1f}",
                f"{r['longest_frame_ratio']:.1f}",
                f"{r['until_light']:.0f} frames",
                f"{r['cold_frames']:.1f}",
                f"{r['turn_longest_frame_ratio']:.1f}" if r["mode"] == "time_sliced" else "",
            ]
            for r in of("first-light")
        ],
    )
    text += section(
        "Updates",
        "Of a sky, by the GPU's clock.",
        ["Renderer", "Filter", "Texels", "Update, frames", "Update, ms", "Processor, ms"],
        [
            [
                name(r),
                r["filter"],
                r["size"],
                f"{r['update_frames_ratio']:.2f}",
                f"{r['update_gpu_ms']:.2f}",
                f"{r['update_cpu_ms']:.2f}",
            ]
            for r in of("updates")
        ],
    )
    text += section(
        "While nothing changes",
        f"Scripts of one environment in a frame (at most {IDLE:g} µs).",
        ["Renderer", "Light of", "Functions called", "µs"],
        [[name(r), r["source"], r["calls"], f"{r['script_usec']:.1f}"] for r in of("idle")],
    )
    text += section(
        "Properties that move",
        f"Setting one of all materials in each frame, with what follows until the frame is drawn; at most {PROPERTY:g} times "
        "StandardMaterial3D's.",
        ["Renderer", "Property", "Materials", "ms a frame", "StandardMaterial3D, ms", "Ratio"],
        [
            [
                name(r),
                r["property"],
                r["materials"],
                f"{r['lobe_ms']:.3f}",
                f"{r['standard_ms']:.3f}",
                f"{r['ratio']:.1f}",
            ]
            for r in of("properties")
        ],
    )
    text += section(
        "Memory",
        f"The panorama itself does not count. A baked light is to take at most {BAKED:g} MiB.",
        ["Renderer", "What", "Textures, MiB", "File, MiB"],
        [
            [name(r), r["thing"], f"{r['texture_mib']:.2f}", f"{r['file_mib']:.2f}" if r["file_mib"] else ""]
            for r in of("memory")
        ],
    )
    text += section(
        "Shaders",
        "Eight different materials, until the engine makes no more pipelines, with empty caches.",
        ["Renderer", "Material", "Materials", "Shaders", "Pipelines", "ms"],
        [
            [name(r), r["material"], r["materials"], r["shaders"], r["pipelines"], f"{r['compile_ms']:.0f}"]
            for r in of("shaders")
        ],
    )
    return text.rstrip("\n") + "\n"


def save(text, path):
    temporary = path.with_name("." + path.name)
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("results", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    results = [row for file in arguments.results for row in json.loads(file.read_text(encoding="utf-8"))]
    arguments.out.mkdir(parents=True, exist_ok=True)
    save(json.dumps(results, indent=1) + "\n", arguments.out / "results.json")
    plot(results, arguments.out / "runtime.svg")
    save(page(results), arguments.out / "README.md")
    print(f"{arguments.out}/README.md")


if __name__ == "__main__":
    main()
