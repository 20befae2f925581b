"""Writes the files that the importers' suite imports: files.py FOLDER.

Environment maps that the engine's own importer refuses or misreads, a measured BRDF, and what is none. OpenEXR's own
Python module writes the maps.
"""

import struct
import sys
from pathlib import Path

import numpy as np
import OpenEXR

WIDTH, HEIGHT = 8, 4


def plane(value: float, kind: type = np.float16) -> np.ndarray:
    """(HEIGHT, WIDTH) of one value."""
    return np.full((HEIGHT, WIDTH), value, dtype=kind)


def header(compression: OpenEXR.Compression) -> dict:
    return {"compression": compression, "type": OpenEXR.scanlineimage}


def write_maps(folder: Path) -> None:
    layers = {f"{layer}.{channel}": plane(value + n) for layer, value in (("key", 1.0), ("fill", 10.0))
              for n, channel in enumerate("RGB")}
    with OpenEXR.File(header(OpenEXR.DWAA_COMPRESSION), layers) as file:
        file.write(str(folder / "layers.exr"))
    parts = [OpenEXR.Part({**header(OpenEXR.PXR24_COMPRESSION), "name": name}, {c: plane(value) for c in "RGB"}, name)
             for name, value in (("left", 2.0), ("right", 4.0))]
    with OpenEXR.File(parts) as file:
        file.write(str(folder / "parts.exr"))
    numbers = {c: plane(n + 1, np.uint32) for n, c in enumerate("RGB")}
    with OpenEXR.File(header(OpenEXR.ZIP_COMPRESSION), numbers) as file:
        file.write(str(folder / "numbers.exr"))
    wild = {c: plane(100000.0, np.float32) for c in "RGB"}
    wild["R"][0, 0] = np.nan
    wild["G"][1, 1] = -1.0
    with OpenEXR.File(header(OpenEXR.B44A_COMPRESSION), wild) as file:
        file.write(str(folder / "wild.exr"))
    with OpenEXR.File(header(OpenEXR.ZIP_COMPRESSION), {"A": plane(1.0)}) as file:
        file.write(str(folder / "alpha.exr"))
    square = {c: np.ones((WIDTH, WIDTH), dtype=np.float16) for c in "RGB"}
    with OpenEXR.File(header(OpenEXR.ZIP_COMPRESSION), square) as file:
        file.write(str(folder / "square.exr"))
    whole = (folder / "layers.exr").read_bytes()
    (folder / "cut.exr").write_bytes(whole[: len(whole) * 2 // 3])
    (folder / "text.exr").write_text("not a picture")


def write_measurements(folder: Path) -> None:
    """An isotropic RGL file of a white diffuse surface: a header, then for each field name, shape, type, offset."""
    rgb = np.full((1, 3, 3, 2, 2), 0.4, dtype=np.float32)
    rgb.flat[0] = -1.0
    one = np.ones((2, 2), dtype=np.float32)
    fields = {
        "theta_i": np.array([0, np.pi / 4, np.pi / 2], dtype=np.float32),
        "phi_i": np.zeros(1, dtype=np.float32),
        "ndf": one,
        "sigma": one,
        "vndf": np.ones((1, 3, 2, 2), dtype=np.float32),
        "rgb": rgb,
        "jacobian": np.ones(1, dtype=np.uint8),
    }
    offset = 18 + sum(2 + len(name) + 2 + 1 + 8 + 8 * value.ndim for name, value in fields.items())
    head = b"tensor_file\0" + bytes([1, 0]) + struct.pack("<I", len(fields))
    body = b""
    for name, value in fields.items():
        kind = 1 if value.dtype == np.uint8 else 10
        head += struct.pack("<H", len(name)) + name.encode() + struct.pack("<HBQ", value.ndim, kind, offset + len(body))
        head += struct.pack(f"<{value.ndim}Q", *value.shape)
        body += value.tobytes()
    (folder / "white.bsdf").write_bytes(head + body)
    (folder / "text.binary").write_text("not a measurement")


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    # The engine is to leave the files alone until the suite hands them to an importer.
    (target / ".gdignore").touch()
    write_maps(target)
    write_measurements(target)
