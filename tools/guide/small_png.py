"""Writes pictures as PNG files of 256 colours: small_png.py FOLDER PICTURE…"""

import sys
from pathlib import Path

from PIL import Image

for picture in map(Path, sys.argv[2:]):
    image = Image.open(picture).convert("RGB")
    image.quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(Path(sys.argv[1]) / picture.name, optimize=True)
