#!/usr/bin/env python3
"""Metrics and sheets of `./dev compare`.

Reads DIR/plan.json, DIR/reference.exr, DIR/reference_error.exr (its standard error) and
DIR/<method>.exr (linear radiance, size² pixels), all written by bake/compare.gd, and writes
DIR/metrics.json, DIR/<method>_difference.png and DIR/sheet.png.

Metric (all figures over the pixels with x² + y² < 0.9995, x and y from −1 to 1 across the picture):
  exposure       maps the reference's median of (R+G+B)/3 to 0.18
  psnr           dB: −10 log10 of the mean squared error over the three channels, after exposure,
                 clamping to [0, 1] and the power 1/2.2
  flip           mean LDR-FLIP (Andersson et al. 2020) of the same encoded pictures, 0 (same) to 1
  relative_rmse  root of the mean squared error over the root of the reference's mean square, linear
  gpu_ms         median of the rounds' GPU times
  gpu_ms_ratio   median over the rounds of the method's time over that of gmm8 (of the first method
                 drawn where gmm8 is not) in the same round: what slows the machine down for a while
                 slows down both
  fixed_ms       median of the GPU times of a sphere that reflects nothing, drawn in the same rounds: what the
                 renderer takes for a frame, whatever the method
  gpu_ms_ratio_without_fixed  as gpu_ms_ratio, of what both times have above the fixed one of the round
The row `reference` compares the reference with itself plus its standard error, which is half the
difference of its two independent halves: the change that doubling the samples would bring.
A picture with a non-finite pixel, and a reference whose median is zero, are errors.
"""

import argparse
import json
import os
import sys
import tempfile

import flip_evaluator
import numpy as np
import OpenEXR
from PIL import Image, ImageDraw, ImageFont

GAMMA = 1 / 2.2
MIDDLE_GREY = 0.18
MASK_RADIUS_SQUARED = 0.9995
DIFFERENCE_GAIN = 4
# Captions need this much room; smaller pictures are enlarged on the sheet.
LEAST_COLUMN = 192


class MetricError(Exception):
    """Says in one sentence which file cannot be judged and why."""


def read_rgb(path):
    """Returns float64 (height, width, 3), linear; raises MetricError."""
    try:
        with OpenEXR.File(path, separate_channels=True) as file:
            channels = file.channels()
            picture = np.stack([channels[c].pixels.astype(np.float64) for c in "RGB"], axis=-1)
    except (KeyError, RuntimeError, TypeError, OSError) as error:
        raise MetricError(f"{path}: cannot be read as an RGB EXR ({error}).") from error
    bad = int(np.count_nonzero(~np.isfinite(picture)))
    if bad:
        raise MetricError(f"{path}: {bad} values are not finite.")
    return picture


def sphere_mask(size):
    """True inside the sphere's disc, as the contract of ./dev compare defines it."""
    centre = (2 * np.arange(size) + 1) / size - 1
    return centre[None, :] ** 2 + centre[:, None] ** 2 < MASK_RADIUS_SQUARED


def exposure_of(reference, mask):
    median = float(np.median(reference[mask].mean(axis=-1)))
    if not median > 0:
        raise MetricError("reference.exr: the median radiance is zero, so no exposure can be chosen.")
    return MIDDLE_GREY / median


def encode(picture, exposure):
    return np.clip(picture * exposure, 0, 1) ** GAMMA


def psnr(picture, reference, exposure, mask):
    """In dB; infinity for equal pictures."""
    error = encode(picture, exposure)[mask] - encode(reference, exposure)[mask]
    mean_square = float(np.mean(error**2))
    return float("inf") if mean_square == 0 else -10 * np.log10(mean_square)


def relative_rmse(picture, reference, mask):
    error = np.mean((picture[mask] - reference[mask]) ** 2)
    return float(np.sqrt(error / np.mean(reference[mask] ** 2)))


def flip(picture, reference, exposure, mask):
    error_map, _, _ = flip_evaluator.evaluate(
        encode(reference, exposure).astype(np.float32),
        encode(picture, exposure).astype(np.float32),
        "LDR",
        inputsRGB=True,
        applyMagma=False,
        computeMeanError=False,
    )
    return float(np.mean(np.asarray(error_map).reshape(*mask.shape, -1)[..., 0][mask]))


def to_bytes(encoded):
    return (np.clip(encoded, 0, 1) * 255 + 0.5).astype(np.uint8)


def write_atomically(path, write):
    """Calls write(temporary path), then renames: a reader never sees half a file."""
    folder, name = os.path.split(os.path.abspath(path))
    descriptor, temporary = tempfile.mkstemp(suffix=os.path.splitext(name)[1], dir=folder)
    os.close(descriptor)
    try:
        write(temporary)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def write_json(path, value):
    def write(temporary):
        with open(temporary, "w", encoding="utf-8") as file:
            json.dump(value, file, indent=2)
            file.write("\n")

    write_atomically(path, write)


def number(value, digits):
    return "–" if value is None else f"{value:.{digits}f}"


def draw_sheet(path, title, columns):
    """columns: (caption, top picture, bottom picture), each picture (size, size, 3) uint8."""
    scale = -(-LEAST_COLUMN // columns[0][1].shape[0])
    size = columns[0][1].shape[0] * scale
    font = ImageFont.load_default(size=max(11, size // 20))
    line = int(font.size * 1.35)
    sheet = Image.new(
        "RGB", (len(columns) * (size + 4) + 4, 2 * size + 3 * line + 12), (24, 24, 26)
    )
    draw = ImageDraw.Draw(sheet)
    draw.text((6, 3), title, font=font, fill=(235, 235, 235))
    for index, (caption, top, bottom) in enumerate(columns):
        left = 4 + index * (size + 4)
        draw.multiline_text((left + 2, 3 + line), caption, font=font, fill=(200, 200, 205))
        for picture, upper in ((top, 3 * line + 4), (bottom, 3 * line + 8 + size)):
            shown = Image.fromarray(picture).resize((size, size), Image.Resampling.NEAREST)
            sheet.paste(shown, (left, upper))
    write_atomically(path, sheet.save)


def median_ratio(times, baseline):
    """Of two lists of one time a round; None where either is empty."""
    ratios = [time / base for time, base in zip(times, baseline) if base > 0]
    return float(np.median(ratios)) if ratios else None


def median_ratio_without(fixed, times, baseline):
    """As median_ratio(), of what both have above `fixed`, round by round; None where there is no such list."""
    return median_ratio([t - f for t, f in zip(times, fixed)], [b - f for b, f in zip(baseline, fixed)])


def baseline_of(methods):
    """The times that the others are related to: (its method, its rounds)."""
    drawn = [m for m in methods if m["gpu_ms_rounds"]]
    chosen = next((m for m in drawn if m["method"] == "gmm8"), drawn[0] if drawn else None)
    return (chosen["method"], chosen["gpu_ms_rounds"]) if chosen else (None, [])


def row_of(entry, renderer, picture, reference, exposure, mask, baseline, fixed):
    """One row of metrics.json; its keys are the contract of ./dev compare."""
    times = entry["gpu_ms_rounds"]
    return {
        "method": entry["method"],
        "renderer": renderer,
        "fetches": entry["fetches"],
        "probes": entry["probes"],
        "table_fetches": entry["table_fetches"],
        "psnr": psnr(picture, reference, exposure, mask),
        "flip": flip(picture, reference, exposure, mask),
        "relative_rmse": relative_rmse(picture, reference, mask),
        "gpu_ms": float(np.median(times)) if times else None,
        "gpu_ms_ratio": median_ratio(times, baseline),
        "fixed_ms": float(np.median(fixed)) if times and fixed else None,
        "gpu_ms_ratio_without_fixed": median_ratio_without(fixed, times, baseline),
    }


def judge(folder):
    with open(os.path.join(folder, "plan.json"), encoding="utf-8") as file:
        plan = json.load(file)
    reference = read_rgb(os.path.join(folder, "reference.exr"))
    mask = sphere_mask(reference.shape[0])
    exposure = exposure_of(reference, mask)
    _, baseline = baseline_of(plan["methods"])
    fixed = plan.get("fixed_ms_rounds", [])

    rows = []
    shown_reference = encode(reference, exposure) * mask[..., None]
    columns = [("reference", to_bytes(shown_reference), np.zeros(reference.shape, np.uint8))]
    for entry in plan["methods"]:
        method = entry["method"]
        if method == "reference":
            picture = reference + read_rgb(os.path.join(folder, "reference_error.exr"))
        else:
            picture = read_rgb(os.path.join(folder, method + ".exr"))
        if picture.shape != reference.shape:
            raise MetricError(f"{method}.exr: its size is not the reference's.")
        row = row_of(entry, plan["renderer"], picture, reference, exposure, mask, baseline, fixed)
        rows.append(row)
        if method == "reference":
            continue
        shown = encode(picture, exposure) * mask[..., None]
        difference = to_bytes(np.abs(shown - shown_reference) * DIFFERENCE_GAIN)
        write_atomically(
            os.path.join(folder, method + "_difference.png"), Image.fromarray(difference).save
        )
        caption = f"{method}  {row['psnr']:.2f} dB\nFLIP {row['flip']:.4f}, error x{DIFFERENCE_GAIN}"
        columns.append((caption, to_bytes(shown), difference))

    alpha = plan["alpha"]
    title = f"{plan['brdf']} ({alpha[0]:g}, {alpha[1]:g}), {os.path.basename(plan['env'])}, {plan['renderer']}"
    draw_sheet(os.path.join(folder, "sheet.png"), title, columns)
    write_json(os.path.join(folder, "metrics.json"), rows)
    return plan, rows


def print_table(plan, rows):
    alpha = plan["alpha"]
    print(f"{plan['brdf']} ({alpha[0]:g}, {alpha[1]:g})  {os.path.basename(plan['env'])}  {plan['renderer']}")
    of_baseline = f"of {baseline_of(plan['methods'])[0] or '–'}"
    head = ("method", "fetches", "probes", "table", "PSNR dB", "FLIP", "rel. RMSE", "GPU ms", of_baseline, "no fixed")
    print("  ".join(f"{h:>9}" for h in head))
    for row in rows:
        cells = (
            row["method"],
            str(row["fetches"]),
            number(row["probes"], 1),
            str(row["table_fetches"]),
            number(row["psnr"], 2),
            number(row["flip"], 4),
            number(row["relative_rmse"], 4),
            number(row["gpu_ms"], 3),
            number(row["gpu_ms_ratio"], 2),
            number(row["gpu_ms_ratio_without_fixed"], 2),
        )
        print("  ".join(f"{c:>9}" for c in cells))
    if plan.get("fixed_ms_rounds"):
        fixed = number(float(np.median(plan["fixed_ms_rounds"])), 3)
        print(f"Of GPU ms at {plan['timing_size']}², {fixed} are the renderer's for any frame; 'no fixed': without them.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("dir", help="the folder that bake/compare.gd wrote")
    parser.add_argument("--json", help="write the rows here too")
    options = parser.parse_args()
    try:
        plan, rows = judge(options.dir)
        if options.json:
            write_json(options.json, rows)
    except (MetricError, OSError) as error:
        sys.exit(f"compare: {error}")
    print_table(plan, rows)


if __name__ == "__main__":
    main()
