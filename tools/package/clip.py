"""Makes the listing's clip of frames: clip.py FOLDER CLIP.webp. FOLDER is what demo/commands/clip_frames.gd has written."""

import json
import os
import sys
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

# Milliseconds a frame.
DURATION = 66
QUALITY = 72
LABELS = ("Lobelight", "StandardMaterial3D, Mobile")
LABEL_SIZE = 16
MARGIN = 10


def draw_divider(frame: Image.Image, divider: float) -> None:
    """The divider and what is drawn on each side of it, while there are two sides."""
    at = round(divider * frame.width)
    if at >= frame.width - 1:
        return
    draw = ImageDraw.Draw(frame)
    draw.rectangle([at - 1, 0, at, frame.height], fill="white")
    font = ImageFont.load_default(LABEL_SIZE)
    outline = {"font": font, "fill": "white", "stroke_width": 1, "stroke_fill": "black"}
    draw.text((at - MARGIN, MARGIN), LABELS[0], anchor="ra", **outline)
    draw.text((at + MARGIN, MARGIN), LABELS[1], anchor="la", **outline)


def main() -> None:
    folder, clip = Path(sys.argv[1]), Path(sys.argv[2])
    frames = []
    for number, divider in enumerate(json.loads((folder / "clip.json").read_text(encoding="utf-8"))["dividers"]):
        frame = Image.open(folder / f"frame_{number:03d}.png").convert("RGB")
        draw_divider(frame, divider)
        frames.append(frame)
    part = clip.with_name(f"{clip.name}.{os.getpid()}.part")
    frames[0].save(
        part, "WEBP", save_all=True, append_images=frames[1:], duration=DURATION, loop=0, quality=QUALITY, method=6
    )
    os.replace(part, clip)


if __name__ == "__main__":
    main()
