"""The pictures of one case beside each other, with their errors below them."""

import pathlib

import cases
import metrics
import numpy as np
from PIL import Image, ImageDraw, ImageFont

LEAST_SIDE = 128
PAPER, INK = (255, 255, 255), (30, 30, 34)
MARGIN = 4


def draw(folder, figures, path):
    """Writes reference and methods from the EXR pictures in `folder`; figures: {method: {"psnr"}} of those drawn."""
    folder = pathlib.Path(folder)
    reference = metrics.read_rgb(str(folder / "reference.exr"))
    mask = metrics.sphere_mask(reference.shape[0])
    exposure = metrics.exposure_of(reference, mask)
    shown_reference = metrics.encode(reference, exposure)
    columns = [("reference", "", shown_reference, np.zeros_like(reference))]
    for method in cases.PICTURED:
        if method in figures:
            shown = metrics.encode(metrics.read_rgb(str(folder / f"{method}.exr")), exposure)
            error = np.abs(shown - shown_reference) * metrics.DIFFERENCE_GAIN
            columns.append((method, f"{figures[method]['psnr']:.1f} dB", shown, error))

    side = max(LEAST_SIDE, reference.shape[0])
    font = ImageFont.load_default(size=14)
    line = 18
    sheet = Image.new("RGB", (len(columns) * (side + MARGIN) + MARGIN, 2 * (side + MARGIN) + 2 * line + MARGIN), PAPER)
    pen = ImageDraw.Draw(sheet)
    for index, (method, caption, *pictures) in enumerate(columns):
        left = MARGIN + index * (side + MARGIN)
        pen.text((left + 2, 0), method, font=font, fill=INK)
        pen.text((left + 2, line), caption, font=font, fill=INK)
        for row, picture in enumerate(pictures):
            # Beside the sphere, paper.
            tile = np.where(mask[..., None], picture, 1.0)
            image = Image.fromarray(metrics.to_bytes(tile)).resize((side, side), Image.Resampling.NEAREST)
            sheet.paste(image, (left, 2 * line + row * (side + MARGIN)))
    metrics.write_atomically(str(path), lambda temporary: sheet.save(temporary, optimize=True))
