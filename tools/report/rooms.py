"""./dev report --rooms: error against run time for a sphere in rooms, by ./dev compare's code.

Three rooms, three places of the sphere and three materials, each by the probe's lobes, the same without parallax, filtered
importance sampling with box-projected samples and the engine's own probe.
"""

import argparse
import pathlib
import statistics
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / "compare")]

import batch  # noqa: E402
import figures  # noqa: E402
import metrics  # noqa: E402
import rooms as room_pictures  # noqa: E402
import runs  # noqa: E402

BOX, PROBE, RADIUS, TEXELS = room_pictures.BOX, (0.0, 0.0, 0.0), 0.4, 512
PLACES = {"near": (0.3, -0.2, 0.3), "off": (1.2, -0.4, 1.0), "corner": (2.2, -0.9, 2.6)}
# (alpha_x, alpha_y), lobes.
MATERIALS = (((0.1, 0.1), 8), ((0.3, 0.3), 8), ((0.05, 0.3), 16))
MAPS = ("hall", "sunset", runs.SYNTHETIC)
# What the thesis' followers and the engine do, and what parallax brings.
RIVALS = ("fis40", "stock")


def read_options(arguments):
    parser = runs.Parser("report --rooms")
    parser.add_argument("--rooms", action="store_true")
    parser.add_argument("--renderer", choices=("mobile", "gl_compatibility", "forward_plus"), default="mobile")
    parser.add_argument("--size", type=runs.whole_number(8, 2048), default=128)
    parser.add_argument("--samples", type=runs.whole_number(2, 1 << 20), default=256)
    parser.add_argument("--timing-rounds", type=runs.whole_number(1, 10000), default=5)
    parser.add_argument("--cases", type=runs.whole_number(1, 27), default=27)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=batch.ROOT / "docs/report/rooms")
    parser.add_argument("--check", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def methods_of(lobes):
    return [f"gmm{lobes}", f"gmm{lobes}_flat", *RIVALS]


def make_entries(options, work):
    """The comparisons, and what each is of."""
    maps = runs.own_maps(work)
    cases, entries = [], []
    for name in MAPS:
        if name == runs.SYNTHETIC:
            pictures = room_pictures.synthetic(BOX, TEXELS)
        else:
            pictures = room_pictures.cut(metrics.read_rgb(str(maps[name])), BOX, TEXELS)
        for place, centre in PLACES.items():
            room = room_pictures.write(work / f"{name}-{place}", pictures, BOX, PROBE, centre, RADIUS)
            for alpha, lobes in MATERIALS:
                out = work / f"{name}-{place}" / "-".join(str(a) for a in alpha)
                out.mkdir(parents=True, exist_ok=True)
                cases.append({"room": name, "place": place, "alpha": list(alpha), "lobes": lobes, "out": out})
                entries.append(
                    {
                        "room": str(room),
                        "brdf": "ggx",
                        "alpha": list(alpha),
                        "methods": [*methods_of(lobes), "reference"],
                        "size": options.size,
                        "samples": options.samples,
                        "timing_rounds": options.timing_rounds,
                        "out": str(out),
                    }
                )
    return cases[: options.cases], entries[: options.cases]


def measure(options, work):
    cases, entries = make_entries(options, work)
    progress = runs.Progress([1.0] * len(cases))
    done = 0
    for index in batch.draw(entries, options.renderer, work):
        case = cases[index]
        _plan, rows = batch.judge(case["out"])
        case["rows"] = {row["method"]: row for row in rows if row["method"] != "reference"}
        said = ", ".join(f"{method} {row['psnr']:.1f} dB" for method, row in case["rows"].items())
        progress.step(1.0, f"{case['room']} {case['place']} {case['alpha']}", said)
        done += 1
    if done < len(entries):
        raise runs.Problem(batch.failure(work))
    return cases


def kind_of(method):
    """gmm8 and gmm16 are one method with the lobes that the material wants."""
    if not method.startswith("gmm"):
        return method
    return "lobes, no parallax" if method.endswith("_flat") else "lobes"


def draw_figure(cases, path):
    """PSNR against the time of a frame, that of the lobes being 1; a panel for each material."""
    figure, axes = figures.plt.subplots(1, len(MATERIALS), figsize=(4.2 * len(MATERIALS), 3.8), sharey=True)
    marks = {"lobes": ("o", "C0"), "lobes, no parallax": ("v", "C1"), "fis40": ("s", "C2"), "stock": ("^", "C3")}
    for axis, (alpha, lobes) in zip(axes, MATERIALS):
        for case in cases:
            if tuple(case["alpha"]) != alpha:
                continue
            base = case["rows"][f"gmm{lobes}"]["gpu_ms"]
            for method, row in case["rows"].items():
                mark, colour = marks[kind_of(method)]
                axis.plot(row["gpu_ms"] / base, row["psnr"], mark, color=colour, alpha=0.75)
        axis.set_title(f"GGX {alpha[0]} × {alpha[1]}, {lobes} lobes")
        axis.set_xscale("log")
        axis.set_xlabel("time of a frame, lobes in the room = 1")
        axis.grid(True, alpha=0.3)
    axes[0].set_ylabel("PSNR, dB")
    for name, (mark, colour) in marks.items():
        axes[0].plot([], [], mark, color=colour, label=name)
    axes[0].legend(fontsize="small")
    figures.save(figure, path)


def cell(row):
    return f"{row['psnr']:.1f}"


def document(cases, options):
    gains = {kind: [] for kind in ("lobes, no parallax", *RIVALS)}
    slower = []
    lines = []
    for case in cases:
        rows = case["rows"]
        own = rows[f"gmm{case['lobes']}"]
        for method, row in rows.items():
            if kind_of(method) in gains:
                gains[kind_of(method)].append(own["psnr"] - row["psnr"])
        times = [rows[m]["gpu_ms"] / own["gpu_ms"] if own["gpu_ms"] else 0.0 for m in methods_of(case["lobes"])[1:]]
        slower.append(rows["fis40"]["gpu_ms"] / own["gpu_ms"] if own["gpu_ms"] else 0.0)
        cells = [cell(rows[m]) for m in methods_of(case["lobes"])]
        alpha = " × ".join(str(a) for a in case["alpha"])
        lines.append(
            f"| {case['room']} | {case['place']} | {alpha} | {case['lobes']} | {' | '.join(cells)} "
            f"| {' / '.join(f'{t:.2f}' for t in times)} |"
        )
    told = [
        f"{statistics.median(gain):.1f} dB over {'the same lobes without parallax' if 'no' in kind else kind}"
        f" (at least {min(gain):.1f})"
        for kind, gain in gains.items()
    ]
    text = [
        "# Error against run time in rooms",
        "",
        "![Error against time in rooms](error_against_time.svg)",
        "",
        f"A sphere in a box of 6 × 3 × 8 m, lit by one probe in the middle: lobes gain, as the median, {told[0]}, {told[1]} and "
        f"{told[2]}; fis40 takes {statistics.median(slower):.1f} times as long.",
        "",
        f"`./dev report --rooms` draws this in the {options.renderer} renderer at {options.size}²; times are medians on software "
        "drivers, as parts of that of the lobes. Walls show a panorama as it looks from the room's middle, or a made-up room. "
        "The sphere of 0.4 m is near the probe (0.3, −0.2, 0.3), off it (1.2, −0.4, 1.0) or in a corner (2.2, −0.9, 2.6). "
        "`fis40` projects its samples on the box as well; `stock` is StandardMaterial3D with an interior ReflectionProbe and "
        "box projection.",
        "",
        "| Room | Sphere | GGX | Lobes | lobes, dB | no parallax | fis40 | stock | times: no parallax / fis40 / stock |",
        "|---|---|---|---|---|---|---|---|---|",
        *lines,
        "",
    ]
    return "\n".join(text)


def run(options):
    work = batch.ROOT / "build/rooms"
    work.mkdir(parents=True, exist_ok=True)
    cases = measure(options, work)
    options.out.mkdir(parents=True, exist_ok=True)
    draw_figure(cases, options.out / "error_against_time.svg")
    results = [{k: v for k, v in case.items() if k != "out"} for case in cases]
    metrics.write_json(str(options.out / "results.json"), results)
    if options.json:
        metrics.write_json(str(options.json), results)
    (options.out / "README.md").write_text(document(cases, options), encoding="utf-8")
    print(options.out / "README.md")


if __name__ == "__main__":
    runs.main("report", read_options, run)
